#pragma once

#include <vector>

#include "lsdem/types.hpp"

namespace musim::lsdem {

/// Levels of blocks by their heights, from 1 at the lowest: a block begins a new level when its centre is higher than the first of the
/// level by half of the lower of the two, or more; blocks of one course differ by less, those of the next by a whole height.
///
/// `extent`: along the world's axes [m]; both one entry per block. Depends on ratios of lengths only.
std::vector<int> find_levels(const std::vector<Vector3>& position, const std::vector<Vector3>& extent);

}  // namespace musim::lsdem
