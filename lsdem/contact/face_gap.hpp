#pragma once

#include "lsdem/solid/solid.hpp"

namespace musim::lsdem {

/// Width of the widest gap that a plane along a face of one leaves between two solids [m]: they are no nearer to each other. Zero or less
/// where none does, which solids may whose edges cross. Of several pieces the least over pairs of them. `place`: of b in the frame of a.
double find_gap_of_faces(const Solid& a, const Solid& b, const Placing& place);

}  // namespace musim::lsdem
