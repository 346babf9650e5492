#pragma once

#include <span>
#include <stdexcept>

#include "lsdem/solid/solid.hpp"

namespace musim::lsdem {

/// Gaps and overlaps below this part of a compound's size count as none [-]: far above the rounding of turned and placed parts.
inline constexpr double kTouching = 1e-9;

/// Most convex pieces of a compound: contact looks at all pairs of pieces of two solids.
inline constexpr std::size_t kMostPieces = 256;

/// One rigid solid of convex polyhedra that touch, in one frame.
///
/// Parts whose union is convex become one piece, two at a time: a box of two halves is the box. Where faces of two parts touch, each part
/// is cut along the planes of the other's sides there, so that the share is a whole face of a piece on both sides and what lies behind it
/// on both sides is convex together; such faces, and those of cuts, are inner ones. `Polyhedron::wholes` are the convex parts of the solid
/// that hold a part, or what lies behind a shared face, and that no piece enlarges: each point within the solid lies within one of them.
///
/// `touching`: the part of the size below which gaps, overlaps and dents count as none [-]; of parts from a file, some times the rounding
/// of its coordinates. Throws std::invalid_argument of parts that overlap (with their numbers, from 0, and the depth [m]), of parts that
/// hang together by no face, and of solids that need more than `kMostPieces` pieces, with their number.
Solid make_compound(std::span<const Polyhedron> parts, double touching = kTouching);

}  // namespace musim::lsdem
