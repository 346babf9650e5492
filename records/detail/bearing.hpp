#pragma once

#include <optional>
#include <string_view>

namespace musim::records::detail {

/// Azimuth of a compass bearing [deg clockwise from north]: "N10E" → 10, "N80W" → 280, "S16W" → 196; nothing for anything else.
std::optional<double> parse_bearing(std::string_view text);

}  // namespace musim::records::detail
