#pragma once

#include <string_view>

#include "scaling/rational_dimension.hpp"

namespace musim::scaling::detail {

/// A unit read from text: 1 unit = numerator/denominator · 10^decimal_exponent in SI.
struct Unit {
    RationalDimension dimension;
    int decimal_exponent = 0;
    double numerator = 1.0;
    double denominator = 1.0;
};

/// Meaning of "g" and "mg".
enum class GramOrGravity { gram, gravity };

/// Reads a whole unit text such as "kN*s/m" by the grammar of parse_si(). `text` is the whole input, for messages.
/// Throws ParseError for an unknown unit (names the nearest) or a broken expression.
Unit parse_unit(std::string_view unit, GramOrGravity g, std::string_view text);

}  // namespace musim::scaling::detail
