#pragma once

#include <array>
#include <optional>
#include <string_view>
#include <vector>

#include "scaling/structures/regime_report.hpp"

/// Where one kind of response ends and another begins.
namespace musim::scaling::detail {

/// One frequency of the model's motion against the table's, and how bad it is if the table does not follow it.
struct TableDemand {
    std::string_view name;
    std::optional<Frequency> frequency;
    Severity severity;
};

/// Those of a motion, given or not.
std::array<TableDemand, 4> list_table_demands(const MotionProperties& model);

/// What a group that has a border at 1 says about both structures; nothing for a group without one.
std::optional<RegimeStatement> cross_border(const GroupComparison& group);

/// What a block does first under the peak of each motion, per direction.
void add_first_motions(std::vector<RegimeStatement>& regimes, const PairProperties& shaken);

/// Whether dead weight closes the uneven gaps, where δ_w/σ_H is among the groups.
void add_contacts(std::vector<RegimeStatement>& regimes, const std::vector<GroupComparison>& groups);

/// Whether a table follows the frequencies of the model's motion, as far as both are known.
void add_table(std::vector<RegimeStatement>& regimes, const MotionProperties& model, const Bandwidth& table);

}  // namespace musim::scaling::detail
