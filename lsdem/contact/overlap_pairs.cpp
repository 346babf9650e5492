#include "lsdem/contact/overlap_pairs.hpp"

#include <cmath>

#include "lsdem/contact/overlap.hpp"
#include "lsdem/contact/overlap_contact.hpp"
#include "lsdem/detail/tilted_kernel.hpp"

namespace musim::lsdem {
namespace {

/// Both bodies of a pair about its origin: half way between two blocks, the centre of a block on the ground. The leader comes first.
OverlapBodies find_bodies(const Bodies& bodies, const BasePose& base, const ContactPair& pair) {
    const std::size_t l = pair.leader, f = pair.follower;
    if (pair.follower == kGround)
        return {{bodies.half[l], bodies.rotation[l], Vector3::Zero()}, base.displacement.z() - bodies.position[l].z()};
    const Vector3 half_way = 0.5 * (bodies.position[f] - bodies.position[l]);
    return {{bodies.half[l], bodies.rotation[l], -half_way}, {bodies.half[f], bodies.rotation[f], half_way}};
}

PairMotion find_motion(const Bodies& bodies, const BasePose& base, const ContactPair& pair) {
    const std::size_t l = pair.leader, f = pair.follower;
    PairMotion motion;
    motion.turn[0] = bodies.rotation[l] * bodies.previous_rotation[l].transpose();
    if (pair.follower == kGround) {
        motion.center = motion.previous_center = {Vector3::Zero(), Vector3::Zero()};
        motion.turn[1] = Matrix3::Identity();
        motion.shift = (base.displacement - bodies.position[l]) - (base.previous - bodies.previous_position[l]);
        return motion;
    }
    motion.turn[1] = bodies.rotation[f] * bodies.previous_rotation[f].transpose();
    const Vector3 apart = bodies.position[f] - bodies.position[l], previous = bodies.previous_position[f] - bodies.previous_position[l];
    motion.center = {Vector3(-0.5 * apart), Vector3(0.5 * apart)};
    motion.previous_center = {Vector3(-0.5 * previous), Vector3(0.5 * previous)};
    motion.shift = apart - previous;
    return motion;
}

/// How far the bodies of a pair are apart at least; zero or less where they may overlap [m].
double find_gap(const Bodies& bodies, const BasePose& base, const ContactPair& pair) {
    const std::size_t l = pair.leader, f = pair.follower;
    if (pair.follower == kGround) {
        const double reach = bodies.rotation[l].row(2).cwiseAbs().dot(bodies.half[l]);
        return (bodies.position[l].z() - base.displacement.z()) - reach;
    }
    const Matrix3 to_follower = bodies.rotation[f].transpose();
    const Vector3 position = to_follower * (bodies.position[l] - bodies.position[f]);
    return detail::find_gap({detail::row_of(bodies.half[l]), detail::row_of(bodies.half[f])},
                            detail::rows_of(Matrix3(to_follower * bodies.rotation[l])), detail::row_of(position));
}

}  // namespace

void compute_overlap_pair(const Bodies& bodies, const BasePose& base, double dt, std::size_t index, ContactList& list) {
    const ContactPair& pair = list.pairs[index];
    OverlapContact& contact = list.overlaps[pair.overlap];
    PairForce& force = list.forces[index];
    PairTally& tally = list.tallies[index];
    if (!contact.touches) {
        const double gap = find_gap(bodies, base, pair);
        const double trusted = list.first_step ? 0.0 : list.trusted_gap * gap;
        list.next_look[index] = trusted > 0.0 ? bodies.travel_of(pair.leader, pair.follower) + trusted : 0.0;
        if (gap > 0.0) {
            force = PairForce{};
            tally = PairTally{};
            return;
        }
    }
    OverlapBodies both = find_bodies(bodies, base, pair);
    const PairMotion motion = find_motion(bodies, base, pair);
    const OverlapForces found = compute_overlap_contact(find_overlap_geometry(both.pieces()), motion, pair.law, dt, list.first_step,
                                                        tally.elastic_shear, both, contact);
    force.force = -found.force;
    force.leader_torque = motion.center[0].cross(found.force) - found.moment;
    force.follower_torque = found.moment - motion.center[1].cross(found.force);
    tally.elastic_shear = found.elastic_shear;
    tally.overlap = found.overlap;
    tally.touching = contact.touches ? 1 : 0;
    list.work[index] += found.work;
    if (list.demand.wanted) list.demand.ask(index, found.area);
}

double compute_overlap_energy(const Bodies& bodies, const BasePose& base, const ContactList& list, std::size_t index) {
    const ContactPair& pair = list.pairs[index];
    if (!list.overlaps[pair.overlap].touches) return 0.0;
    return pair.law.normal_stiffness * find_bodies(bodies, base, pair).energy();
}

}  // namespace musim::lsdem
