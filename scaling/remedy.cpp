#include "scaling/remedy.hpp"

namespace musim {

std::string_view plain_name(Setting setting) {
    switch (setting) {
        case Setting::time_step:
            return "the time step";
        case Setting::unit:
            return "the unit";
        case Setting::quantity:
            return "the quantity";
        case Setting::sensitivity:
            return "the sensitivity";
        case Setting::station_response:
            return "the station's StationXML";
        case Setting::columns:
            return "the columns";
        case Setting::skipped_lines:
            return "the number of lines to skip";
    }
    return "";
}

void Remedy::add(Setting setting) { parts_.emplace_back(setting); }

void Remedy::add(std::string_view words) { parts_.emplace_back(std::string(words)); }

std::string Remedy::worded(SettingNames names) const {
    std::string text;
    for (const auto& part : parts_) {
        if (const auto* setting = std::get_if<Setting>(&part)) {
            text += names(*setting);
        } else {
            text += std::get<std::string>(part);
        }
    }
    return text;
}

}  // namespace musim
