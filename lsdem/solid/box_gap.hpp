#pragma once

#include "lsdem/solid/solid.hpp"

namespace musim::lsdem {

/// Boxes about the origins of their frames, by half extents [m]; `place`: of b in the frame of a.

/// Width of the widest gap that a plane along a face of one leaves between two boxes [m]; negative: depth by which they overlap at least
/// along the normal of every face.
double find_gap_of_faces(const Vector3& half_a, const Vector3& half_b, const Placing& place);

/// The same for planes along an edge of each; −∞ where all edges are parallel.
double find_gap_of_edges(const Vector3& half_a, const Vector3& half_b, const Placing& place);

/// Both together, 15 directions [Gottschalk96]: the boxes are no nearer to each other [m]; negative: the shortest way to part them.
double find_gap(const Vector3& half_a, const Vector3& half_b, const Placing& place);

}  // namespace musim::lsdem
