#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "lsdem/results/block_shapes.hpp"
#include "lsdem/types.hpp"

namespace musim::lsdem {

/// Surface of a shape as triangles, counter-clockwise seen from outside, body frame.
struct SurfaceMesh {
    std::vector<Vector3> places;   ///< [m]
    std::vector<Vector3> normals;  ///< beside `places`, outward, of unit length
    std::vector<std::array<std::uint32_t, 3>> triangles;
};

/// Outer faces of a shape, each with corners of its own and its normal; of a ball the normals of the ball.
SurfaceMesh make_surface_mesh(const BlockShape& shape);

/// Surface of a shape as polygons that share their corners.
struct SurfacePolygons {
    std::vector<Vector3> corners;                   ///< [m]
    std::vector<std::vector<std::uint32_t>> faces;  ///< counter-clockwise seen from outside
};

/// Outer faces of a shape; corners of several pieces that agree to the last bit are one.
SurfacePolygons make_surface_polygons(const BlockShape& shape);

}  // namespace musim::lsdem
