#include "records/shake_table/table_axes.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace musim::records {
namespace {

std::vector<std::pair<std::string, std::string>> make_pairs(const GroundMotion& motion, const ShakeTable& table) {
    std::vector<std::pair<std::string, std::string>> pairs;
    std::vector<const TableAxis*> free;
    for (const TableAxis& axis : table.axes) free.push_back(&axis);
    for (const Component& component : motion.components) {
        const bool vertical = is_vertical(component);
        const auto axis =
            std::find_if(free.begin(), free.end(), [&](const TableAxis* each) { return is_vertical_axis(*each) == vertical; });
        if (axis == free.end()) {
            throw ReadError(fmt::format("{}: the table has no {} axis left for component {}; choose components with --axis {}=AXIS",
                                        motion.source.empty() ? "record" : motion.source, vertical ? "vertical" : "horizontal",
                                        component.name, motion.components.front().name));
        }
        pairs.emplace_back(component.name, (*axis)->name);
        free.erase(axis);
    }
    return pairs;
}

}  // namespace

bool is_vertical_axis(const TableAxis& axis) { return axis.name == "z" || axis.name == "vertical"; }

scaling::Shaking find_shaking(const TableAxis& axis) {
    return is_vertical_axis(axis) ? scaling::Shaking::vertical : scaling::Shaking::horizontal;
}

AssignedAxes assign_axes(const GroundMotion& motion, const ShakeTable& table,
                         const std::vector<std::pair<std::string, std::string>>& wanted) {
    AssignedAxes assigned{motion, {}};
    assigned.motion.components.clear();
    for (const auto& [component, axis] : wanted.empty() ? make_pairs(motion, table) : wanted) {
        const std::string& name = axis;
        if (std::any_of(assigned.axes.begin(), assigned.axes.end(), [&](const TableAxis& other) { return other.name == name; })) {
            throw ReadError(fmt::format("axis {} is to make two components; give each its own", name));
        }
        assigned.motion.components.push_back(motion.find_component(component));
        assigned.axes.push_back(table.find_axis(name));
    }
    return assigned;
}

}  // namespace musim::records
