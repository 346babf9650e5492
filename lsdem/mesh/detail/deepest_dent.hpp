#pragma once

#include <span>

#include "lsdem/mesh/split_mesh.hpp"
#include "lsdem/solid/solid.hpp"

namespace musim::lsdem::detail {

/// A point of a surface and its depth below the hull.
struct Dent {
    double depth = 0.0;
    Vector3 place = Vector3::Zero();
};

/// The point of a part's corners and edges that lies deepest below the faces of its hull. `corners`: the part's, in the hull's frame.
/// Depths up to `floor` count as none.
Dent find_deepest_dent(const ClosedPart& part, std::span<const Vector3> corners, const Polyhedron& hull, double floor);

}  // namespace musim::lsdem::detail
