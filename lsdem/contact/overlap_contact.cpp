#include "lsdem/contact/overlap_contact.hpp"

#include <cstddef>

#include "lsdem/contact/contact_step.hpp"

namespace musim::lsdem {
namespace {

using Step = detail::ContactStep<detail::Wide<1>>;
using Vector = Step::Vector;

Vector to_lane(const Vector3& v) { return {v.x(), v.y(), v.z()}; }
Vector3 from_lane(const Vector& v) { return {v.x, v.y, v.z}; }
Step::Wrench to_lane(const PlacedWrench& w) { return {to_lane(w.force), to_lane(w.couple)}; }
PlacedWrench from_lane(const Step::Wrench& w) { return {from_lane(w.force), from_lane(w.couple)}; }

Step::Motion to_lane(const PairMotion& motion) {
    Step::Motion one;
    one.shift = to_lane(motion.shift);
    for (std::size_t body = 0; body < 2; ++body) {
        one.center[body] = to_lane(motion.center[body]);
        one.previous_center[body] = to_lane(motion.previous_center[body]);
        one.turn[body] = Step::Motion::Turn::of(to_lane(Vector3(motion.turn[body].vec())), motion.turn[body].w());
    }
    return one;
}
Step::Geometry to_lane(const OverlapGeometry& geometry) {
    const Matrix3& second = geometry.area.second;
    return {to_lane(geometry.load.force),
            to_lane(geometry.load.moment),
            geometry.load.deepest,
            geometry.load.energy,
            geometry.area.area,
            to_lane(geometry.area.arm),
            {second(0, 0), second(1, 1), second(2, 2)},
            {second(1, 2), second(2, 0), second(0, 1)}};
}
Step::Memory to_lane(const OverlapContact& contact) {
    const FrictionSprings<Vector3>& s = contact.sliding;
    const FrictionSprings<double>& t = contact.turning;
    return {contact.touches,
            {s.area, s.core, to_lane(s.in_core), to_lane(s.in_rest)},
            {t.area, t.core, t.in_core, t.in_rest},
            contact.lightest,
            to_lane(contact.place),
            to_lane(contact.couple),
            to_lane(contact.dashpots)};
}
OverlapContact from_lane(const Step::Memory& memory) {
    const Step::Springs<Vector>& s = memory.sliding;
    const Step::Springs<double>& t = memory.turning;
    return {memory.touches,
            0,
            {s.area, s.core, from_lane(s.in_core), from_lane(s.in_rest)},
            {t.area, t.core, t.in_core, t.in_rest},
            memory.lightest,
            from_lane(memory.place),
            from_lane(memory.couple),
            from_lane(memory.dashpots)};
}

/// The area of a contact as pieces of both bodies, cut when first asked for.
struct PieceCells {
    OverlapBodies& bodies;

    static bool may_pull(bool touches, const Step::Geometry& /*geometry*/, const Step::Pressure& /*dashpot*/, double /*stiffness*/) {
        return touches;
    }
    Step::PressureSum find_pull(const Step::Pressure& dashpot, double stiffness) const {
        const PressureMoments pull =
            musim::lsdem::find_pull(bodies.pieces(), {dashpot.at, from_lane(dashpot.slope), from_lane(dashpot.about)}, stiffness);
        return {pull.sum, to_lane(pull.at)};
    }
    double least_reach(const Vector& normal, const Vector& /*about*/, const Step::Geometry& geometry) const {
        return find_least_reach(bodies.pieces(), from_lane(normal), geometry.deepest);
    }
    double find_reach(const Vector& normal, const Vector& about) const {
        return musim::lsdem::find_reach(bodies.pieces(), from_lane(normal), from_lane(about));
    }
};

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
    Step::Memory memory = to_lane(contact);
    PieceCells cells{bodies};
    const Step::Result found =
        Step::compute(to_lane(geometry), to_lane(motion),
                      {law.normal_stiffness, law.shear_stiffness, law.friction, law.normal_damping, law.shear_damping}, dt, first_step,
                      stored_shear, cells, memory);
    contact = from_lane(memory);
    OverlapForces result;
    result.force = from_lane(found.force), result.moment = from_lane(found.moment);
    result.elastic_normal = found.elastic_normal, result.elastic_shear = found.elastic_shear;
    result.work = {found.friction_work, found.damping_work};
    if (contact.touches) result.overlap = geometry.load.deepest, result.area = geometry.load.area;
    return result;
}

}  // namespace musim::lsdem
