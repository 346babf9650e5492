#include "scaling/structures/regime_margins.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "scaling/structures/border.hpp"
#include "scaling/structures/regime_borders.hpp"

namespace musim::scaling::detail {
namespace {

/// Both structures against the limit of a group.
void add_group(std::vector<RegimeMargin>& margins, std::string_view topic, const GroupComparison& group, double limit) {
    margins.push_back({topic, group.direction, fmt::format("{} of the prototype", group.name), group.prototype / limit});
    margins.push_back({topic, group.direction, fmt::format("{} of the model", group.name), group.model / limit});
}

/// The borders between the answers of find_first_motion().
void add_first_motion(std::vector<RegimeMargin>& margins, const StructureProperties& structure, const MotionProperties& motion,
                      Direction direction, std::string_view owner) {
    const double peak = (motion.acceleration / structure.gravity).value(), friction = structure.friction;
    const double slenderness = structure.rocking_block(direction).slenderness();
    const bool moves = find_first_motion(peak, friction, slenderness) != FirstMotion::rest;
    const auto add = [&](std::string_view what, double ratio, bool matters) {
        margins.push_back({"first motion", direction, fmt::format("{} of the {}", what, owner), ratio, matters});
    };
    add("the peak", peak / std::min(friction, slenderness), true);
    add("mu/tan(alpha)", friction / slenderness, moves);
    add("friction against the need of a rocking block", friction / find_friction_to_rock(peak, slenderness),
        moves && friction > slenderness);
}

void add_table_margins(std::vector<RegimeMargin>& margins, const MotionProperties& model, const Bandwidth& table) {
    for (const TableDemand& demand : list_table_demands(model)) {
        if (!demand.frequency) continue;
        for (const std::optional<Frequency>& limit : {table.lowest, table.highest}) {
            if (!limit) continue;
            margins.push_back({"table", {}, fmt::format("{} of the model", demand.name), (*demand.frequency / *limit).value()});
        }
    }
}

}  // namespace

std::vector<RegimeMargin> find_regime_margins(const PairProperties& properties, const std::vector<GroupComparison>& groups) {
    std::vector<RegimeMargin> margins;
    for (const GroupComparison& group : groups) {
        if (const Border* const border = find_border(group.name)) add_group(margins, border->topic, group, 1.0);
        if (group.name == "delta_w/sigma_H") add_group(margins, "contacts", group, kRigidContact);
    }
    if (properties.motion && properties.model_motion) {
        for (const Direction direction : {Direction::thin, Direction::wide}) {
            add_first_motion(margins, properties.prototype, *properties.motion, direction, "prototype");
            add_first_motion(margins, properties.model, *properties.model_motion, direction, "model");
        }
        if (properties.table) add_table_margins(margins, *properties.model_motion, *properties.table);
    }
    return margins;
}

}  // namespace musim::scaling::detail
