#pragma once

#include "records/time_series.hpp"

namespace musim::records {

/// Interpolation between samples.
enum class Between {
    band_limited,  ///< what a motion without frequencies above half the sampling rate is there
    straight       ///< straight lines: what simulations take accelerations and velocities for
};

/// The series on another step, from the same start to no later than its end.
///
/// Band-limited: samples times sin(2πf_c τ)/(πτ) under a Kaiser window (β = 10) of 64 zeros to each side [OppenheimSchafer10]. With a
/// shorter step f_c is half the old rate, and old samples that fall on new ones stay; with a longer one 0.95 of half the new rate: flat to
/// 1e-4 up to 0.9 of it, and below 1e-4 above it, so that nothing folds back. Beyond its ends the record counts as zero: pad or taper it.
/// Straight lines fold what lies above half the new rate. Depends on the ratio of the steps only. Throws ProcessingError for a step that is
/// not positive and finite, or so small that more than 10^8 samples would come of it.
TimeSeries resample(const TimeSeries& series, scaling::Time dt, Between between = Between::band_limited);

/// The series seen `later` (less than one step, either way) after its samples: same step, start moved by as much, one sample fewer.
TimeSeries shift_clock(const TimeSeries& series, scaling::Time later, Between between = Between::band_limited);

}  // namespace musim::records
