#pragma once

#include <stdexcept>
#include <string>

namespace musim {

/// Something that a user can mend: the message says where, what, why and what to do, in one line.
class Error : public std::runtime_error {
  public:
    /// Control characters, which a text that is quoted may hold, become spaces.
    explicit Error(const std::string& message);
};

}  // namespace musim

namespace musim::scaling {

/// Scale factors that cannot belong to a similitude.
class SimilitudeError : public Error {
  public:
    using Error::Error;
};

/// Text that is no number or no quantity of the wanted dimension. The message quotes the text; callers put file and key in front.
class ParseError : public SimilitudeError {
  public:
    using SimilitudeError::SimilitudeError;
};

}  // namespace musim::scaling
