#include "records/headers/bearing.hpp"

#include "records/detail/text.hpp"

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

}  // namespace musim::records::detail
