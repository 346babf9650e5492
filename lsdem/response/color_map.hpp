#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

namespace musim::lsdem::detail {

/// Red, green, blue, 0 to 255 each.
using Color = std::array<double, 3>;

/// Colours at even places from 0 to 1; linear in between.
using ColorMap = std::array<Color, 11>;

/// For values that lie about zero: blue, white in the middle, red; ColorBrewer's RdBu, blue first.
inline constexpr ColorMap kDivergingMap{{{5, 48, 97},
                                         {33, 102, 172},
                                         {67, 147, 195},
                                         {146, 197, 222},
                                         {209, 229, 240},
                                         {247, 247, 247},
                                         {253, 219, 199},
                                         {244, 165, 130},
                                         {214, 96, 77},
                                         {178, 24, 43},
                                         {103, 0, 31}}};

/// For values from zero: even steps of it look even, also in grey; matplotlib's viridis.
inline constexpr ColorMap kSequentialMap{{{68, 1, 84},
                                          {72, 36, 117},
                                          {65, 68, 135},
                                          {53, 95, 141},
                                          {42, 120, 142},
                                          {33, 145, 140},
                                          {34, 168, 132},
                                          {68, 191, 112},
                                          {122, 209, 81},
                                          {189, 223, 38},
                                          {253, 231, 37}}};

/// Colour of a place in a map, 0 to 1, as "#rrggbb"; places beyond the ends get the colours there.
inline std::string find_color(const ColorMap& map, double place) {
    const double scaled = std::clamp(place, 0.0, 1.0) * static_cast<double>(map.size() - 1);
    const auto index = std::min(static_cast<std::size_t>(scaled), map.size() - 2);
    const double f = scaled - static_cast<double>(index);
    std::array<int, 3> rgb{};
    for (std::size_t c = 0; c < 3; ++c) rgb[c] = static_cast<int>(std::lround((1.0 - f) * map[index][c] + f * map[index + 1][c]));
    return fmt::format("#{:02x}{:02x}{:02x}", rgb[0], rgb[1], rgb[2]);
}

}  // namespace musim::lsdem::detail
