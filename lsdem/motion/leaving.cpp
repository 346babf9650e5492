#include "lsdem/motion/leaving.hpp"

#include "lsdem/solid/outline.hpp"

namespace musim::lsdem::detail {
namespace {

/// Cosine of the angle by which block i has turned from its upright in the model, seen from the ground [-].
double find_uprightness(const Model& model, const Bodies& bodies, std::size_t i) {
    const Vector3 up = model.blocks[i].orientation.toRotationMatrix().transpose() * bodies.drawn_up;
    return up.dot(bodies.pose[i].rotation.transpose() * bodies.up());
}

/// Is block i farther than `gap` [m] from the ground and from all other blocks?
bool is_in_the_air(const Model& model, const Bodies& bodies, std::size_t i, double gap) {
    const BodyPose& a = bodies.pose[i];
    if (model.ground.present && bodies.find_height(i) <= gap) return false;
    for (std::size_t j = 0; j < bodies.size(); ++j) {
        if (j == i) continue;
        const BodyPose& b = bodies.pose[j];
        const Vector3 offset = a.position - b.position;
        if (offset.norm() > a.half.norm() + b.half.norm() + gap) continue;
        const Matrix3 to_b = b.rotation.transpose();
        const Placing place{to_b * a.rotation, to_b * offset};
        if (find_clearance({b.half, bodies.solid[j]}, {a.half, bodies.solid[i]}, place, gap) <= gap) return false;
    }
    return true;
}

}  // namespace

std::optional<std::size_t> find_block_out_of_place(const Model& model, const Bodies& bodies, const TouchList& touches,
                                                   const std::vector<PairForce>& forces) {
    if (!model.ground.present && bodies.size() == 1) return std::nullopt;  // there is nothing to land on
    for (std::size_t i = 0; i < bodies.size(); ++i) {
        if (bodies.fixed[i] != 0) continue;
        const BodyPose& pose = bodies.pose[i];
        if (find_uprightness(model, bodies, i) < kLeavingTurn) return i;
        if (!touches.sum(i, forces).force.isZero(0.0)) continue;
        if (is_in_the_air(model, bodies, i, kLeavingGap * 2.0 * pose.half.minCoeff())) return i;
    }
    return std::nullopt;
}

}  // namespace musim::lsdem::detail
