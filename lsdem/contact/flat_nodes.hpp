#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "lsdem/block_height.hpp"
#include "lsdem/contact/contacts.hpp"
#include "lsdem/contact_law.hpp"
#include "lsdem/shape.hpp"
#include "lsdem/types.hpp"

namespace musim::lsdem::detail {

using Row = std::array<double, 3>;

inline double dot(const Row& a, const Row& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

inline Row row_of(const Vector3& v) { return {v.x(), v.y(), v.z()}; }

/// Axis along which a vector is largest.
std::size_t largest_axis(const Row& v);

/// An affine map of points of the leader to the follower's frame.
struct PointMap {
    std::array<Row, 3> rotation;  ///< rows
    Row position;                 ///< of the leader's origin [m]

    PointMap(const Matrix3& q, const Vector3& t) : rotation{row_of(q.row(0)), row_of(q.row(1)), row_of(q.row(2))}, position(row_of(t)) {}
    Row operator()(const Row& p) const {
        return {dot(rotation[0], p) + position[0], dot(rotation[1], p) + position[1], dot(rotation[2], p) + position[2]};
    }
};

/// Pose of the leader in the follower's frame, and its change over the last step. Differences of poses, not velocities times dt: their sum
/// over time telescopes, so that a stuck node cannot creep by rounding or by the turning of its lever arm.
struct RelativePose : PointMap {
    PointMap change;

    RelativePose(const Matrix3& q, const Vector3& t, const Matrix3& old_q, const Vector3& old_t)
        : PointMap(q, t), change(q - old_q, t - old_t) {}

    /// A vector of the follower's frame in the leader's.
    Row in_leader_frame(const Row& v) const {
        Row result;
        for (std::size_t a = 0; a < 3; ++a) result[a] = rotation[0][a] * v[0] + rotation[1][a] * v[1] + rotation[2][a] * v[2];
        return result;
    }
};

/// Interface with the time step folded in: tractions from displacements.
struct StepLaw {
    double kn, ks, mu, cn, cs;  ///< K_n, K_s [Pa/m], μ [-], C_n/dt, C_s/dt [Pa/m]
    double ks_inverse;          ///< 1/K_s, or zero without shear stiffness

    StepLaw(const Interface& law, double dt);
};

/// Sums over the nodes of one pair, follower's frame; the moment about the follower's origin.
struct PairSums {
    Row force{}, moment{};
    PairTally tally;
    PairWork work;
};

/// A flat face of the follower, the plane of the ground or one face of a box, and the face of the leader that looks at it. The two are
/// chosen per pair, not per node: nodes near an edge of a shared face then push along its normal, not sideways.
struct FlatFollower {
    std::size_t axis = 2;         ///< of the follower's frame, along the normal
    double side = 1.0;            ///< outward normal = side·e_axis
    std::size_t leader_axis = 2;  ///< of the leader's frame, along the normal of its face
    bool bounded = true;          ///< a face with edges; the ground has none
    Row half{};                   ///< half extents of the follower [m]

    /// The two faces as one number above zero.
    std::uint8_t code() const { return static_cast<std::uint8_t>(1 + 2 * (3 * axis + leader_axis) + (side < 0.0 ? 1 : 0)); }
};

/// A contact that has just ended gives up what its springs and dashpots held; `share` is the area it could act on [m²].
void end_contact(const StepLaw& law, const Row& normal, const Row& change, double share, std::size_t entry, ContactHistory& history,
                 PairWork& work);

/// A pair that meets by the nodes of its leader; `list` holds their histories.
struct NodeContact {
    BlockNodes leader;
    const RelativePose& pose;
    StepLaw law;
    const ContactPair& pair;
    ContactList& list;
};

/// Nodes against a flat face, four at a time; compiled for AVX2 and for plain x86-64, same bits. See docs/theory/surface_nodes.md.
PairSums sum_flat_nodes(const NodeContact& contact, const FlatFollower& face);

}  // namespace musim::lsdem::detail
