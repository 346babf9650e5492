#pragma once

#include <numbers>

#include "lsdem/types.hpp"

namespace musim::lsdem {

/// A block has fallen when it has sunk by more than this part of its height [-].
inline constexpr double kFallenDrop = 0.25;

/// Has a block fallen: sunk by more than a quarter of its height at the start, or turned by more than 45° from its upright at the start?
///
/// `height`: from its lowest to its highest point at the start [m]; `start`: body to world; `now`: body to the base, turned back to where
/// it was at the start; `sunk`: seen from the base, since the start [m].
inline bool has_fallen(double height, const Matrix3& start, const Matrix3& now, double sunk) {
    return sunk > kFallenDrop * height || now.row(2).dot(start.row(2)) < std::numbers::sqrt2 / 2.0;
}

/// The same of a block that fills its box of half extents `half_extents`, body frame [m].
inline bool has_fallen(const Vector3& half_extents, const Matrix3& start, const Matrix3& now, double sunk) {
    return has_fallen(2.0 * start.row(2).cwiseAbs().dot(half_extents), start, now, sunk);
}

}  // namespace musim::lsdem
