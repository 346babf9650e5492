#include "records/detail/direction.hpp"

#include "records/detail/text.hpp"
#include "records/ground_motion.hpp"

namespace musim::records::detail {
namespace {

// "N08W": degrees from north or south towards east or west
std::optional<double> find_bearing_deg(std::string_view text) {
    if (text.size() < 3) return std::nullopt;
    const char pole = to_lower(text.front());
    const char side = to_lower(text.back());
    const std::optional<std::size_t> angle = parse_count(text.substr(1, text.size() - 2));
    if (!angle || *angle > 90 || (pole != 'n' && pole != 's') || (side != 'e' && side != 'w')) return std::nullopt;
    const double from_pole = static_cast<double>(*angle);
    if (pole == 'n') return side == 'e' || *angle == 0 ? from_pole : 360.0 - from_pole;
    return side == 'e' ? 180.0 - from_pole : 180.0 + from_pole;
}

}  // namespace

Direction read_direction(std::string_view text) {
    Direction direction;
    const std::string_view words = trim(text);
    const std::size_t degrees = find_ignoring_case(words, " DEG");
    direction.name = trim(words.substr(0, degrees));
    if (degrees != std::string_view::npos) {
        direction.azimuth_deg = parse_real(direction.name);
    } else if (equal_ignoring_case(words, "NS")) {
        direction.azimuth_deg = 0.0;
    } else if (equal_ignoring_case(words, "EW")) {
        direction.azimuth_deg = 90.0;
    } else if (const std::optional<double> bearing = find_bearing_deg(words)) {
        direction.azimuth_deg = bearing;
    } else {
        direction.azimuth_deg = find_azimuth_deg(words);
    }
    return direction;
}

}  // namespace musim::records::detail
