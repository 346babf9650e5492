#pragma once

#include <string>
#include <vector>

#include "records/headers/text_file.hpp"

namespace musim::records::detail {

/// How many samples a header announces, and what it calls that number, e.g. "NPTS".
struct AnnouncedCount {
    std::size_t count = 0;
    std::string name = {};
};

/// All numbers, between blanks or commas, on the lines from `begin` to before `end`, times `si`. Throws ReadError unless they are finite
/// and as many as announced.
std::vector<double> read_values(const TextFile& file, std::size_t begin, std::size_t end, const AnnouncedCount& announced, double si);

}  // namespace musim::records::detail
