#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "lsdem/types.hpp"

namespace musim::lsdem::detail {

/// A body for the overlap check: a box, or a sphere when all half extents are its radius and `round` is set.
struct Body {
    Vector3 half = Vector3::Zero();      ///< half edge lengths in the body frame [m]
    Vector3 center = Vector3::Zero();    ///< world frame [m]
    Matrix3 axes = Matrix3::Identity();  ///< body axes in the world frame, as columns
    bool round = false;
    bool fixed = false;  ///< fixed bodies may overlap each other
};

/// Two bodies that overlap, and the shortest way to part them.
struct Overlap {
    std::size_t first = 0, second = 0;
    double depth = 0.0;  ///< [m]
};

/// Depth that is still taken for touching [fraction of the smallest edge of the two]: positions written with seven significant digits are
/// off by 1e-7 of some ten edges. Smaller: such scenes are refused; larger: blocks start with a visible push.
inline constexpr double kTouchingTolerance = 1e-6;

/// Depth of the overlap of two bodies [m], negative when they are apart: the smallest over the axes that can separate two boxes, the face
/// normals and the cross products of edges [Gottschalk96]. For separated boxes a lower bound of the distance, negated.
double compute_overlap(const Body& a, const Body& b);

/// The deepest overlap beyond the tolerance, if any; the first such pair where depths are equal.
///
/// A uniform grid finds the pairs, so that the effort grows like the number of bodies (bodies much larger than the average are compared
/// with all others).
std::optional<Overlap> find_deepest_overlap(const std::vector<Body>& bodies);

}  // namespace musim::lsdem::detail
