#pragma once

#include "lsdem/block_height.hpp"
#include "lsdem/contact/contacts.hpp"
#include "lsdem/contact/flat_nodes.hpp"
#include "lsdem/level_set.hpp"

namespace musim::lsdem::detail {

/// Nodes of a leader against the grid of its follower: value and normal at each node, the contact law along that normal. Forces, energies
/// and losses are added to `sums` in the follower's frame, histories stand in `list`. `height_offset`: of the follower, from the height of
/// its shape [m]; `equal_area`: of every node in contact, zero for the area of its own [m^2].
void sum_grid_nodes(const BlockNodes& leader, const RelativePose& pose, const GridLevelSet& shape, double height_offset, const StepLaw& law,
                    double equal_area, const ContactPair& pair, ContactList& list, PairSums& sums);

}  // namespace musim::lsdem::detail
