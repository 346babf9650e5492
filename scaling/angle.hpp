#pragma once

#include <numbers>

namespace musim::scaling {

/// One degree; angles are plain numbers, in radians.
inline constexpr double kDegree = std::numbers::pi / 180.0;
inline constexpr double kDegrees = 180.0 / std::numbers::pi;  ///< of one radian

}  // namespace musim::scaling
