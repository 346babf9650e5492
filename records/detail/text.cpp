#include "records/detail/text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

namespace musim::records::detail {

bool equal_ignoring_case(std::string_view a, std::string_view b) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](char x, char y) { return to_lower(x) == to_lower(y); });
}

std::size_t find_ignoring_case(std::string_view text, std::string_view wanted, std::size_t from) {
    if (from > text.size()) return std::string_view::npos;
    const auto found = std::search(text.begin() + static_cast<std::ptrdiff_t>(from), text.end(), wanted.begin(), wanted.end(),
                                   [](char x, char y) { return to_lower(x) == to_lower(y); });
    return found == text.end() ? std::string_view::npos : static_cast<std::size_t>(found - text.begin());
}

std::string_view trim(std::string_view text) {
    while (!text.empty() && is_blank(text.front())) text.remove_prefix(1);
    while (!text.empty() && is_blank(text.back())) text.remove_suffix(1);
    return text;
}

std::string_view take_token(std::string_view& rest, std::string_view separators) {
    rest.remove_prefix(std::min(rest.find_first_not_of(separators), rest.size()));
    const std::string_view token = rest.substr(0, rest.find_first_of(separators));
    rest.remove_prefix(token.size());
    return token;
}

std::string_view first_field(std::string_view line) { return trim(line.substr(0, line.find("   "))); }

std::string_view value_of(std::string_view line, std::string_view name) {
    const std::size_t found = find_ignoring_case(line, name);
    std::string_view rest = found == std::string_view::npos ? std::string_view{} : line.substr(found + name.size());
    return take_token(rest, " =");
}

std::optional<double> parse_real(std::string_view text) {
    if (text.starts_with('+')) text.remove_prefix(1);
    if (text.empty() || text.front() == '+') return std::nullopt;

    // Fortran double precision writes 0.1D-03
    std::string plain;
    if (text.find_first_of("dD") != std::string_view::npos) {
        plain = text;
        std::replace_if(
            plain.begin(), plain.end(), [](char letter) { return letter == 'd' || letter == 'D'; }, 'e');
        text = plain;
    }

    double value = 0.0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (end != text.data() + text.size()) return std::nullopt;
    if (error == std::errc::result_out_of_range) {
        // too small is zero for our purposes, too large is no sample
        const bool is_tiny = text.find("e-") != std::string_view::npos || text.find("E-") != std::string_view::npos;
        return is_tiny ? std::optional<double>(0.0) : std::nullopt;
    }
    if (error != std::errc{} || !std::isfinite(value)) return std::nullopt;
    return value;
}

std::optional<std::size_t> parse_count(std::string_view text) {
    std::size_t value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
    return value;
}

std::string printable(std::string_view text) {
    std::string result(text);
    std::replace_if(
        result.begin(), result.end(), [](char letter) { return letter < ' ' || letter > '~'; }, '?');
    return result;
}

std::string quoted(std::string_view text) {
    constexpr std::size_t kLongest = 32;  // letters; enough to recognise the place, short enough for one line
    std::string shown = "'";
    for (const char letter : text.substr(0, kLongest)) shown += letter >= ' ' && letter <= '~' ? letter : '?';
    shown += text.size() > kLongest ? "...'" : "'";
    return shown;
}

double to_short_decimal(double value) {
    constexpr double kDust = 1e-8;  // relative; times are printed to six decimals or more over at most some 10⁴ s
    for (int digits = 1; digits <= 6; ++digits) {
        const std::optional<double> rounded = parse_real(fmt::format("{:.{}e}", value, digits - 1));
        if (rounded && std::abs(*rounded - value) <= kDust * value) return *rounded;
    }
    return value;
}

}  // namespace musim::records::detail
