#include "cli/whole_option.hpp"

#include <fmt/format.h>

#include <charconv>
#include <CLI/Error.hpp>
#include <cmath>
#include <string_view>

#include "scaling/number.hpp"
#include "scaling/shorten.hpp"

namespace musim::cli {
namespace {

/// Numbers below this are whole in a double one by one.
constexpr double kCountedByDoubles = 0x1p53;

std::string describe(WholeRange range) {
    const bool is_bounded = range.high != std::numeric_limits<std::uint64_t>::max();
    return is_bounded ? fmt::format("from {} to {}", range.low, range.high) : fmt::format("from {}", range.low);
}

[[noreturn]] void refuse(const std::string& text, const char* what, WholeRange range) {
    throw scaling::ParseError(fmt::format("{} is {}; give a whole number {}", scaling::shorten(text), what, describe(range)));
}

/// A number or fraction that is whole, such as 1e5.
std::uint64_t parse_whole_number(const std::string& text, WholeRange range) {
    double number = 0.0;
    try {
        number = scaling::parse_number(text);
    } catch (const scaling::ParseError&) {
        refuse(text, "no whole number", range);
    }
    if (number != std::floor(number)) refuse(text, "no whole number", range);
    if (!(number >= 0.0 && number < kCountedByDoubles)) refuse(text, "out of range", range);
    return static_cast<std::uint64_t>(number);
}

}  // namespace

std::uint64_t parse_whole(const std::string& text, WholeRange range) {
    std::uint64_t number = 0;
    const std::string_view digits = std::string_view(text).substr(text.starts_with('+') ? 1 : 0);
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), number);
    const bool is_digits = !digits.empty() && end == digits.data() + digits.size();
    if (is_digits && error != std::errc()) refuse(text, "out of range", range);
    if (!is_digits) number = parse_whole_number(text, range);
    if (number < range.low || number > range.high) refuse(text, "out of range", range);
    return number;
}

CLI::Option* add_whole_option(CLI::App& command, const std::string& name, const std::function<void(std::uint64_t)>& take,
                              const std::string& help, WholeRange range, const std::function<std::string()>& now) {
    const auto read = [take, range](const CLI::results_t& texts) {
        try {
            take(parse_whole(texts.back(), range));
        } catch (const scaling::ParseError& error) {
            throw CLI::ConversionError(error.what());
        }
        return true;
    };
    return command.add_option(name, CLI::callback_t(read), help, false, now)->type_name("N");
}

}  // namespace musim::cli
