#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "scaling/rational_dimension.hpp"

namespace musim::scaling::detail {

/// A unit to print in: chosen for values from `from` upwards [SI].
struct DisplayUnit {
    std::string_view name;
    double size = 1.0;  ///< one unit in SI
    double from = 1.0;
};

/// Names and spelling of a dimension.
struct DimensionName {
    Dimension dimension;
    std::string_view name;                   ///< with its article: "a stiffness"
    std::string_view example;                ///< "30 MN/m"
    std::vector<DisplayUnit> display_units;  ///< from the smallest, which takes all below, to the largest
};

/// The entry of a dimension, or null when it has no name.
const DimensionName* find_dimension_name(const RationalDimension& dimension);

/// "a stiffness", or "in kg m^2 s^-5" for a dimension without a name.
std::string describe(const RationalDimension& dimension);

/// Request in words: "a stiffness is wanted (such as "30 MN/m")", or "a quantity in kg m^2 s^-5 is wanted".
std::string describe_wish(const RationalDimension& dimension);

/// SI base units of a dimension: "kg m^2 s^-5", halves as "m^0.5", other fractions as "m^(1/3)"; empty for a plain number.
std::string base_units(const RationalDimension& dimension);

}  // namespace musim::scaling::detail
