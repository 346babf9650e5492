#pragma once

#include "lsdem/types.hpp"

namespace musim::lsdem::detail {

/// Width of the gap that a plane along a face of one leaves between two boxes [m]; negative: depth by which they overlap at least along the
/// normal of every face. `half`: half extents [m]; `rotation`, `position`: of box a in the frame of box b.
double find_gap_of_faces(const Vector3& half_a, const Vector3& half_b, const Matrix3& rotation, const Vector3& position);

/// The same for planes along a face of one, and along an edge of each: the boxes are no nearer to each other [m]. Zero where none separates
/// them; of boxes that overlap none does.
double find_gap(const Vector3& half_a, const Vector3& half_b, const Matrix3& rotation, const Vector3& position);

}  // namespace musim::lsdem::detail
