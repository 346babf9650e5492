#pragma once

#include <array>
#include <cmath>
#include <cstddef>

namespace musim::lsdem::detail {

/// A rotation by an angle [rad] about a coordinate axis (0, 1, 2), (w, x, y, z) of any length; exact for quarter turns.
inline std::array<double, 4> turn_about(std::size_t axis, double angle) {
    constexpr double kExact = 1e-15;
    double w = std::cos(0.5 * angle), v = std::sin(0.5 * angle);
    if (std::abs(w) < kExact) w = 0.0, v = 1.0;
    if (std::abs(v) < kExact) w = 1.0, v = 0.0;
    if (std::abs(std::abs(w) - std::abs(v)) < kExact) w = 1.0, v = std::copysign(1.0, v) * std::copysign(1.0, std::cos(0.5 * angle));
    std::array<double, 4> turn{w, 0.0, 0.0, 0.0};
    turn[axis + 1] = v;
    return turn;
}

}  // namespace musim::lsdem::detail
