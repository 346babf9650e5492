#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "records/headers/text_file.hpp"

namespace musim::records::detail {

/// Number of samples that a header announces, and its name there, e.g. "NPTS".
struct AnnouncedCount {
    std::size_t count = 0;
    std::string name = {};
};

/// All numbers, between blanks or commas, on the lines from `begin` to before `end`, times `si`. Throws ReadError unless they are finite
/// and as many as announced.
std::vector<double> read_values(const TextFile& file, std::size_t begin, std::size_t end, const AnnouncedCount& announced, double si);

/// Rows of numbers, kept as columns.
struct NumberTable {
    std::vector<std::vector<double>> columns;
    std::vector<std::size_t> lines;  ///< of each row

    std::size_t rows() const { return lines.size(); }
};

/// The rows from line `begin` to the file's end, blank lines left out; column i times `si[i]`. Throws ReadError unless there is a row, and
/// every row holds one finite number a column, between blanks or commas.
NumberTable read_table(const TextFile& file, std::size_t begin, std::span<const double> si);

/// The letters of value `ordinal`, from 0, that read_values() read from line `begin` on.
std::string_view text_of_value(const TextFile& file, std::size_t begin, std::size_t ordinal);

/// The letters of a value that read_table() read.
std::string_view text_in_table(const TextFile& file, const NumberTable& table, std::size_t row, std::size_t column);

/// Throws ReadError unless the table has as many rows as announced.
void check_rows(const TextFile& file, const NumberTable& table, const AnnouncedCount& announced);

/// Time step of evenly rising times (2 % of a step), taken as the short decimal it means when within 1e-8; `lines` says where the times
/// stand. Times `printed` to a digit worth so many seconds, at most half a step, may be off by it; the step is then a whole number of
/// samples a second where all of them allow it. Throws ReadError when they are uneven or do not rise.
double even_time_step(const TextFile& file, std::span<const double> times, std::span<const std::size_t> lines, double printed = 0.0);

}  // namespace musim::records::detail
