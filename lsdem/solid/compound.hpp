#pragma once

#include <span>
#include <stdexcept>

#include "lsdem/solid/solid.hpp"

namespace musim::lsdem {

/// One rigid solid of convex polyhedra that touch, in one frame. Where a face of one covers a part of another's, both are cut along the
/// planes of their sides, until faces are covered wholly or not at all; covered faces are inner ones. Then `Polyhedron::wholes` is found:
/// the largest convex parts of the solid. A box of two halves has one, the box.
///
/// Throws std::invalid_argument of parts that overlap (with their numbers, from 0, and the depth [m]), of parts that hang together by no
/// face, and of solids that need more than `kMostPieces` pieces, with their number. Gaps and overlaps below 1e-9 of the size count as none.
Solid make_compound(std::span<const Polyhedron> parts);

inline constexpr std::size_t kMostPieces = 256;

}  // namespace musim::lsdem
