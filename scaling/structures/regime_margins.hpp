#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "scaling/structures/regime_report.hpp"

namespace musim::scaling::detail {

/// How far a structure is from a border of a regime: a quantity over its limit, 1 on the border.
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
