#pragma once

#include <string_view>

#include "scaling/error.hpp"

namespace musim::scaling {

/// A number or a fraction of two numbers: "0.18", "1e-3", "-2", "1/107", "0.63/0.59"; blanks around numbers are ignored.
///
/// A fraction is one correctly rounded division. Throws ParseError for empty or trailing text, a zero denominator, nan, inf, and what
/// does not fit a double.
double parse_number(std::string_view text);

}  // namespace musim::scaling
