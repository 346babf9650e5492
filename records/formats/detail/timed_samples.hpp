#pragma once

#include <vector>

#include "records/formats/resample_uneven.hpp"
#include "records/headers/fixed_columns.hpp"

namespace musim::records::detail {

/// Samples with a time each, as a file of (time, value) pairs holds them.
struct TimedSamples {
    std::size_t line = 0;         ///< where the pairs start
    std::vector<double> times;    ///< [s], strictly rising
    std::vector<double> samples;  ///< times si
};

/// Reads a block of numbers that are (time, value) pairs; its count, of numbers, must be even. Throws ReadError as read_block() does and
/// when a time does not rise.
TimedSamples read_timed_samples(const TextFile& file, const NumberBlock& block, double si);

/// The samples on an even clock; what resample_uneven() refuses is reported with the file and the line where the pairs start.
ResampledSeries resample(const TextFile& file, SampleQuantity quantity, const TimedSamples& timed);

}  // namespace musim::records::detail
