#pragma once

#include <string_view>

namespace musim::scaling::detail {

/// A number or fraction at the start of a text, still as text, and what follows it.
struct NumberText {
    std::string_view numerator;
    std::string_view denominator;  ///< empty without a fraction
    std::string_view rest;         ///< what follows, without leading or trailing blanks
};

/// `text` without leading and trailing blanks.
std::string_view trim(std::string_view text);

/// Splits `text` after its leading number or fraction. Throws ParseError when it does not begin with one.
NumberText split_number(std::string_view text);

/// Value of the number with its decimal point moved by `decimal_shift` digits before it is rounded: 12.710 moved by -3 is the double
/// 0.01271. `text` is the whole input, for messages. Throws ParseError for a zero denominator or a value outside the range of doubles.
double to_double(const NumberText& number, int decimal_shift, std::string_view text);

}  // namespace musim::scaling::detail
