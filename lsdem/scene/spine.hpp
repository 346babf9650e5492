#pragma once

#include <cstddef>
#include <vector>

namespace musim::lsdem {

/// The blocks whose motion is kept: a line of blocks at the same place of every second layer (levels 1, 3, ...) of a structure, on its
/// outer face, and, where the line ends below the top layer, the block of that layer above it. Of an explicit list: all blocks, or 64
/// spread evenly over a longer list, at their levels by height (find_levels); several may be at one level.
struct Spine {
    std::vector<std::size_t> block = {};  ///< index into Model::blocks
    std::vector<int> level = {};          ///< from 1 at the base
    bool has_top = false;                 ///< the last block is not of the line, but of the top layer above it

    std::size_t size() const { return block.size(); }
    /// Number of the blocks that are the line, by which models are compared.
    std::size_t line() const { return block.size() - (has_top ? 1 : 0); }
};

}  // namespace musim::lsdem
