#pragma once

#include <string>
#include <vector>

#include "scaling/laws/length_range.hpp"

namespace musim::cli {

/// Length scales found between records::kSmallestScale and 1: "1/50 ... 1/3.2", "up to 1/3.2", "from 1/50", "all", "none".
std::string describe_ranges(const std::vector<scaling::LengthRange>& ranges);

}  // namespace musim::cli
