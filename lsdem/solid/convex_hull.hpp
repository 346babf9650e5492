#pragma once

#include <span>

#include "lsdem/solid/solid.hpp"

namespace musim::lsdem {

/// Convex hull of points [m], corners in the order in which the points are given; points in one plane to `kSamePlane` of the size make one
/// face, and points inside it or in an edge's middle are no corners. Throws std::invalid_argument with fewer than four points, with a
/// coordinate that is not finite, and of points in one plane.
Polyhedron make_convex_hull(std::span<const Vector3> points);

/// Points that lie off a plane by less than this part of the body's size lie in it [-]: far above the rounding of their places, but for
/// bodies a thousand sizes from the origin, where a few units in the last place of the coordinates take its place.
inline constexpr double kSamePlane = 1e-12;

}  // namespace musim::lsdem
