#pragma once

#include "records/formats/resample_uneven.hpp"
#include "records/headers/text_file.hpp"

namespace musim::records::detail {

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
