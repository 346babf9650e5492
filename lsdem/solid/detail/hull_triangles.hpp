#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "lsdem/solid/vectors.hpp"

namespace musim::lsdem::detail {

/// A triangle of a convex hull.
struct HullTriangle {
    std::array<std::uint32_t, 3> corners{};     ///< counter-clockwise seen from outside
    std::array<std::uint32_t, 3> neighbours{};  ///< across the edge from that corner to the next
};

/// The edge of a triangle that starts at a corner; of a corner that it has not, the last.
inline std::size_t find_edge(const HullTriangle& triangle, std::uint32_t corner) {
    return triangle.corners[0] == corner ? 0 : (triangle.corners[1] == corner ? 1 : 2);
}

/// Four points that span a tetrahedron of positive volume, far from one another: ends of a long line, the farthest from it, and the
/// farthest from their plane. Nothing if all points lie within `tolerance` of one plane.
std::optional<std::array<std::uint32_t, 4>> find_first_corners(std::span<const Vector3> points, double tolerance);

/// Convex hull of points whose coordinates are multiples of 2⁻⁵⁰ and at most 1 apart, so that differences have no rounding: triangles
/// without a tolerance, decided by exact signs. Points in a plane or a line of others are corners only where the hull needs them.
std::vector<HullTriangle> find_hull_triangles(std::span<const Vector3> points, const std::array<std::uint32_t, 4>& first);

}  // namespace musim::lsdem::detail
