#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace musim::records::detail {

/// Azimuth of a compass bearing [deg clockwise from north]: "N10E" → 10, "N80W" → 280, "S16W" → 196; nothing for anything else.
std::optional<double> parse_bearing(std::string_view text);

/// True for the names of axes: "N-S", "NS", "E-W", "EW", "U-D", "UD", in any case.
bool is_axis(std::string_view name);

/// Azimuth of an axis by its first letter, the positive direction: "N-S" → 0, "E-W" → 90; nothing for "U-D" and for anything else.
std::optional<double> azimuth_of_axis(std::string_view name);

/// A channel's direction as its title gives it.
struct Direction {
    std::string name = {};
    std::optional<double> azimuth_deg = {};  ///< clockwise from north; vertical or unknown: nothing
};

/// "360 Deg" → 360°, "NS" and "EW" → 0° and 90°, "N08W" → 352°; "Up", "Z", "Other" → no azimuth. The name is the text without its "Deg".
Direction read_direction(std::string_view text);

}  // namespace musim::records::detail
