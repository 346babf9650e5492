#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace musim::records::detail {

/// A channel's direction as its title gives it.
struct Direction {
    std::string name = {};
    std::optional<double> azimuth_deg = {};  ///< clockwise from north; vertical or unknown: nothing
};

/// "360 Deg" → 360°, "NS" and "EW" → 0° and 90°, "N08W" → 352°; "Up", "Z", "Other" → no azimuth. The name is the text without its "Deg".
Direction read_direction(std::string_view text);

}  // namespace musim::records::detail
