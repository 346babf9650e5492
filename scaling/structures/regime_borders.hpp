#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "scaling/structures/regime_report.hpp"

/// Where one kind of response ends and another begins.
namespace musim::scaling::detail {

/// A group whose response is of another kind above 1 than below.
struct Border {
    std::string_view group, topic;
    std::string_view above, below;  ///< what happens on either side
    std::string_view remedy;        ///< when prototype and model differ
};

/// The border of a group; null for a group without one.
const Border* find_border(std::string_view group);

/// Response at a value of the group.
std::string_view name_side(const Border& border, double value);

/// One frequency of the model's motion against the table's, and how bad it is if the table does not follow it.
struct TableDemand {
    std::string_view name;
    std::optional<Frequency> frequency;
    Severity severity;
};

/// Those of a motion, given or not.
std::array<TableDemand, 4> list_table_demands(const MotionProperties& model);

/// Statement of a group that has a border at 1 about both structures; nothing for a group without one.
std::optional<RegimeStatement> cross_border(const GroupComparison& group);

/// First motion of a block under the peak of each base motion, per direction.
void add_first_motions(std::vector<RegimeStatement>& regimes, const PairProperties& shaken);

/// Whether dead weight closes the uneven gaps, where δ_w/σ_H is among the groups.
void add_contacts(std::vector<RegimeStatement>& regimes, const std::vector<GroupComparison>& groups);

/// Whether a table follows the frequencies of the model's motion, as far as both are known.
void add_table(std::vector<RegimeStatement>& regimes, const MotionProperties& model, const Bandwidth& table);

/// Distance of a structure from a border of a regime: a quantity over its limit, 1 on the border.
struct RegimeMargin {
    std::string_view topic;  ///< of the RegimeStatement
    std::optional<Direction> direction = {};
    std::string what = {};  ///< "mu/tan(alpha) of the model"
    double ratio = 1.0;     ///< [-]
    bool matters = true;    ///< where it is: a block at rest does not ask whether it would slide or rock
};

/// All that the properties give; as many for other values of the same properties. `properties` has the motion of the model, `groups` are
/// theirs.
std::vector<RegimeMargin> find_regime_margins(const PairProperties& properties, const std::vector<GroupComparison>& groups);

}  // namespace musim::scaling::detail
