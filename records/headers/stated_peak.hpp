#pragma once

#include <span>
#include <string_view>

#include "records/headers/text_file.hpp"

namespace musim::records::detail {

/// The sample farthest from `level`, minus that level, with its sign; 0 when there is none.
double signed_peak(std::span<const double> samples, double level = 0.0);

/// Mean of all samples, of which there is at least one.
double mean_of(std::span<const double> samples);

/// Throws ReadError unless the `measured` peak, in the header's unit, is the one that line `index` prints, to one unit of its last digit.
void check_stated_peak(const TextFile& file, std::size_t index, std::string_view name, std::string_view printed, double measured);

}  // namespace musim::records::detail
