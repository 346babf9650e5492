#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "scaling/structures/structure_properties.hpp"

namespace musim::scaling {

/// A dimensionless group of one structure under one motion.
struct GroupValue {
    std::string_view name;                    ///< as find_group_meaning() knows it
    std::optional<Direction> direction = {};  ///< of rocking, where it matters
    std::optional<double> value = {};         ///< absent: not in the properties
};

/// Every group of geometry, friction, contact, rocking and loading (docs/theory/structural_response.md), given or not, in a fixed order.
///
/// `motion` may be null. `wanted_block_height` is H of the prototype, or λ_l times that for its model. ω of ω/p is 2π over the pulse period
/// or, without one, over the predominant period.
std::vector<GroupValue> find_group_values(const StructureProperties& properties, const MotionProperties* motion,
                                          Length wanted_block_height);

}  // namespace musim::scaling
