#include "scaling/number.hpp"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <cstdlib>
#include <string>

#include "scaling/detail/number_text.hpp"
#include "scaling/shorten.hpp"

namespace musim::scaling {

namespace detail {

namespace {

constexpr std::string_view kBlanks = " \t\r\n";

/// Decimal exponents beyond this leave the range of doubles whatever the digits of a sane input are.
constexpr long kLargestWrittenExponent = 100'000;

/// Length of the decimal number that `text` begins with, 0 for none; nan, inf and hexadecimal numbers are none.
std::size_t number_length(std::string_view text) {
    const std::size_t sign = !text.empty() && (text[0] == '+' || text[0] == '-') ? 1 : 0;
    const std::string_view digits = text.substr(sign);
    if (digits.empty() || (digits[0] != '.' && (digits[0] < '0' || digits[0] > '9'))) return 0;
    double ignored = 0.0;
    const auto [end, status] = std::from_chars(digits.data(), digits.data() + digits.size(), ignored);
    return status == std::errc::invalid_argument ? 0 : sign + static_cast<std::size_t>(end - digits.data());
}

/// `number` × 10^shift, still as text; unchanged when its exponent fits no integer, which decimal_to_double() then refuses.
std::string shift_decimal(std::string_view number, int shift) {
    const std::size_t mark = number.find_first_of("eE");
    long exponent = 0;
    if (mark != std::string_view::npos) {
        std::string_view digits = number.substr(mark + 1);
        if (digits[0] == '+') digits.remove_prefix(1);
        const auto status = std::from_chars(digits.data(), digits.data() + digits.size(), exponent).ec;
        if (status != std::errc() || std::abs(exponent) > kLargestWrittenExponent) return std::string(number);
    }
    return fmt::format("{}e{}", number.substr(0, mark), exponent + shift);
}

double decimal_to_double(std::string_view number, std::string_view text) {
    if (number[0] == '+') number.remove_prefix(1);
    double value = 0.0;
    if (std::from_chars(number.data(), number.data() + number.size(), value).ec != std::errc()) {
        throw ParseError(
            fmt::format("\"{}\": the number is too large or too small for a double; check its exponent", shorten(text, kEchoed)));
    }
    return value;
}

}  // namespace

std::string_view trim(std::string_view text) {
    const std::size_t first = text.find_first_not_of(kBlanks);
    if (first == std::string_view::npos) return {};
    return text.substr(first, text.find_last_not_of(kBlanks) - first + 1);
}

NumberText split_number(std::string_view text) {
    const std::string_view trimmed = trim(text);
    NumberText number{.numerator = trimmed.substr(0, number_length(trimmed)), .denominator = {}, .rest = {}};
    if (number.numerator.empty()) {
        throw ParseError(
            fmt::format("\"{}\": does not begin with a finite number; write one such as 0.18, 1e-3 or 1/107", shorten(text, kEchoed)));
    }
    number.rest = trim(trimmed.substr(number.numerator.size()));

    // a slash belongs to the number when another number follows, else to the unit
    if (number.rest.starts_with('/')) {
        const std::string_view after = trim(number.rest.substr(1));
        number.denominator = after.substr(0, number_length(after));
        if (!number.denominator.empty()) number.rest = trim(after.substr(number.denominator.size()));
    }
    return number;
}

double to_double(const NumberText& number, int decimal_shift, std::string_view text) {
    const double numerator = decimal_to_double(shift_decimal(number.numerator, decimal_shift), text);
    if (number.denominator.empty()) return numerator;
    const double denominator = decimal_to_double(number.denominator, text);
    if (denominator == 0.0) throw ParseError(fmt::format("\"{}\": division by zero; give a nonzero denominator", shorten(text, kEchoed)));
    const double value = numerator / denominator;
    if (!std::isfinite(value) || (value == 0.0 && numerator != 0.0)) {
        throw ParseError(
            fmt::format("\"{}\": the fraction is too large or too small for a double; check both numbers", shorten(text, kEchoed)));
    }
    return value;
}

}  // namespace detail

double parse_number(std::string_view text) {
    const detail::NumberText number = detail::split_number(text);
    if (!number.rest.empty()) {
        throw ParseError(fmt::format("\"{}\": unexpected \"{}\" after the number; a plain number or one fraction is wanted, such as 1/107",
                                     shorten(text, kEchoed), shorten(number.rest, kEchoed)));
    }
    return detail::to_double(number, 0, text);
}

}  // namespace musim::scaling
