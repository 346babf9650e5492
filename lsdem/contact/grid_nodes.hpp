#pragma once

#include "lsdem/contact/flat_nodes.hpp"
#include "lsdem/level_set.hpp"

namespace musim::lsdem::detail {

/// Nodes of a leader against the grid of its follower: value and normal at each node, the contact law along that normal. `height_offset`:
/// of the follower, from the height of its shape [m].
PairSums sum_grid_nodes(const NodeContact& contact, const GridLevelSet& shape, double height_offset);

}  // namespace musim::lsdem::detail
