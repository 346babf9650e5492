#include "records/headers/direction.hpp"

#include "records/detail/text.hpp"
#include "records/ground_motion.hpp"

namespace musim::records::detail {

std::optional<double> parse_bearing(std::string_view text) {
    if (text.size() < 3) return std::nullopt;
    const char from = to_lower(text.front());
    const char toward = to_lower(text.back());
    if ((from != 'n' && from != 's') || (toward != 'e' && toward != 'w')) return std::nullopt;
    const std::optional<double> angle = parse_real(text.substr(1, text.size() - 2));
    if (!angle || *angle < 0.0 || *angle > 90.0) return std::nullopt;

    if (from == 'n') return toward == 'e' || *angle == 0.0 ? *angle : 360.0 - *angle;
    return toward == 'e' ? 180.0 - *angle : 180.0 + *angle;
}

bool is_axis(std::string_view name) { return azimuth_of_axis(name) || equal_ignoring_case(name, "U-D") || equal_ignoring_case(name, "UD"); }

std::optional<double> azimuth_of_axis(std::string_view name) {
    if (equal_ignoring_case(name, "N-S") || equal_ignoring_case(name, "NS")) return 0.0;
    if (equal_ignoring_case(name, "E-W") || equal_ignoring_case(name, "EW")) return 90.0;
    return std::nullopt;
}

Direction read_direction(std::string_view text) {
    Direction direction;
    const std::string_view words = trim(text);
    const std::size_t degrees = find_ignoring_case(words, " DEG");
    direction.name = trim(words.substr(0, degrees));
    if (degrees != std::string_view::npos) {
        direction.azimuth_deg = parse_real(direction.name);
    } else if (const std::optional<double> axis = azimuth_of_axis(words)) {
        direction.azimuth_deg = axis;
    } else if (const std::optional<double> bearing = parse_bearing(words)) {
        direction.azimuth_deg = bearing;
    } else {
        direction.azimuth_deg = find_azimuth_deg(words);
    }
    return direction;
}

}  // namespace musim::records::detail
