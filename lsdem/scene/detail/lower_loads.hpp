#pragma once

#include <vector>

#include "lsdem/model.hpp"
#include "lsdem/scene/detail/placement.hpp"
#include "lsdem/scene/scene.hpp"

namespace musim::lsdem::detail {

/// Loads of a scene on the blocks of its model, which has its shapes, materials and blocks. Throws SceneError for a load on a block that is
/// not there or is held, and for a point that is not of its block.
std::vector<Load> lower_loads(const Scene& scene, const std::vector<Placement>& blocks, const Model& model);

}  // namespace musim::lsdem::detail
