#pragma once

#include <cstddef>
#include <optional>

#include "lsdem/results/history.hpp"

/// Motion as it is seen from the base: by someone who stands on it and turns with it. Axes are the world's at t = 0.
namespace musim::lsdem {

/// Has the base turned since the start?
inline bool has_turned(const BaseState& base) { return !base.turn.vec().isZero(0.0); }

/// Has it, or does it turn now?
inline bool turns(const BaseState& base) {
    return has_turned(base) || !base.turn_rates.velocity.isZero(0.0) || !base.turn_rates.acceleration.isZero(0.0);
}

/// Where a point at `x` would be, had the base been displaced, but not turned [m]: its bits are those of `x` where the base has not turned.
Vector3 turn_back(const BaseState& base, const Vector3& x);
/// Orientation seen from the base, turn⁻¹ q, body to world; likewise.
Quaternion turn_back(const BaseState& base, const Quaternion& orientation);

/// Displacement of what was at `start` at t = 0 and is at `now`, seen from the base: seen_from_base(now) − start [m].
Vector3 find_moved(const BaseState& base, const Vector3& start, const Vector3& now);
/// The same of a block of the spine at a sample.
Vector3 find_moved(const RunData& run, std::size_t spine_block, std::size_t sample);

/// Velocity of what is at `x` and moves at `velocity`, seen from the base: turn⁻¹ (velocity − that of the base there) [m/s].
Vector3 find_velocity_on_base(const BaseState& base, const Vector3& x, const Vector3& velocity);
/// The same, with the velocity of the base's pivot left in: what travels up a structure from a base that slides and turns [m/s].
Vector3 find_unturned_velocity(const BaseState& base, const Vector3& x, const Vector3& velocity);

/// Largest turn of the base over the samples, and its rate.
struct BaseTurn {
    double angle = 0.0;         ///< from its orientation at the start, at most half a turn [rad]
    double angle_at_end = 0.0;  ///< [rad]
    double rate = 0.0;          ///< magnitude of the angular velocity [rad/s]
};
/// Nothing of a base that never turns.
std::optional<BaseTurn> find_base_turn(const History& history);

}  // namespace musim::lsdem
