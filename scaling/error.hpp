#pragma once

#include <stdexcept>

namespace musim::scaling {

/// Scale factors that cannot belong to a similitude; the message says where, what, why and what to do, in one line.
class SimilitudeError : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

/// Text that is no number or no quantity of the wanted dimension. The message quotes the text; callers put file and key in front.
class ParseError : public SimilitudeError {
  public:
    using SimilitudeError::SimilitudeError;
};

}  // namespace musim::scaling
