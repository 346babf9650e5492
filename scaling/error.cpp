#include "scaling/error.hpp"

#include "scaling/shorten.hpp"

namespace musim {

Error::Error(const std::string& message) : std::runtime_error(scaling::make_line(message)) {}

}  // namespace musim
