#include "lsdem/motion/mass_scaling.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/Eigenvalues>

#include "lsdem/block_height.hpp"
#include "lsdem/contact/area_stiffness.hpp"

namespace musim::lsdem::detail {
namespace {

/// Blocks get this much more than the bound asks for, which takes all of a contact to be at a corner.
constexpr double kMargin = 1.25;

/// Mass scaling falls by no more than this part in a step. What contacts ask for jumps whenever nodes touch or part; at 1/1000 a block
/// that tips is slowed down at every node it meets, and layers of six lean more by a twentieth, at 1/5000 by nothing that is seen.
constexpr double kRecovery = 2e-4;

}  // namespace

MassScaling::Mobility MassScaling::find_mobility(const Model& model, const Block& block) {
    Mobility mobility;
    if (block.rotation_locked) return mobility;
    const Vector3 corner = half_extents(model, block);
    const Matrix3 arm = cross_matrix(corner);
    const Vector3 per_inertia = inertia_over_mass(model, block).cwiseInverse();
    const Matrix3 at_corner = Matrix3::Identity() + arm * per_inertia.asDiagonal() * arm.transpose();
    mobility.any = Eigen::SelfAdjointEigenSolver<Matrix3>(at_corner, Eigen::EigenvaluesOnly).eigenvalues().maxCoeff();
    mobility.along = at_corner.diagonal();
    return mobility;
}

void MassScaling::begin(const Model& model, double dt, ContactList& list) {
    dt_ = dt;
    gravity_ = model.gravity;
    mobilities_.clear();
    for (const Block& block : model.blocks) mobilities_.push_back(find_mobility(model, block));
    list.demand.wanted = true;
    list.demand.asked.resize(list.pairs.size());
    price(list);
}

void MassScaling::end(Bodies& bodies, ContactList& list) {
    if (!is_active()) return;
    mobilities_.clear();
    list.demand = {};
    for (std::size_t i = 0; i < bodies.size(); ++i) bodies.free[i] = bodies.fixed[i] != 0 ? 0.0 : 1.0;
}

double MassScaling::price_of(const ContactPair& pair) const {
    const Mobility& a = mobilities_[pair.leader];
    const bool is_bounded = pair.follower < mobilities_.size();  // by a block
    const Mobility& b = is_bounded ? mobilities_[pair.follower] : a;
    const double any = std::max(a.any, b.any);
    double along = any;
    if (pair.leader_axis < 3) along = a.along[pair.leader_axis];
    if (pair.follower_axis < 3) along = std::max(along, b.along[pair.follower_axis]);
    const double sides = is_bounded ? 2.0 : 1.0;
    const double stiffness = any * std::max(pair.law.normal_stiffness, pair.law.shear_stiffness);
    const double damping = std::max(along * pair.law.normal_damping, any * pair.law.shear_damping);
    return kMargin * sides * (stiffness * (0.25 * dt_ * dt_) + damping * (0.5 * dt_));
}

void MassScaling::price(ContactList& list) const {
    list.demand.per_area.resize(list.pairs.size());
    for (std::size_t p = 0; p < list.pairs.size(); ++p) list.demand.per_area[p] = price_of(list.pairs[p]);
}

void MassScaling::slow_down(std::size_t i, double factor, const TouchList::Load& load, Bodies& bodies) const {
    Vector3 &velocity = bodies.velocity[i], &momentum = bodies.momentum[i];
    const Matrix3 to_world = bodies.orientation[i].toRotationMatrix();
    const Vector3 spin = to_world * bodies.inverse_inertia[i].cwiseProduct(to_world.transpose() * momentum);
    const Vector3 push = load.force + bodies.mass[i] * gravity_;
    const double twice_kinetic = bodies.mass[i] * velocity.squaredNorm() + momentum.dot(spin);
    const double power = push.dot(velocity) + load.torque.dot(spin);
    bodies.preparation_loss[i] += 0.5 * (1.0 - factor) * ((1.0 + factor) * twice_kinetic + dt_ * power);
    velocity *= factor;
    momentum *= factor;
}

void MassScaling::give(const TouchList& touches, const ContactList& list, std::size_t first, std::size_t last, Bodies& bodies) const {
    for (std::size_t i = first; i < last; ++i) {
        if (bodies.fixed[i] != 0) continue;
        const double needed = touches.sum(i, list.demand.asked), mass = bodies.mass[i];
        const double most = needed > mass ? mass / needed : 1.0;
        if (most < bodies.free[i]) {
            slow_down(i, most / bodies.free[i], touches.sum(i, list.forces), bodies);
            bodies.free[i] = most;
        } else {
            bodies.free[i] = std::min(most, (1.0 + kRecovery) * bodies.free[i]);
        }
    }
}

}  // namespace musim::lsdem::detail
