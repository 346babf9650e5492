#include "lsdem/scene/scene_key.hpp"

#include "scaling/setting.hpp"

namespace musim::lsdem {

std::string_view scene_key(Setting setting) {
    switch (setting) {
        case Setting::time_step:
            return "\"dt\"";
        case Setting::unit:
            return "\"unit\"";
        case Setting::quantity:
            return "\"quantity\"";
        case Setting::sensitivity:
            return "\"sensitivity\"";
        case Setting::station_response:
            return "\"station_xml\"";
        case Setting::columns:
            return "\"columns\"";
        case Setting::skipped_lines:
            return "\"skip\"";
        case Setting::factor:
            return "\"set\": {\"NAME\": NUMBER}";
        default:
            return plain_name(setting);
    }
}

}  // namespace musim::lsdem
