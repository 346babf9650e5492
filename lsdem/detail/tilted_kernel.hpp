#pragma once

#include "lsdem/detail/contact_kernel.hpp"
#include "lsdem/tilted.hpp"

namespace musim::lsdem::detail {

/// Half extents of two boxes [m].
struct BoxPair {
    Row leader{}, follower{};
};

/// What one pair of faces does at one pose.
struct TiltedLoad {
    double deepest = 0.0;  ///< largest depth of the leader's face in the follower, `late` included [m]
    double area = 0.0;     ///< of the loaded polygon [m²]
    double energy = 0.0;   ///< ½ K_n ∫ d² dA [J]
    PlacedForce force;     ///< minus the gradient of the energy
};

/// Load of the polygon of the leader's face that lies deeper than `late` [m] in the follower, for K_n = `stiffness` [Pa/m].
TiltedLoad compute_tilted_load(const BoxPair& boxes, const RelativePose& pose, const TiltedFaces& faces, double late, double stiffness);

/// Smallest overlap of the boxes along any of their six face normals [m]; negative: a normal separates them. `rotation`, `position`: of the
/// leader in the follower's frame, see RelativePose.
double find_least_overlap(const BoxPair& boxes, const std::array<Row, 3>& rotation, const Row& position);

/// How far a plane separates the boxes, along a face of one or along two edges: they are no nearer to each other [m]. Zero or less: none
/// does; of boxes that overlap none ever does.
double find_gap(const BoxPair& boxes, const std::array<Row, 3>& rotation, const Row& position);

/// Moment of placed forces about the follower's origin [N·m], and their work over the last step [J].
Row compute_moment(const PlacedForce& forces, const RelativePose& pose);
double compute_work(const PlacedForce& forces, const RelativePose& pose);

/// What friction of a contact bears, on the leader.
struct TiltedFriction {
    Row force{};          ///< follower's frame [N]
    double couple = 0.0;  ///< about the direction in which the leader is pushed [N·m]
};

/// That of a contact at its last step.
TiltedFriction find_friction(const TiltedContact& contact);

/// Starts a contact of two boxes at an angle as one that has met by `faces` before: it stores `energy` [J], or all it can, by an overlap
/// that carries no force, and bears `friction`. False, and nothing is changed, when the faces do not meet.
bool start_tilted_contact(const BoxPair& boxes, const std::array<Row, 3>& rotation, const Row& position, const Interface& law,
                          const TiltedFaces& faces, double energy, const TiltedFriction& friction, TiltedContact& contact,
                          PairTally& tally);

/// Contact of two boxes at an angle that touched at the last step, or are not apart; `before`: what it stored at the last step.
/// `first_step`: initial overlap carries force.
void compute_tilted_contact(const BoxPair& boxes, const RelativePose& pose, const StepLaw& law, bool first_step, const PairTally& before,
                            TiltedContact& contact, PairSums& sums);

}  // namespace musim::lsdem::detail
