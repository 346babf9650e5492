#pragma once

#include <optional>
#include <vector>

#include "lsdem/model.hpp"

/// Structures that overturn as one body, or down to a level joint: closed forms of what rests on a plane.
namespace musim::lsdem {

/// The smallest horizontal acceleration over gravity along ± a world axis at which what stands above a level joint overturns as one body
/// [-]:
///
///   min over joints of d/h,     d: way from the centre of mass to the nearer end of the joint along the axis, h: its height above the
///   joint
///
/// of a column of N blocks b/(N H) [Housner63]. Above a joint are all blocks whose centre is; those that are joined there make one body,
/// whose joints with what is below must all be level and at one height. Blocks of the body that part may do so sooner. Zero where a centre
/// of mass is not above its joints; nothing where no part is so borne. `axis`: 0 x, 1 y. Blocks must be bounded by planes, gravity
/// downward.
std::optional<double> find_overturning(const Model& model, int axis);

/// The same of blocks in layers, whatever their heights, as one body on those of the first. `layer`: of every block, from 1.
std::optional<double> find_overturning_of_layers(const Model& model, const std::vector<int>& layer, int axis);

}  // namespace musim::lsdem
