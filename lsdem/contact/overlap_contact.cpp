#include "lsdem/contact/overlap_contact.hpp"

#include <algorithm>
#include <cmath>

namespace musim::lsdem {
namespace {

/// The mean distance r̄ of the pressure from its middle is no less than this part of √(J/S) [-]: 0.87 for a strip pressed evenly, 0.66 for
/// one pressed like a wedge, less for a part of it. Only decides whether r̄ has to be computed.
constexpr double kLeastReach = 0.3;

/// Turns a vector with the mean turn of both bodies over the step, without changing its length.
Vector3 carried(const Vector3& v, const PairMotion& motion) {
    const Vector3 half = 0.25 * (motion.turned(0) + motion.turned(1));
    const Vector3 across = half.cross(v);
    return v + 2.0 / (1.0 + half.squaredNorm()) * (across + half.cross(across));
}

/// Friction of a contact: a force across the normal at `arm` from where the pressure acts, and a couple about the normal.
struct Friction {
    Vector3 force;
    double couple;
};

/// The limit of friction as a whole: |f|² + (m/r̄)² ≤ (μN)², m about where the pressure acts [GoyalRuinaPapadopoulos91].
struct Limit {
    double force, reach;
    Vector3 arm;  ///< of the friction's force from where the pressure acts [m]
    Vector3 normal;

