#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

/// Locale-free text helpers of the readers.
namespace musim::records::detail {

constexpr bool is_digit(char letter) { return letter >= '0' && letter <= '9'; }
constexpr bool is_blank(char letter) { return letter == ' ' || letter == '\t' || letter == '\r' || letter == '\v' || letter == '\f'; }
constexpr char to_lower(char letter) { return letter >= 'A' && letter <= 'Z' ? static_cast<char>(letter - 'A' + 'a') : letter; }

bool equal_ignoring_case(std::string_view a, std::string_view b);

/// Position of `wanted` in `text` at or after `from`, ignoring case; npos when absent.
std::size_t find_ignoring_case(std::string_view text, std::string_view wanted, std::size_t from = 0);
inline bool contains_ignoring_case(std::string_view text, std::string_view wanted) {
    return find_ignoring_case(text, wanted) != std::string_view::npos;
}

std::string_view trim(std::string_view text);

/// Takes the next token off the front of `rest`: letters up to one of `separators`, which are skipped first. Empty at the end.
std::string_view take_token(std::string_view& rest, std::string_view separators = " \t");

/// Text up to the next gap of three blanks, trimmed: header lines of fixed columns hold several fields.
std::string_view first_field(std::string_view line);

/// Token after `name` and an equals sign, "12080" in "NO. OF POINTS =  12080"; empty when `name` is absent.
std::string_view value_of(std::string_view line, std::string_view name);

/// The whole of `text` as a finite decimal number; Fortran's exponent letter D and a leading plus are accepted. Nothing otherwise.
std::optional<double> parse_real(std::string_view text);

/// The whole of `text` as a non-negative integer; nothing otherwise.
std::optional<std::size_t> parse_count(std::string_view text);

/// `text` with every byte that is no printable ASCII letter replaced by a question mark.
std::string printable(std::string_view text);

/// `text` in quotes for a one-line message: shortened, unprintable bytes replaced.
std::string quoted(std::string_view text);

/// Shortest decimal, of six digits at most, within 1e-8 of a positive `value`, that numbers printed in decimals can mean:
/// 0.00999999999999998 is 0.01. `value` itself when there is none.
double to_short_decimal(double value);

}  // namespace musim::records::detail
