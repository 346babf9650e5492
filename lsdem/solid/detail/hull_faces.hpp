#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "lsdem/solid/detail/hull_triangles.hpp"
#include "lsdem/solid/vectors.hpp"

namespace musim::lsdem::detail {

/// Joins triangles of a convex hull that lie in one plane to `tolerance` into faces, each a loop of corners, counter-clockwise seen from
/// outside. Corners with fewer than three faces drop out. Every edge is in two faces, whatever the rounding: where joined triangles enclose
/// others, or a face keeps fewer than three corners, it is joined with the face beside it that is the flattest with it; so is a face that
/// is dented by more than the tolerance, if the two are flat to a few of it.
std::vector<std::vector<std::uint32_t>> join_hull_triangles(std::span<const Vector3> points, std::span<const HullTriangle> triangles,
                                                            double tolerance);

}  // namespace musim::lsdem::detail
