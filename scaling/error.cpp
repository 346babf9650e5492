#include "scaling/error.hpp"

#include "scaling/setting.hpp"
#include "scaling/shorten.hpp"

namespace musim {

Error::Error(const std::string& message) : std::runtime_error(scaling::make_line(message)) {}

Error::Error(const std::string& problem, const Remedy& remedy)
    : std::runtime_error(scaling::make_line(problem + "; " + remedy.worded(plain_name))),
      problem_(std::make_shared<const std::string>(problem)),
      remedy_(std::make_shared<const Remedy>(remedy)) {}

std::string Error::worded(SettingNames names) const {
    return remedy_ ? scaling::make_line(*problem_ + "; " + remedy_->worded(names)) : what();
}

}  // namespace musim
