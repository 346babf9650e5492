#include "lsdem/results/base_frame.hpp"

#include <algorithm>
#include <cmath>

namespace musim::lsdem {
namespace {

Vector3 turn_direction_back(const BaseState& base, const Vector3& direction) {
    return has_turned(base) ? Vector3(base.turn.conjugate() * direction) : direction;
}

}  // namespace

Vector3 turn_back(const BaseState& base, const Vector3& x) {
    return has_turned(base) ? Vector3(base.seen_from_base(x) + base.displacement) : x;
}

Quaternion turn_back(const BaseState& base, const Quaternion& orientation) {
    return has_turned(base) ? base.turn.conjugate() * orientation : orientation;
}

Vector3 find_moved(const BaseState& base, const Vector3& start, const Vector3& now) {
    return turn_back(base, now) - start - base.displacement;
}

Vector3 find_moved(const RunData& run, std::size_t spine_block, std::size_t sample) {
    const History& h = run.history;
    const Vector3& start = h.spine_position[spine_block];
    return find_moved(h.base[sample], start, h.spine_position[sample * run.spine.size() + spine_block]) + h.base.front().displacement;
}

Vector3 find_velocity_on_base(const BaseState& base, const Vector3& x, const Vector3& velocity) {
    return turn_direction_back(base, velocity - base.velocity_at(x));
}

Vector3 find_unturned_velocity(const BaseState& base, const Vector3& x, const Vector3& velocity) {
    return turn_direction_back(base, velocity - base.turn_rates.velocity.cross(x - base.displacement - base.pivot));
}

std::optional<BaseTurn> find_base_turn(const History& history) {
    if (std::none_of(history.base.begin(), history.base.end(), turns)) return std::nullopt;
    BaseTurn turn;
    for (const BaseState& base : history.base) {
        turn.angle_at_end = 2.0 * std::atan2(base.turn.vec().norm(), std::abs(base.turn.w()));
        turn.angle = std::max(turn.angle, turn.angle_at_end);
        turn.rate = std::max(turn.rate, base.turn_rates.velocity.norm());
    }
    return turn;
}

}  // namespace musim::lsdem
