#include "lsdem/response/color_map.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace musim::lsdem::detail {

std::string find_color(const ColorMap& map, double place) {
    const double scaled = std::clamp(place, 0.0, 1.0) * static_cast<double>(map.size() - 1);
    const auto index = std::min(static_cast<std::size_t>(scaled), map.size() - 2);
    const double f = scaled - static_cast<double>(index);
    std::array<int, 3> rgb{};
    for (std::size_t c = 0; c < 3; ++c) rgb[c] = static_cast<int>(std::lround((1.0 - f) * map[index][c] + f * map[index + 1][c]));
    return fmt::format("#{:02x}{:02x}{:02x}", rgb[0], rgb[1], rgb[2]);
}

}  // namespace musim::lsdem::detail
