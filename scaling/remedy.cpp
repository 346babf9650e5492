#include "scaling/remedy.hpp"

#include "scaling/setting.hpp"

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
        case Setting::factor:
            return "a factor that is set";
        case Setting::axes:
            return "pairs of component and axis";
        case Setting::specimen_folder:
            return "a folder of specimens";
        case Setting::specimen_count:
            return "the number of other specimens";
        case Setting::preparation:
            return "a preparation of specimens in";
        case Setting::specimen_list:
            return "the JSON list of prepared specimens";
        case Setting::overwriting:
            return "leave to replace them";
        case Setting::single_run:
            return "a single run";
        case Setting::sequence:
            return "a sequence";
        case Setting::run_resumption:
            return "a resumption, as a run, of";
        case Setting::sequence_resumption:
            return "a resumption of";
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
