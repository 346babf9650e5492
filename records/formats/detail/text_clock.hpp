#pragma once

#include "records/formats/detail/text_layout.hpp"

namespace musim::records::detail {

/// Clock of a text record's samples.
struct TextClock {
    double start = 0.0;  ///< [s]
    double dt = 0.0;     ///< [s]
    std::optional<UtcTime> zero = {};
};

/// Clock by the column of times, else by what the header states, else by the caller. Times without a unit are seconds where their step is
/// one that records have (kShortestStep to kLongestStep), else in the unit that gives the caller's step. Throws ReadError for uneven times,
/// an unknown step, and a caller's step that the file contradicts.
TextClock find_text_clock(const TextFile& file, const TextTable& table, const TextHeading& heading, const TextLayout& layout,
                          const ReadOptions& options);

}  // namespace musim::records::detail
