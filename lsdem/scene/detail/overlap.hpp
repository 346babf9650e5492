#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "lsdem/solid/solid.hpp"

namespace musim::lsdem::detail {

/// A body for the overlap check: a box, a sphere when all half extents are its radius and `round` is set, or a solid.
struct Body {
    Vector3 half = Vector3::Zero();      ///< half edge lengths in the body frame; of a solid, its reach from the origin at most [m]
    Vector3 center = Vector3::Zero();    ///< origin of the body frame, world frame [m]
    Matrix3 axes = Matrix3::Identity();  ///< body axes in the world frame, as columns
    bool round = false;
    bool fixed = false;            ///< fixed bodies may overlap each other
    const Solid* solid = nullptr;  ///< in the body frame; nothing: a box or a sphere
};

/// Two bodies that overlap, and the shortest way to part them.
struct Overlap {
    std::size_t first = 0, second = 0;
    double depth = 0.0;  ///< [m]
};

/// Depth that is still taken for touching [fraction of the smallest edge of the two]: positions written with seven significant digits are
/// off by 1e-7 of some ten edges. Smaller: such scenes are refused; larger: blocks start with a visible push.
inline constexpr double kTouchingTolerance = 1e-6;

/// Depth of the overlap of two bodies [m], negative when they are apart, then no more than the distance: the smallest over the directions
/// of faces, and over those across an edge of each. Of two boxes these are 15 [Gottschalk96]; of other solids see find_gap.
double compute_overlap(const Body& a, const Body& b);

/// Depth of a body below the plane z = 0 [m]; negative above it.
double compute_depth_in_ground(const Body& body);

/// The deepest overlap beyond the tolerance, if any; the first such pair where depths are equal.
///
/// A uniform grid finds the pairs, so that the effort grows like the number of bodies (bodies much larger than the average are compared
/// with all others).
std::optional<Overlap> find_deepest_overlap(const std::vector<Body>& bodies);

}  // namespace musim::lsdem::detail
