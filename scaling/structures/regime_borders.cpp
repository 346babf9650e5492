#include "scaling/structures/regime_borders.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "scaling/quantity_text.hpp"
#include "scaling/structures/border.hpp"

namespace musim::scaling::detail {
namespace {

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

}  // namespace

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

}  // namespace musim::scaling::detail
