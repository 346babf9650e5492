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
void add_first_motion(std::vector<RegimeMargin>& margins, const StructureFacts& structure, const MotionFacts& motion, Direction direction,
                      std::string_view owner) {
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

void add_table_margins(std::vector<RegimeMargin>& margins, const MotionFacts& model, const Bandwidth& table) {
    for (const TableDemand& demand : list_table_demands(model)) {
        if (!demand.frequency) continue;
        for (const std::optional<Frequency>& limit : {table.lowest, table.highest}) {
            if (!limit) continue;
            margins.push_back({"table", {}, fmt::format("{} of the model", demand.name), (*demand.frequency / *limit).value()});
        }
    }
}

}  // namespace

std::vector<RegimeMargin> find_regime_margins(const PairFacts& facts, const std::vector<GroupComparison>& groups) {
    std::vector<RegimeMargin> margins;
    for (const GroupComparison& group : groups) {
        if (const Border* const border = find_border(group.name)) add_group(margins, border->topic, group, 1.0);
        if (group.name == "delta_w/sigma_H") add_group(margins, "contacts", group, kRigidContact);
    }
    if (facts.motion && facts.model_motion) {
        for (const Direction direction : {Direction::thin, Direction::wide}) {
            add_first_motion(margins, facts.prototype, *facts.motion, direction, "prototype");
            add_first_motion(margins, facts.model, *facts.model_motion, direction, "model");
        }
        if (facts.table) add_table_margins(margins, *facts.model_motion, *facts.table);
    }
    return margins;
}

}  // namespace musim::scaling::detail
