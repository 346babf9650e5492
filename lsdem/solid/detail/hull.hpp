#pragma once

#include <optional>
#include <span>

#include "lsdem/solid/solid.hpp"

namespace musim::lsdem::detail {

/// Convex hull as of make_convex_hull, of finite points [m], with a larger tolerance for planes and for points that count as one [m].
/// Nothing where the points lie in one plane to the tolerance.
std::optional<Polyhedron> find_hull(std::span<const Vector3> points, double tolerance);

}  // namespace musim::lsdem::detail
