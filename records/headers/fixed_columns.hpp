#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "records/headers/text_file.hpp"

namespace musim::records::detail {

/// Numbers in columns of one width, which may touch: Fortran's (8f9.6) is 8 a line, 9 letters each.
struct FixedColumns {
    std::size_t per_line = 8;
    std::size_t width = 0;
    std::size_t indent = 0;   ///< blanks before the first column
    bool is_integer = false;  ///< Fortran's I: no decimal point; otherwise there must be one, which shows that the columns are met
};

/// The Fortran format somewhere in `line`, "... Format=(10I8)"; nothing when there is none.
std::optional<FixedColumns> find_columns(std::string_view line);

/// Lines that `count` numbers take.
std::size_t lines_of(std::size_t count, const FixedColumns& columns);

/// Where numbers stand and what messages call them.
struct NumberBlock {
    std::size_t line = 0;   ///< of the first number
    std::size_t count = 0;  ///< as the file says; never trusted with memory
    FixedColumns columns = {};
    std::string_view noun = "sample";
};

/// Reads the numbers of a block, times `si`. Throws ReadError when one is missing, not finite or not in its column, or a line goes on.
std::vector<double> read_block(const TextFile& file, const NumberBlock& block, double si = 1.0);

/// The letters of number `i` of a block that was read, without blanks.
std::string_view text_of_number(const TextFile& file, const NumberBlock& block, std::size_t i);

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
    /// The number as a part of a date, an integer from 0 and below 10000; −1, which no date holds, otherwise.
    int date_part(std::size_t number) const {
        const double found = find(number).value_or(-1.0);
        return found >= 0.0 && found < 10000.0 ? static_cast<int>(found) : -1;
    }
};

/// Reads the numbers of `block`; errors as read_block().
inline NumericHeader read_numeric_header(const TextFile& file, const NumberBlock& block, double unknown) {
    return {block, read_block(file, block), unknown};
}

}  // namespace musim::records::detail
