#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "lsdem/solid/solid.hpp"

namespace musim::lsdem::detail {

/// A polygon in which faces of two convex parts touch.
struct SharedFace {
    std::array<std::size_t, 2> parts{};    ///< the first has the lower number
    std::array<std::uint32_t, 2> faces{};  ///< that touch, one of each part
    std::vector<Vector3> polygon;          ///< counter-clockwise seen from outside the first [m]
};

/// All polygons in which faces of two parts touch to the tolerance [m] and that are wider than it.
std::vector<SharedFace> find_shared_faces(std::span<const Polyhedron> parts, double tolerance);

/// Does a point of the plane of a shared face lie within its polygon?
bool lies_within(const SharedFace& shared, const Vector3& x);

/// Planes of the sides of one of the two parts (0 or 1) where they bound the shared face: a body between them and beyond it
/// makes a convex one with the other part between its own.
std::vector<Plane> find_side_planes(const SharedFace& shared, std::size_t side, const Polyhedron& part, double tolerance);

}  // namespace musim::lsdem::detail
