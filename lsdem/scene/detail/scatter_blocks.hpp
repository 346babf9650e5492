#pragma once

#include <vector>

#include "lsdem/scene/detail/placement.hpp"

namespace musim::lsdem::detail {

/// The largest standard deviation of sizes, over the shortest edge that scatters [-]: a block of the far tail is then a sixth too short.
inline constexpr double kMostSizeDeviation = 1.0 / 40.0;

/// The largest standard deviation of places, over the shortest horizontal edge of a block [-]: a fifth at four deviations.
inline constexpr double kMostPlaceDeviation = 1.0 / 20.0;

/// Gives blocks their own sizes and places, as Scene::scatter asks for; held blocks stay as they are. Nothing overlaps that did not before.
///
/// Size: each box loses |z|·σ/√(1 − 2/π) of each of its two edges that are not its most upright one, about its middle: no block is larger
/// than drawn, as of stones that pass one gauge; the edges' standard deviation is σ, their mean 1.32 σ below what is drawn. Heights stay,
/// so that each block still lies on what it lay on (Wall::height_deviation varies them); solids and spheres keep their size.
///
/// Place: each block moves by (z_x, z_y)·σ along x and y, but no farther than half the gap to any block beside it. A block is beside
/// another one when no level plane parts them; so a block without room, as in an arch, stays.
///
/// z: normal, cut off at kMostDeviates, by the seed and the block's number alone. Throws SceneError where σ is too large for a block.
void scatter_blocks(const Scene& scene, std::vector<Placement>& blocks);

}  // namespace musim::lsdem::detail
