#pragma once

#include <cstddef>
#include <vector>

#include "lsdem/motion/simulation.hpp"
#include "lsdem/types.hpp"

namespace musim::lsdem {

/// Blocks of layers that stand no more: turned by more than 45° from upright, or lower than the median centre of their layer by more than a
/// quarter of their height (has_fallen). Where they were put need not be known, so this finds of a specimen what fell while it was
/// prepared.
///
/// `size`: edge lengths in the body frame [m]; `layer`: from 1 at the base, blocks of layer 0 are not counted; `places`: poses are enough;
/// all one entry per block.
std::size_t count_fallen(const std::vector<Vector3>& size, const std::vector<int>& layer, const Kinematics& places);

/// The same of a running simulation.
std::size_t count_fallen(const Simulation& simulation, const std::vector<int>& layer);

}  // namespace musim::lsdem
