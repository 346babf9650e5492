#pragma once

#include <optional>
#include <vector>

#include "records/headers/fixed_columns.hpp"

namespace musim::records::detail {

/// A header of numbers in columns, counted from 1 as descriptions of formats do, with one number that stands for unknown.
struct NumericHeader {
    NumberBlock block = {};
    std::vector<double> numbers = {};
    double unknown = 0.0;

    /// The line where a number stands.
    std::size_t line_of(std::size_t number) const { return block.line + (number - 1) / block.columns.per_line; }
    /// The first line behind the header.
    std::size_t end() const { return block.line + lines_of(block.count, block.columns); }
    /// The number; nothing when the header is shorter or says it is unknown.
    std::optional<double> find(std::size_t number) const {
        if (number > numbers.size() || numbers[number - 1] == unknown) return std::nullopt;
        return numbers[number - 1];
    }
    /// The number as a positive integer below 10000, enough for dates and azimuths; nothing otherwise.
    std::optional<int> find_small(std::size_t number) const {
        const std::optional<double> found = find(number);
        if (!found || *found < 0.0 || *found >= 10000.0) return std::nullopt;
        return static_cast<int>(*found);
    }
};

/// Reads the numbers of `block`; errors as read_block().
inline NumericHeader read_numeric_header(const TextFile& file, const NumberBlock& block, double unknown) {
    return {block, read_block(file, block), unknown};
}

}  // namespace musim::records::detail
