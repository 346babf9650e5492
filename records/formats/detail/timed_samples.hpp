#pragma once

#include <vector>

#include "records/formats/resample_uneven.hpp"
#include "records/headers/fixed_columns.hpp"
#include "records/headers/text_file.hpp"

namespace musim::records::detail {

/// Samples with a time each, as a file of (time, value) pairs holds them.
struct TimedSamples {
    std::size_t line = 0;         ///< where the pairs start
    std::vector<double> times;    ///< [s], strictly rising
    std::vector<double> samples;  ///< times si
    std::size_t spread = 0;       ///< times that are printed alike and were spread within their last digit
};

/// Reads a block of numbers that are (time, value) pairs; its count, of numbers, must be even. Times that rounding made equal are spread
/// evenly within their last digit. Throws ReadError as read_block() does and when a time falls.
TimedSamples read_timed_samples(const TextFile& file, const NumberBlock& block, double si);

/// The samples on an even clock; what resample_uneven() refuses is reported with the file and the line where the pairs start.
ResampledSeries resample(const TextFile& file, SampleQuantity quantity, const TimedSamples& timed);

/// Lines of the headers above the pairs: 13 of text, 7 of integers, 7 of reals.
inline constexpr std::size_t kVolume1HeaderLines = 27;

/// The unit of the values.
inline const SampleUnit kTenthOfG{"g/10", SampleQuantity::acceleration, 0.1 * scaling::kStandardGravity.value()};

/// True when the text header from line `start` on says that samples are in g/10, each after its time.
bool announces_volume1_pairs(const TextFile& file, std::size_t start);

/// Reads an uncorrected channel of the older kind (CSMIP, RENADIC, USC), whose headers start on line `index`: times [s] and values [g/10]
/// in columns of seven letters, five pairs a line, and makes it even. Leaves `index` behind the last pair. Throws ReadError as
/// read_timed_samples(), also when length or peak are not those of the text header.
ResampledSeries read_volume1_pairs(const TextFile& file, std::size_t& index);

}  // namespace musim::records::detail
