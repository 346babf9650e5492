#include "lsdem/motion/applied_loads.hpp"

#include <algorithm>
#include <limits>

namespace musim::lsdem {

AppliedLoads::AppliedLoads(const Model& model) {
    for (const Load& load : model.loads) {
        loads_.push_back({.load = load, .damping = load.is_actuator() ? find_actuator_damping(model, load) : 0.0});
    }
}

std::vector<std::uint32_t> AppliedLoads::blocks() const {
    std::vector<std::uint32_t> blocks;
    for (const Applied& applied : loads_) blocks.push_back(static_cast<std::uint32_t>(applied.load.block));
    return blocks;
}

void AppliedLoads::restart(const Bodies& bodies) {
    for (Applied& applied : loads_) {
        const BodyPose& pose = bodies.pose[applied.load.block];
        applied.has_begun = false;
        applied.place = pose.position + pose.rotation * applied.load.point;
        applied.force = 0.0;
    }
    work_ = 0.0;
}

void AppliedLoads::apply(const Bodies& bodies, double time, double h, std::span<PairForce> forces) {
    for (std::size_t k = 0; k < loads_.size(); ++k) {
        Applied& applied = loads_[k];
        const Load& load = applied.load;
        const BodyPose& pose = bodies.pose[load.block];
        const Vector3 arm = pose.rotation * load.point, place = pose.position + arm;
        const double moved = load.direction.dot(place - applied.place), before = applied.force;
        applied.place = place;
        if (!applied.has_begun && time >= load.start) applied.has_begun = true, applied.origin = place;

        applied.force = applied.has_begun ? load.force * load.part_at(time) : 0.0;
        if (applied.has_begun && load.is_actuator()) {
            const double end = load.displacement * load.part_at(time), end_moved = end - load.displacement * load.part_at(time - h);
            applied.force = load.stiffness * (end - load.direction.dot(place - applied.origin)) + applied.damping * (end_moved - moved) / h;
        }
        work_ += 0.5 * (before + applied.force) * moved;
        forces[k].force = applied.force * load.direction;
        forces[k].leader_torque = arm.cross(forces[k].force);
    }
}

double AppliedLoads::still_until(double time) const {
    double until = std::numeric_limits<double>::infinity();
    for (const Applied& applied : loads_) {
        if (time < applied.load.start + applied.load.rise) until = std::min(until, std::max(time, applied.load.start));
    }
    return until;
}

std::vector<LoadState> AppliedLoads::states() const {
    std::vector<LoadState> states;
    for (const Applied& applied : loads_) {
        const double displacement = applied.has_begun ? applied.load.direction.dot(applied.place - applied.origin) : 0.0;
        states.push_back({applied.force, displacement});
    }
    return states;
}

void exchange(Archive& archive, AppliedLoads::Applied& applied) {
    archive(applied.has_begun, applied.origin, applied.place, applied.force);
}

void exchange(Archive& archive, AppliedLoads& loads) {
    for (AppliedLoads::Applied& applied : loads.loads_) archive(applied);
    archive(loads.work_);
}

}  // namespace musim::lsdem
