#include "records/headers/own_titles.hpp"

#include <fmt/format.h>

#include <algorithm>
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

bool is_code(std::string_view text, std::size_t longest) {
    return !text.empty() && text.size() <= longest &&
           std::all_of(text.begin(), text.end(), [](char letter) { return is_digit(letter) || (letter >= 'A' && letter <= 'Z'); });
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

StationCodes split_station(std::string_view text, std::string_view unknown) {
    constexpr std::size_t kNetwork = 2;
    constexpr std::size_t kStation = 5;
    std::string_view rest = text;
    const std::string_view codes = take_token(rest);
    const std::size_t dot = codes.find('.');
    if (dot != std::string_view::npos && is_code(codes.substr(0, dot), kNetwork) && is_code(codes.substr(dot + 1), kStation)) {
        return {std::string(codes.substr(0, dot)), std::string(codes.substr(dot + 1)), printable(trim(rest))};
    }
    return {.station = std::string(unknown), .name = printable(trim(text))};
}

}  // namespace musim::records::detail
