#pragma once

#include "lsdem/types.hpp"

namespace musim::lsdem {

/// Motion of a block over the last step, in world axes.
struct BodyStep {
    Quaternion turn = Quaternion::Identity();  ///< from the pose at step n − 1 to that at n
    Vector3 shift = Vector3::Zero();           ///< of the centre [m]
    /// Length of the way that no point of the block has exceeded, seen from the base, up to step n: grows and never falls [m].
    double travel = 0.0;
};

/// Where a block is at step n, how large it is, and how it came there: what contacts read, in three lines of the cache.
struct alignas(64) BodyPose {
    Matrix3 rotation = Matrix3::Identity();  ///< body to world
    Vector3 position = Vector3::Zero();      ///< of the centre [m]
    Vector3 half = Vector3::Zero();          ///< half extents, the own height included, body frame [m]
    double height_offset = 0.0;              ///< Δ, see Block [m]
    BodyStep step;                           ///< from n − 1 to n

    /// Shift over the step of the body's point that is at `x` now, world frame [m].
    Vector3 shift_of(const Vector3& x) const {
        // v − T⁻¹ v = 2w (u×v) − 2 u×(u×v)
        const Vector3 arm = x - position, half_turn = step.turn.vec(), across = half_turn.cross(arm);
        return step.shift + 2.0 * (step.turn.w() * across - half_turn.cross(across));
    }
};

}  // namespace musim::lsdem
