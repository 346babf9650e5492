#include "records/headers/fixed_columns.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "records/detail/text.hpp"

namespace musim::records::detail {
namespace {

/// No line of a record is longer [letters]; keeps products of columns far from overflow.
constexpr std::size_t kLongestLine = 10000;

bool has_point(std::string_view number) { return number.find('.') != std::string_view::npos; }

}  // namespace

std::optional<FixedColumns> find_columns(std::string_view line) {
    for (std::size_t open = line.find('('); open != std::string_view::npos; open = line.find('(', open + 1)) {
        std::string_view rest = line.substr(open + 1);
        const std::size_t letter = rest.find_first_of("fFeEiI");
        if (letter == std::string_view::npos) continue;
        const bool is_integer = to_lower(rest[letter]) == 'i';
        const std::optional<std::size_t> per_line = parse_count(trim(rest.substr(0, letter)));
        rest.remove_prefix(letter + 1);
        const std::optional<std::size_t> width = parse_count(take_token(rest, ".)"));
        if (!per_line || !width || *per_line == 0 || *width == 0) continue;
        if (*per_line > kLongestLine || *width > kLongestLine) continue;
        return FixedColumns{.per_line = *per_line, .width = *width, .is_integer = is_integer};
    }
    return std::nullopt;
}

std::size_t lines_of(std::size_t count, const FixedColumns& columns) { return (count + columns.per_line - 1) / columns.per_line; }

std::string_view text_of_number(const TextFile& file, const NumberBlock& block, std::size_t i) {
    const auto& [per_line, width, indent, is_integer] = block.columns;
    const std::string_view line = file.line(block.line + i / per_line);
    return trim(line.substr(std::min(indent + i % per_line * width, line.size()), width));
}

std::vector<double> read_block(const TextFile& file, const NumberBlock& block, double si) {
    const auto& [per_line, width, indent, is_integer] = block.columns;
    std::vector<double> numbers;
    for (std::size_t i = 0; i < block.count; ++i) {
        const std::size_t index = block.line + i / per_line;
        const std::size_t start = indent + i % per_line * width;
        const std::string_view line = file.line(index);
        if (line.size() <= start) {
            file.fail(std::min(index, file.size() - 1),
                      fmt::format("{} {} of {} is missing (file is truncated)", block.noun, i + 1, block.count), "fetch the record again");
        }
        if (!trim(line.substr(0, indent)).empty()) {
            file.fail(index, fmt::format("line starts with {} (a blank is expected)", quoted(line)), "fetch the record again");
        }

        const std::string_view text = trim(line.substr(start, width));
        if (has_point(text) == is_integer) {
            const std::string_view why = is_integer ? "decimal point in a column of integers" : "no decimal point in its column";
            file.fail(index, fmt::format("{} {} is {} ({})", block.noun, i + 1, quoted(text), why),
                      "check the Fortran format above the numbers");
        }
        const std::optional<double> value = parse_real(text);
        if (!value || !std::isfinite(*value * si)) {
            file.fail(index, fmt::format("{} {} is {} (no finite number)", block.noun, i + 1, quoted(text)),
                      "repair the value or fetch the file again");
        }
        numbers.push_back(*value * si);

        const bool ends_line = (i + 1) % per_line == 0 || i + 1 == block.count;
        if (ends_line && line.size() > start + width) {
            file.fail(index, fmt::format("line goes on after {} {} (more values than the header's {})", block.noun, i + 1, block.count),
                      "correct the number of points");
        }
    }
    return numbers;
}

}  // namespace musim::records::detail
