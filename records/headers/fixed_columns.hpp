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

}  // namespace musim::records::detail
