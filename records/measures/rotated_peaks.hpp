#pragma once

#include <span>

#include "records/time_series.hpp"

namespace musim::records {

/// Largest absolute value of a horizontal motion along one direction, over all directions.
struct RotatedPeaks {
    double least = 0.0;       ///< RotD00, in the unit of the samples
    double median = 0.0;      ///< RotD50
    double largest = 0.0;     ///< RotD100
    double largest_at = 0.0;  ///< direction of RotD100, from the first component towards the second [deg], 0 to 179
};

/// Peaks of x·cos θ + y·sin θ over the samples for θ = 0, 1, ... 179 degrees [Boore10]: the least, the median (mean of the two in the
/// middle) and the largest. Throws ProcessingError unless both have as many samples, at least one.
RotatedPeaks find_rotated_peaks(std::span<const double> x, std::span<const double> y);

/// RotD of PSA [m/s²], one per period: of two horizontal components on one clock, with the peaks between the samples as
/// compute_response_spectrum finds them. Throws ProcessingError when they are not on one clock,
/// or as compute_response_spectrum does.
std::vector<RotatedPeaks> compute_rotated_spectrum(const TimeSeries& first, const TimeSeries& second,
                                                   std::span<const scaling::Time> periods, double damping = 0.05);

}  // namespace musim::records
