#pragma once

#include <functional>

#include "lsdem/level_set.hpp"
#include "lsdem/shape.hpp"
#include "lsdem/types.hpp"

namespace musim::lsdem::detail {

/// Appends a node: position [m], area vector [m²], middle and half extents of its cell [m], see SurfaceNodes.
void add_node(SurfaceNodes& nodes, const Vector3& position, const Vector3& area, const Vector3& center, const Vector3& half);

/// Appends a node of a smooth shape, whose cell has no size.
void add_node(SurfaceNodes& nodes, const Vector3& position, const Vector3& area);

/// Principal moments per unit mass of a homogeneous box of the given edge lengths [m²].
Vector3 box_inertia_over_mass(const Vector3& size);

/// Grid of spacing `voxel` [m] around a body of the given half extents [m], one voxel wider on every side, that holds `distance` [m].
/// Throws std::invalid_argument when the voxel is not positive.
GridLevelSet sample_level_set(const Vector3& half, double voxel, const std::function<double(const Vector3&)>& distance);

}  // namespace musim::lsdem::detail
