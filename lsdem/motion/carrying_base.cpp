#include "lsdem/motion/carrying_base.hpp"

#include <algorithm>

namespace musim::lsdem {
namespace {

/// The turn of a step as a vector, 2w·v: its axis times the sine of its angle, as contacts have it.
Vector3 turn_of(const BodyStep& step) { return (2.0 * step.turn.w()) * step.turn.vec(); }

}  // namespace

void CarryingBase::restart(const Bodies& bodies) {
    origin_ = bodies.pose.back().position - motion_.displacement(0.0);
    unturned_ = motion_.turn(0.0).conjugate() * bodies.orientation.back();
    work_ = 0.0;
}

void CarryingBase::put_ground(double time, Bodies& bodies) const {
    BodyPose& ground = bodies.pose.back();
    ground.position = origin_ + motion_.displacement(time);
    if (!motion_.turns()) return;  // it keeps its orientation
    bodies.orientation.back() = motion_.turn(time) * unturned_;
    ground.rotation = bodies.orientation.back().toRotationMatrix();
    // the pivot keeps its place in the ground
    ground.position += orientation_at_begin() * motion_.pivot() - ground.rotation * motion_.pivot();
}

void CarryingBase::move_ground(std::optional<double> time, double h, Bodies& bodies) const {
    BodyPose& ground = bodies.pose.back();
    const Vector3 before = ground.position;
    const Quaternion orientation_before = bodies.orientation.back();
    bodies.elapsed = h;
    if (time) put_ground(*time, bodies);
    ground.step.shift = ground.position - before;
    ground.step.turn = bodies.orientation.back() * orientation_before.conjugate();
}

void CarryingBase::push_carried(Bodies& bodies) const {
    const BodyStep& step = bodies.pose.back().step;
    const Vector3 before = bodies.pose.back().position - step.shift;
    for (const std::size_t i : carried_) {
        // T v − v = 2w (u×v) + 2 u×(u×v)
        const Vector3 arm = bodies.pose[i].position - before, half_turn = step.turn.vec(), across = half_turn.cross(arm);
        bodies.velocity[i] = (step.shift + 2.0 * (step.turn.w() * across + half_turn.cross(across))) / bodies.elapsed;
    }
}

void CarryingBase::turn_carried(Bodies& bodies) const {
    if (!is_turned()) return;
    const Quaternion& turn = bodies.pose.back().step.turn;
    for (const std::size_t i : carried_) {
        bodies.orientation[i] = (turn * bodies.orientation[i]).normalized();
        bodies.pose[i].rotation = bodies.orientation[i].toRotationMatrix();
        bodies.pose[i].step.turn = turn;
    }
}

void CarryingBase::bear(const detail::TouchList& touches, const std::vector<PairForce>& forces, const Bodies& bodies) {
    const BodyPose& ground = bodies.pose.back();
    const detail::TouchList::Load on_ground = touches.sum(bodies.ground(), forces);
    Vector3 force = Vector3::Zero() - on_ground.force, couple = Vector3::Zero() - on_ground.torque;
    for (const std::size_t i : carried_) {
        const detail::TouchList::Load load = touches.sum(i, forces);
        force -= load.force;
        couple -= load.torque + (bodies.pose[i].position - ground.position).cross(load.force);
    }
    work_ += 0.5 * (force_ + force).dot(ground.step.shift);
    if (is_turned()) work_ += 0.5 * (couple_ + couple).dot(turn_of(ground.step));
    force_ = force, couple_ = couple;
}

Vector3 CarryingBase::displacement(const Bodies& bodies) const {
    const BodyPose& ground = bodies.pose.back();
    const Vector3 moved = ground.position - origin_;
    if (!motion_.turns()) return moved;
    return moved + (ground.rotation * motion_.pivot() - orientation_at_begin() * motion_.pivot());
}

Quaternion CarryingBase::turn(const Bodies& bodies) const { return bodies.orientation.back() * orientation_at_begin().conjugate(); }

Vector3 CarryingBase::pivot_place() const { return origin_ + orientation_at_begin() * motion_.pivot(); }

bool CarryingBase::carries(std::size_t block) const { return std::find(carried_.begin(), carried_.end(), block) != carried_.end(); }

void CarryingBase::exchange(Archive& archive) { archive(origin_, unturned_, force_, couple_, work_); }

}  // namespace musim::lsdem
