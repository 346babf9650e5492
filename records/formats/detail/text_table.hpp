#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "records/formats/detail/text_cells.hpp"
#include "records/headers/text_file.hpp"

namespace musim::records::detail {

/// Line of text above the rows of numbers.
struct TextLine {
    std::size_t line = 0;        ///< index in the file
    std::string_view text = {};  ///< without the mark of a comment
    bool is_comment = false;
};

/// Row of numbers.
struct TextRow {
    std::size_t line = 0;   ///< index in the file
    std::size_t first = 0;  ///< of its values
    std::size_t size = 0;
};

/// Numbers and times of a text file, row by row, and the text above them.
struct TextTable {
    CellSyntax syntax = {};
    std::vector<TextLine> header = {};
    std::vector<double> values = {};  ///< NaN where a cell holds none
    std::vector<TextRow> rows = {};
    std::vector<CellKind> kinds = {};  ///< by column, of the first cell that holds a value; numbers beyond
    std::optional<UtcTime> zero = {};  ///< instants and dates are seconds after it
    bool is_utc = false;               ///< the dates say their zone

    std::size_t columns() const { return rows.front().size; }
    CellKind kind(std::size_t column) const { return column < kinds.size() ? kinds[column] : CellKind::number; }
    double at(std::size_t row, std::size_t column) const { return values[rows[row].first + column]; }
};

/// The rows of numbers of a text file. Lines that begin with '#', '%', '//', '!', '$' or '*' are comments; the last kind above the numbers
/// only. A column of dates and one of times of day become one of instants; times of day go on beyond midnight. Throws ReadError when there
/// is no row, or a cell below the first row is no number.
TextTable read_text_table(const TextFile& file);

/// Makes rows of `columns` values each, in the order in which the file has them. Throws ReadError when values are left over.
void reshape(const TextFile& file, TextTable& table, std::size_t columns);

/// Throws ReadError unless rows are equally long; the last may be shorter when `may_end_short`.
void require_even_rows(const TextFile& file, const TextTable& table, bool may_end_short);

/// Throws ReadError when a cell of the column holds no value.
void require_values(const TextFile& file, const TextTable& table, std::size_t column);

/// Last digit printed of the numbers or seconds in a column, e.g. 0.001; of what is printed with exponents the coarsest.
double find_printed_step(const TextFile& file, const TextTable& table, std::size_t column);

}  // namespace musim::records::detail
