#include "scaling/structures/regime_borders.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "scaling/quantity_text.hpp"

namespace musim::scaling::detail {

namespace {

constexpr Border kBorders[] = {
    {"mu/tan(alpha)", "sliding or rocking first", "rocking can start first", "sliding first",
     "no scaling of the input restores it, choose a model material with friction nearer the prototype's"},
    {"a/(g*tan(alpha))", "uplift", "the peak lifts a block", "the peak lifts no block",
     "the motion of law froude keeps this group, with equal friction that of law mu does too"},
    {"a/(mu*g)", "sliding", "the peak moves a block", "the peak moves no block",
     "the motion of law mu keeps this group, with equal friction that of law froude does too"},
};

/// Rounding alone crosses no border.
bool is_kept(double model, double prototype) { return std::abs(model / prototype - 1.0) <= kFactorRounding; }

std::optional<Frequency> invert(const std::optional<Time>& period) {
    return period ? std::optional<Frequency>(1.0 / *period) : std::nullopt;
}

std::string describe_bandwidth(const Bandwidth& table) {
    if (!table.highest) return "from " + format_quantity(*table.lowest, 4);
    if (!table.lowest) return "up to " + format_quantity(*table.highest, 4);
    return fmt::format("from {} to {}", format_quantity(*table.lowest, 4), format_quantity(*table.highest, 4));
}

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

const Border* find_border(std::string_view group) {
    const auto* const found =
        std::find_if(std::begin(kBorders), std::end(kBorders), [&](const Border& each) { return each.group == group; });
    return found == std::end(kBorders) ? nullptr : found;
}

std::string_view name_side(const Border& border, double value) { return value > 1.0 ? border.above : border.below; }

std::array<TableDemand, 4> list_table_demands(const MotionProperties& model) {
    return {{{"pulse frequency", invert(model.pulse_period), Severity::error},
             {"predominant frequency", invert(model.predominant_period), Severity::error},
             {"lowest frequency", model.lowest_frequency, Severity::warning},
             {"highest frequency", model.highest_frequency, Severity::warning}}};
}

std::optional<RegimeStatement> cross_border(const GroupComparison& group) {
    const Border* const border = find_border(group.name);
    if (border == nullptr) return std::nullopt;
    RegimeStatement statement{.topic = border->topic, .direction = group.direction, .sources = group.sources};
    const bool is_crossed = (group.prototype > 1.0) != (group.model > 1.0) && !is_kept(group.model, group.prototype);
    if (!is_crossed) {
        statement.statement = fmt::format("{} is {:.4g} and {:.4g}: {} in both", group.name, group.prototype, group.model,
                                          name_side(*border, group.prototype));
        return statement;
    }
    statement.severity = Severity::error;
    statement.statement = fmt::format("{} goes from {:.4g} ({}) to {:.4g} ({}); {}", group.name, group.prototype,
                                      name_side(*border, group.prototype), group.model, name_side(*border, group.model), border->remedy);
    return statement;
}

void add_first_motions(std::vector<RegimeStatement>& regimes, const PairProperties& shaken) {
    for (const Direction direction : {Direction::thin, Direction::wide}) {
        const auto find_motion = [&](const StructureProperties& properties, const MotionProperties& motion) {
            return find_first_motion(motion.acceleration / properties.gravity, properties.friction,
                                     properties.rocking_block(direction).slenderness());
        };
        const FirstMotion prototype = find_motion(shaken.prototype, *shaken.motion),
                          model = find_motion(shaken.model, *shaken.model_motion);
        RegimeStatement statement{.topic = "first motion", .direction = direction, .sources = {"Shenton96", "derived"}};
        if (prototype == model) {
            statement.statement = fmt::format("under the peak a single block {} in both", to_string(model));
        } else {
            statement.severity = Severity::error;
            statement.statement =
                fmt::format("under the peak a single block {} in the prototype, {} in the model", to_string(prototype), to_string(model));
        }
        regimes.push_back(statement);
    }
}

void add_contacts(std::vector<RegimeStatement>& regimes, const std::vector<GroupComparison>& groups) {
    const auto group = std::find_if(groups.begin(), groups.end(), [](const auto& each) { return each.name == "delta_w/sigma_H"; });
    if (group == groups.end()) return;
    const bool is_prototype_rigid = group->prototype < kRigidContact, is_model_rigid = group->model < kRigidContact;
    const auto describe = [](bool is_rigid) { return is_rigid ? "rigid: heights decide who carries" : "soft: weight closes the gaps"; };
    RegimeStatement statement{.topic = "contacts", .sources = group->sources};
    if (is_prototype_rigid == is_model_rigid) {
        statement.statement =
            fmt::format("{} is {:.4g} and {:.4g}: {} in both", group->name, group->prototype, group->model, describe(is_model_rigid));
    } else {
        statement.severity = Severity::warning;
        statement.statement = fmt::format("{} goes from {:.4g} ({}) to {:.4g} ({}), border {:g}", group->name, group->prototype,
                                          describe(is_prototype_rigid), group->model, describe(is_model_rigid), kRigidContact);
    }
    regimes.push_back(statement);
}

void add_table(std::vector<RegimeStatement>& regimes, const MotionProperties& model, const Bandwidth& table) {
    if (!table.lowest && !table.highest) return;
    RegimeStatement statement{.topic = "table", .sources = {"derived"}};
    std::string outside, inside;
    for (const TableDemand& demand : list_table_demands(model)) {
        if (!demand.frequency) continue;
        const bool is_outside =
            (table.lowest && *demand.frequency < *table.lowest) || (table.highest && *demand.frequency > *table.highest);
        std::string& list = is_outside ? outside : inside;
        list += fmt::format("{}{} {}", list.empty() ? "" : ", ", demand.name, format_quantity(*demand.frequency, 4));
        if (is_outside) statement.severity = std::max(statement.severity.value_or(Severity::note), demand.severity);
    }
    if (outside.empty() && inside.empty()) return;
    statement.statement = outside.empty()
                              ? fmt::format("the table follows the model's {} ({})", inside, describe_bandwidth(table))
                              : fmt::format(
                                    "the table does not follow the model's {} (it goes {}); choose a larger length scale, which "
                                    "lowers frequencies, or another table",
                                    outside, describe_bandwidth(table));
    regimes.push_back(statement);
}

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
