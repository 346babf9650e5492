#include "lsdem/build.hpp"

namespace musim::lsdem {

std::string describe_build() { return MUSIM_BUILD; }

}  // namespace musim::lsdem
