#pragma once

#include <memory>
#include <stdexcept>
#include <string>

#include "scaling/remedy.hpp"

namespace musim {

/// Something that a user can mend: the message says where, what, why and what to do, in one line.
class Error : public std::runtime_error {
  public:
    /// Control characters, which a text that is quoted may hold, become spaces.
    explicit Error(const std::string& message);

    /// The message is `problem; remedy`, its settings in plain words. `problem` says where, what and why.
    Error(const std::string& problem, const Remedy& remedy);

    /// The message with settings named as a caller does.
    std::string worded(SettingNames names) const;

    /// The same problem with another remedy.
    template <class Kind>
    Kind with(const Remedy& remedy) const {
        return Kind(problem_ ? *problem_ : what(), remedy);
    }

    /// The same error seen from farther off: `place: ` stands before it.
    template <class Kind>
    Kind seen_from(const std::string& place) const {
        return remedy_ ? Kind(place + ": " + *problem_, *remedy_) : Kind(place + ": " + what());
    }

  private:
    std::shared_ptr<const std::string> problem_;  // none: the message is all there is
    std::shared_ptr<const Remedy> remedy_;
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
