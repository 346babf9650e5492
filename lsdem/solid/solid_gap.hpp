#pragma once

#include "lsdem/solid/solid.hpp"

namespace musim::lsdem {

/// Width of the widest gap that a plane along a face of one, or along an edge of each, leaves between two convex polyhedra [m]: they are no
/// nearer to each other. Negative: the least depth by which they overlap, over these planes, which is the shortest way to part them.
/// `place`: of b in the frame of a.
double find_gap(const Polyhedron& a, const Polyhedron& b, const Placing& place);

/// The same for solids of several pieces: the least over pairs of pieces.
double find_gap(const Solid& a, const Solid& b, const Placing& place);

/// Width of the widest gap that a plane along a face of one leaves between two solids [m]: they are no nearer to each other. Zero or less
/// where none does, which solids may whose edges cross. Of several pieces the least over pairs of them. `place`: of b in the frame of a.
double find_gap_of_faces(const Solid& a, const Solid& b, const Placing& place);

/// Distance of a point from a solid, in its frame; negative inside: the depth below its faces, see Polyhedron::wholes [m].
double find_gap(const Solid& solid, const Vector3& x);

}  // namespace musim::lsdem
