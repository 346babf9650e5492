#pragma once

#include <span>
#include <string_view>
#include <vector>

#include "records/formats/detail/values.hpp"
#include "records/headers/text_file.hpp"

namespace musim::records::detail {

/// Rows of numbers, kept as columns.
struct NumberTable {
    std::vector<std::vector<double>> columns;
    std::vector<std::size_t> lines;  ///< of each row

    std::size_t rows() const { return lines.size(); }
};

/// The rows from line `begin` to the file's end, blank lines left out; column i times `si[i]`. Throws ReadError unless there is a row, and
/// every row holds one finite number a column, between blanks or commas.
NumberTable read_table(const TextFile& file, std::size_t begin, std::span<const double> si);

/// Throws ReadError unless the table has as many rows as announced.
void check_rows(const TextFile& file, const NumberTable& table, const AnnouncedCount& announced);

/// Time step of evenly rising times (2 % of a step), taken as the short decimal it means when within 1e-8; `lines` says where the times
/// stand. Throws ReadError when they are uneven or do not rise.
double even_time_step(const TextFile& file, std::span<const double> times, std::span<const std::size_t> lines);

}  // namespace musim::records::detail
