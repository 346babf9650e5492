#pragma once

#include <concepts>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace musim {

enum class Setting : int;  // scaling/setting.hpp has them; this header is included nearly everywhere

/// Names of settings in a caller's language, e.g. "--dt SECONDS".
using SettingNames = std::string_view (*)(Setting);

/// Advice about an error: words, and settings among them that each caller names in its own language.
///
///   Remedy{"drop ", Setting::sensitivity, " or ", Setting::station_response}
class Remedy {
  public:
    template <class... Parts>
    requires(sizeof...(Parts) > 0) && (... && (std::same_as<Parts, Setting> || std::convertible_to<Parts, std::string_view>))
                                          Remedy(const Parts&... parts) {  // NOLINT(google-explicit-constructor): words alone are a remedy
        (add(parts), ...);
    }

    /// The remedy as a caller words it.
    std::string worded(SettingNames names) const;

  private:
    void add(Setting setting);
    void add(std::string_view words);

    std::vector<std::variant<std::string, Setting>> parts_;
};

}  // namespace musim
