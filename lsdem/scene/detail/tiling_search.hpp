#pragma once

#include <cstdint>
#include <optional>

#include "lsdem/scene/detail/cell_ring.hpp"
#include "lsdem/scene/detail/split_mix64.hpp"

namespace musim::lsdem::detail {

/// Outcome of the exact cover.
struct Cover {
    std::optional<Partners> partners;
    std::uint64_t nodes = 0;  ///< placements tried
    bool exhausted = false;   ///< every branch was closed: without partners, there is no such tiling
};

/// Covers the ring by pairs of opposite dominoes so that T = rot180 T and T shares no domino with rot90 T. Depth-first, the cell with the
/// fewest choices first, choices in random order; gives up after `node_limit` placements.
Cover cover_ring(const CellRing& ring, SplitMix64& random, std::uint64_t node_limit);

/// Penalty of a tiling in the search for a good interlock; smaller is better. Weights chosen by trial, see docs/theory/structures.md.
int compute_penalty(const CellRing& ring, const Partners& partners);

/// Improves `partners` by `trials` symmetric flips under simulated annealing [Kirkpatrick83] in integers: a flip that worsens the penalty
/// by ΔP is accepted with probability 2^−⌈ΔP/T⌉ while T falls. Returns the number of flips accepted. The result shares no domino with its
/// quarter turn.
std::uint64_t improve_interlock(const CellRing& ring, Partners& partners, SplitMix64& random, std::uint64_t trials);

}  // namespace musim::lsdem::detail
