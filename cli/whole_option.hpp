#pragma once

#include <algorithm>
#include <CLI/App.hpp>
#include <CLI/Option.hpp>
#include <concepts>
#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <string>

namespace musim::cli {

/// Whole numbers that an option takes, both ends included.
struct WholeRange {
    std::uint64_t low = 0;
    std::uint64_t high = std::numeric_limits<std::uint64_t>::max();
};

/// A whole number as people write it, always decimal: "10", "010" and "+10" are ten, so are "1e1" and "20/2"; "0x10" is none. Throws
/// scaling::ParseError, which names the range, for any other text and for what lies outside.
std::uint64_t parse_whole(const std::string& text, WholeRange range);

/// Adds an option whose whole number is given to `take`; `now` says what it is without the option, for the help. CLI11 alone would read 010
/// as octal, so whole numbers are added in this way and in no other (a test tries every option).
CLI::Option* add_whole_option(CLI::App& command, const std::string& name, const std::function<void(std::uint64_t)>& take,
                              const std::string& help, WholeRange range, const std::function<std::string()>& now = {});

/// The same for a variable, whose type bounds the range.
template <std::integral Whole>
CLI::Option* add_whole_option(CLI::App& command, const std::string& name, Whole& value, const std::string& help, WholeRange range = {}) {
    range.high = std::min(range.high, static_cast<std::uint64_t>(std::numeric_limits<Whole>::max()));
    return add_whole_option(
        command, name, [&value](std::uint64_t number) { value = static_cast<Whole>(number); }, help, range,
        [&value] { return std::to_string(value); });
}
template <std::integral Whole>
CLI::Option* add_whole_option(CLI::App& command, const std::string& name, std::optional<Whole>& value, const std::string& help,
                              WholeRange range = {}) {
    range.high = std::min(range.high, static_cast<std::uint64_t>(std::numeric_limits<Whole>::max()));
    return add_whole_option(
        command, name, [&value](std::uint64_t number) { value = static_cast<Whole>(number); }, help, range);
}

}  // namespace musim::cli
