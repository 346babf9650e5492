#pragma once

#include <vector>

#include "lsdem/model.hpp"

namespace musim::lsdem {

/// A block that has turned by more than 39°, the angle of this cosine, from its upright in the model has left its place [-]. Another face
/// of a box than those that bear where it stands can land flat after a turn of 45° at the earliest.
inline constexpr double kLeavingTurn = 0.78;

/// Which faces of a solid may bear while no block has left its place: one number per face on its surface, in the order of
/// find_bearing_sides. Those that another body stands before, within three quarters of the block's largest edge; those that turns of both
/// blocks by less than kLeavingTurn could bring there, within 77° of one; and those that such a turn could bring on a ground as near. All
/// of a block before which nothing stands. Empty of blocks without a solid and of fixed ones.
std::vector<std::vector<bool>> find_facing_sides(const Model& model);

}  // namespace musim::lsdem
