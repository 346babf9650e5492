#pragma once

#include "lsdem/types.hpp"

namespace musim::lsdem::detail {

/// How far a plane separates two boxes, along a face of one or along an edge of each: they are no nearer to each other [m]. Zero or less:
/// none does; of boxes that overlap none ever does. `half`: half extents [m]; `rotation`, `position`: of box a in the frame of box b.
double find_gap(const Vector3& half_a, const Vector3& half_b, const Matrix3& rotation, const Vector3& position);

}  // namespace musim::lsdem::detail
