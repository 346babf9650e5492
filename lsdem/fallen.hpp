#pragma once

#include <numbers>

#include "lsdem/types.hpp"

namespace musim::lsdem {

/// A block has fallen when it has sunk by more than this part of its height [-].
inline constexpr double kFallenDrop = 0.25;

/// Has a block fallen: sunk by more than a quarter of its height at the start, or turned by more than 45° from its upright at the start?
///
/// `half_extents`: of its box, body frame [m]; `start`, `now`: body to world; `sunk`: relative to the base since the start [m].
inline bool has_fallen(const Vector3& half_extents, const Matrix3& start, const Matrix3& now, double sunk) {
    const double height = 2.0 * start.row(2).cwiseAbs().dot(half_extents);
    return sunk > kFallenDrop * height || now.row(2).dot(start.row(2)) < std::numbers::sqrt2 / 2.0;
}

}  // namespace musim::lsdem
