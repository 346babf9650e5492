#pragma once

#include <optional>
#include <vector>

#include "records/processing/biquad.hpp"
#include "records/time_series.hpp"

namespace musim::records {

/// Passes of a Butterworth filter.
enum class FilterPhase {
    zero,   ///< forward and backward: no phase shift, amplitudes of one run squared
    causal  ///< forward only: nothing moves before its cause, later arrivals are delayed
};

/// Frequencies that a filter lets pass: above `low`, below `high`, or between them.
struct FilterBand {
    std::optional<scaling::Frequency> low = {};   ///< corner of the high-pass
    std::optional<scaling::Frequency> high = {};  ///< corner of the low-pass
};

/// Butterworth filter of order n at each corner; amplitudes, for one run, times
///
///   high-pass  |H|² = 1/(1 + (K_c/K)^(2n)),   low-pass  |H|² = 1/(1 + (K/K_c)^(2n)),   K = tan(π f dt),
///
/// 1/2 at the corner; a band-pass is the one after the other. Second-order sections by the bilinear transform with the corner prewarped.
/// Zeros are put before and after the record for as long as the filter remembers (to 1e-6), as [Boore05] advises, and taken off again: a
/// record that is at rest at zero level at its ends, or tapered, keeps clean ends. Level it first (remove_initial_level, remove_baseline);
/// an offset would ring like a step. Depends on f·dt only. Throws ProcessingError unless there is a corner, order is 1 to 8,
/// 0 < f dt < 1/2 for each, low < high, and the filter remembers no more than 10^8 steps.
TimeSeries apply_butterworth(const TimeSeries& series, const FilterBand& band, int order, FilterPhase phase = FilterPhase::zero);

/// Highest order of a Butterworth filter.
inline constexpr int kHighestFilterOrder = 8;

/// Sections of the low-pass above, one after another, for whoever filters sample by sample. `corner_steps`: f_c dt, between 0 and 1/2.
std::vector<detail::Biquad> make_low_pass(double corner_steps, int order);

/// Delay of slow signals by that low-pass, in steps: 1/(2 tan(π f_c dt) sin(π/(2n))).
double find_low_pass_delay(double corner_steps, int order);

}  // namespace musim::records
