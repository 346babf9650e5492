#pragma once

#include <string>
#include <utility>
#include <vector>

#include "records/ground_motion.hpp"
#include "records/shake_table/shake_table.hpp"
#include "scaling/laws/model_scales.hpp"

namespace musim::records {

/// The components of a record that a table is to make, and the axis that makes each.
struct AssignedAxes {
    GroundMotion motion;
    std::vector<TableAxis> axes;  ///< one for each component of `motion`
};

/// Picks components and axes as `wanted` says: (component, axis) pairs. Without any, all components: vertical ones (named Up, UD, Z, HNZ
/// and the like) go to the axis called "z" or "vertical", the others to the other axes in turn. Throws ReadError for a name that there is
/// not, an axis that is to make two components, and when the table has too few axes.
AssignedAxes assign_axes(const GroundMotion& motion, const ShakeTable& table,
                         const std::vector<std::pair<std::string, std::string>>& wanted);

/// Whether an axis is called "z" or "vertical".
bool is_vertical_axis(const TableAxis& axis);

/// Which way an axis shakes, by is_vertical_axis().
scaling::Shaking find_shaking(const TableAxis& axis);

}  // namespace musim::records
