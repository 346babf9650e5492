#pragma once

#include <optional>
#include <span>
#include <string>

#include "records/time_series.hpp"

namespace musim::records {

/// Largest distance of a printed time from its even place [time steps]. Files print times to a few digits: 1e-5 s of 0.02 s was met.
inline constexpr double kTimeJitter = 0.02;

/// An even series made of timed samples, and how: "resampled from 12080 uneven samples (0.003 to 0.006 s) to 0.005 s by straight lines".
struct ResampledSeries {
    TimeSeries series;
    std::string note = {};  ///< a line for GroundMotion::history; empty when the times were even and nothing was done
};

/// First time that is not after the one before it; nothing when all rise strictly.
std::optional<std::size_t> find_time_out_of_order(std::span<const double> times);

/// Puts samples [SI of `quantity`] at strictly rising `times` [s] on an even clock from the first time on, by straight lines between them.
///
/// The step is the median of those between the times, as the short decimal it means (0.00499999999999 is 0.005); the last even sample is
/// the last that the times reach. Straight lines lower what oscillates near the step: a sine of ten steps a period loses up to 5 % of a
/// peak. Times that are even to kTimeJitter keep their samples as they are. Throws ReadError, without a file's name, when there are fewer
/// than two samples, not as many times as samples, a time not after the one before it, a value not finite, or gaps that would make more
/// than four even samples for each one given.
ResampledSeries resample_uneven(SampleQuantity quantity, std::span<const double> times, std::span<const double> samples);

}  // namespace musim::records
