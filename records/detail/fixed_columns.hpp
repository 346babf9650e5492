#pragma once

#include <vector>

#include "records/detail/text_file.hpp"

namespace musim::records::detail {

/// Fixed columns of a block of numbers, Fortran's (8f9.6): 8 values a line, 9 letters each, which may touch.
struct FixedColumns {
    std::size_t per_line = 8;
    std::size_t width = 0;

    /// Number of lines that `count` (at least one) values take.
    std::size_t lines_of(std::size_t count) const { return (count - 1) / per_line + 1; }
};

/// The `count` samples from line `first` on, times `si`. Throws ReadError when one is missing, is no finite number with a decimal point, or
/// when a line goes on behind its last value.
std::vector<double> read_fixed_columns(const TextFile& file, std::size_t first, std::size_t count, const FixedColumns& columns, double si);

}  // namespace musim::records::detail
