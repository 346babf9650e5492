#include "records/headers/own_titles.hpp"

#include <fmt/format.h>

#include <cmath>

#include "records/detail/text.hpp"

namespace musim::records::detail {
namespace {

/// The word behind a title and its "="; empty where the line has no such title.
std::string_view find_titled(std::string_view line, std::string_view title) {
    const std::size_t found = find_ignoring_case(line, title);
    if (found == std::string_view::npos) return {};
    std::string_view rest = line.substr(found + title.size());
    const std::string_view word = take_token(rest, " \t=");
    return word.empty() ? std::string_view("=") : word;  // a title without a word is no number
}

}  // namespace

std::optional<scaling::Frequency> find_integration_corner(const TextFile& file, std::size_t index) {
    const std::string_view number = find_titled(file.line(index), kCornerTitle);
    if (number.empty()) return std::nullopt;
    const std::optional<double> hertz = parse_real(number);
    if (!hertz || !(*hertz > 0.0 && std::isfinite(*hertz))) {
        file.fail(index, fmt::format("integration corner {} is no positive number", quoted(number)), "write it in Hz, or remove it");
    }
    return *hertz * scaling::si::hertz;
}

std::optional<scaling::Time> find_start_time(const TextFile& file, std::size_t index) {
    const std::string_view number = find_titled(file.line(index), kStartTitle);
    if (number.empty()) return std::nullopt;
    const std::optional<double> seconds = parse_real(number);
    if (!seconds || !std::isfinite(*seconds)) {
        file.fail(index, fmt::format("start time {} is no number", quoted(number)), "write it in s, or remove it");
    }
    return *seconds * scaling::si::seconds;
}

}  // namespace musim::records::detail
