#pragma once

#include <array>
#include <vector>

#include "lsdem/scene/tower_tiling.hpp"

namespace musim::lsdem::detail {

/// Marks a missing cell or partner.
inline constexpr int kNone = -1;

/// Directions of CellRing::neighbors.
enum Direction { kEast, kWest, kNorth, kSouth };

/// The cells of a layer's plan, numbered row by row, with their adjacency and their image under a quarter turn.
struct CellRing {
    int cells_across = 0;
    std::vector<int> index;                     ///< of the cell at (i, j), at j·cells_across + i; kNone outside the plan
    std::vector<std::array<int, 2>> cells;      ///< (i, j) of each cell
    std::vector<std::array<int, 4>> neighbors;  ///< east, west, north, south
    std::vector<int> quarter_turn;              ///< image of each cell; kNone when the image is outside the plan
    std::vector<std::array<int, 2>> borders;    ///< cell pairs along all inner grid lines; {kNone, kNone} at every free edge

    int size() const { return static_cast<int>(cells.size()); }
    int at(int i, int j) const;
};

/// Plan of the cells for which `inside` (one flag per grid cell, row by row) holds.
CellRing make_cell_ring(int cells_across, const std::vector<bool>& inside);

/// Plan of the ring of `settings`.
CellRing make_cell_ring(const TilingSettings& settings);

/// A tiling as a perfect matching: the other cell of each cell's domino.
using Partners = std::vector<int>;

/// Partners of the same dominoes a quarter turn on. The plan must be its own quarter turn.
Partners turn_partners(const CellRing& ring, const Partners& partner);

/// Straight joints: segments between two cells that no domino crosses, in unbroken lines.
struct JointCounts {
    int through = 0;         ///< lines through both layers, from free edge to free edge
    int longest = 0;         ///< longest line through both layers [pitches]
    int sum_of_squares = 0;  ///< Σ (length − 1)² of the lines through both layers
    int layer = 0;           ///< lines in `odd` alone, from free edge to free edge
};

/// Counts the straight joints of two alternating layers.
JointCounts count_joints(const CellRing& ring, const Partners& odd, const Partners& even);

/// Closed loops of cells linked by dominoes of either layer, and how many of them are a domino that both layers share.
struct LoopCounts {
    int loops = 0;
    int shared = 0;
};

/// Counts the loops of two alternating layers.
LoopCounts count_loops(const Partners& odd, const Partners& even);

}  // namespace musim::lsdem::detail