    double about_pressure(const Friction& friction) const { return friction.couple + normal.dot(arm.cross(friction.force)); }
    /// How far beyond the limit, 0 on it, in squares of it.
    double excess(const Friction& friction) const {
        const double turning = about_pressure(friction) / reach;
        return (friction.force.squaredNorm() + turning * turning) / (force * force) - 1.0;
    }
    /// Back to the limit: first along the slip that it goes with, which is normal to the limit, then in proportion. The first makes the
    /// slip of a steady slide what the bodies do, the second makes the limit hold.
    void hold(double stiffness, double turning_stiffness, Friction& friction) const {
        const double beyond = excess(friction);
        if (!(beyond > 0.0)) return;
        const Vector3 slip = friction.force / (force * force);
        const double turn = about_pressure(friction) / (force * force * reach * reach);
        const Vector3 change = -stiffness * (slip + turn * normal.cross(arm));
        const double couple_change = -turning_stiffness * turn;
        const double slope = 2.0 * (slip.dot(change) + turn * (couple_change + normal.dot(arm.cross(change))));
        if (slope < 0.0) {
            const double part = beyond / -slope;
            friction.force += part * change;
            friction.couple += part * couple_change;
        }
        const double left = excess(friction);
        if (!(left > 0.0)) return;
        const double scale = 1.0 / std::sqrt(1.0 + left);
        friction.force *= scale;
        friction.couple *= scale;
    }
};

/// A convex region reaches no farther from its middle in any direction than this times the root of its second moment over its area: 2√2 for
/// a triangle [-].
constexpr double kReachOfConvex = 2.9;

/// May springs and dashpots together pull anywhere? False only where they surely do not.
bool may_pull(const ContactArea& area, const AffinePressure& dashpot, double stiffness) {
    if (!area.depth || !(area.area > 0.0)) return true;
    const Vector3 slope = stiffness * area.depth->slope + dashpot.slope;
    const double lowest = kReachOfConvex * std::sqrt(std::max(0.0, slope.dot(area.second * slope)) / area.area);
    return stiffness * area.depth->middle + dashpot.at < lowest;
}

}  // namespace

void OverlapBodies::place(PlacedSolid& a, PlacedSolid& b) const {
    place_box(*half_[0], *rotation_[0], center_[0], a);
    if (rotation_[1] != nullptr) {
        place_box(*half_[1], *rotation_[1], center_[1], b);
    } else {
        place_half_space(ground_, center_[0], half_[0]->norm(), b);
    }
}

const OverlapPieces& OverlapBodies::pieces() {
    if (is_cut_) return *pieces_;
    is_cut_ = true;
    PlacedSolid a, b;
    place(a, b);
    pieces_->cut(a, b);
    return *pieces_;
}

double OverlapBodies::energy() {
    PlacedSolid a, b;
    place(a, b);
    return compute_overlap_energy(a, b, pieces());
}

OverlapGeometry find_overlap_geometry(const OverlapPieces& pieces) {
    OverlapGeometry geometry{sum_load(pieces), {}};
    if (geometry.touches()) geometry.area = find_contact_area(pieces, geometry.pressed());
    return geometry;
}

OverlapForces compute_overlap_contact(const OverlapGeometry& geometry, const PairMotion& motion, const Interface& law, double dt,
                                      bool first_step, double stored_shear, OverlapBodies& bodies, OverlapContact& contact) {
    const OverlapContact before = contact;
    contact = OverlapContact{};
    OverlapForces result;
    if (geometry.touches()) {
        const OverlapLoad& load = geometry.load;
        const double push = law.normal_stiffness * load.force.norm();
        const Vector3 normal = load.force.normalized(), pressed = geometry.pressed(), &arm = geometry.area.arm;
        const double area = geometry.area.area, polar = geometry.area.polar(normal);
        contact.touches = true;
        contact.area = area;
        contact.polar = polar;
        contact.place = pressed + arm;

        // of a first touch, the part of the step that came after it
        const double sunk = -normal.dot(motion.displacement(pressed));
        const double part = !before.touches && sunk > load.deepest ? load.deepest / sunk : 1.0;

        // dashpots: C ḋ everywhere, less where that would pull more than the springs push
        const double rate = part * law.normal_damping / dt;
        const AffinePressure dashpot{-rate * normal.dot(motion.displacement(contact.place)),
                                     -rate * (motion.turn[0] * normal - motion.turn[1] * normal), contact.place};
        PressureMoments held;
        if (may_pull(geometry.area, dashpot, law.normal_stiffness)) held = find_pull(bodies.pieces(), dashpot, law.normal_stiffness);
        const double damping = dashpot.at * area + held.sum;
        contact.damping.force = damping * normal;
        contact.damping.couple = (geometry.area.second * dashpot.slope + held.at).cross(normal);

        // springs of friction: a smaller area keeps its slip, a larger one its force, so that neither gives energy
        const double stiffness = law.shear_stiffness * area, turning_stiffness = law.shear_stiffness * polar;
        const double kept = area < before.area ? area / before.area : 1.0;
        const double kept_turn = polar < before.polar ? polar / before.polar : 1.0;
        const Vector3 shear = carried(before.shear, motion), slipped = motion.displacement(contact.place);
        const double slip_part = first_step ? 0.0 : part;
        const Vector3 slip = slip_part * (slipped - normal.dot(slipped) * normal);
        const double turn = slip_part * normal.dot(motion.turned(1) - motion.turned(0));
        const double viscous = law.shear_stiffness > 0.0 ? law.shear_damping / (law.shear_stiffness * dt) : 0.0;
        Friction springs{kept * (shear - normal.dot(shear) * normal) - stiffness * slip,
                         kept_turn * before.couple - turning_stiffness * turn};
        Friction drag{-viscous * stiffness * slip, -viscous * turning_stiffness * turn};
        Friction friction{springs.force + drag.force, springs.couple + drag.couple};

        Limit limit{law.friction * std::max(0.0, push + damping), 0.0, arm - normal.dot(arm) * normal, normal};
        if (limit.force > 0.0 && polar > 0.0) {
            limit.reach = kLeastReach * std::sqrt(polar / area);
            if (limit.excess(friction) > 0.0) {
                limit.reach = find_reach(bodies.pieces(), normal, pressed);
                const double beyond = limit.reach > 0.0 ? limit.excess(friction) : 0.0;
                if (beyond > 0.0) {
                    // dashpots give up their share, in proportion
                    limit.hold(stiffness, turning_stiffness, friction);
                    const double left = 1.0 / std::sqrt(1.0 + beyond);
                    drag = {left * drag.force, left * drag.couple};
                    springs = {friction.force - drag.force, friction.couple - drag.couple};
                }
            }
        }
        if (!(limit.force > 0.0 && limit.reach > 0.0)) springs = friction = drag = {Vector3::Zero(), 0.0};
        contact.shear = springs.force;
        contact.couple = springs.couple;
        contact.friction = {friction.force, friction.couple * normal};
        contact.drag = {drag.force, drag.couple * normal};
        if (stiffness > 0.0) result.elastic_shear += 0.5 * springs.force.squaredNorm() / stiffness;
        if (turning_stiffness > 0.0) result.elastic_shear += 0.5 * springs.couple * springs.couple / turning_stiffness;

        const Vector3 at_middle = contact.damping.force + friction.force;
        result.force = law.normal_stiffness * load.force + at_middle;
        result.moment =
            law.normal_stiffness * load.moment + contact.place.cross(at_middle) + contact.damping.couple + contact.friction.couple;
        result.elastic_normal = law.normal_stiffness * load.energy;
        result.overlap = load.deepest;
        result.area = load.area;
    }

    // losses: what acts works over a step with the mean of its values at both ends
    const Vector3 turned = motion.turned(1) - motion.turned(0);
    const Vector3 moved = motion.displacement(contact.place), moved_before = motion.displacement_of_previous(before.place);
    const auto loss = [&](const PlacedWrench& last, const PlacedWrench& now) {
        return -0.5 * (last.force.dot(moved_before) + now.force.dot(moved) + (last.couple + now.couple).dot(turned));
    };
    const double dragged = loss(before.drag, contact.drag);
    result.work.damping = loss(before.damping, contact.damping) + dragged;
    result.work.friction = (loss(before.friction, contact.friction) - dragged) - (result.elastic_shear - stored_shear);
    return result;
}

}  // namespace musim::lsdem
