#include "records/headers/direction.hpp"

#include "records/detail/text.hpp"
#include "records/ground_motion.hpp"
#include "records/headers/bearing.hpp"

namespace musim::records::detail {

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
