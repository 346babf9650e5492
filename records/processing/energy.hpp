#pragma once

#include <vector>

#include "records/time_series.hpp"

namespace musim::records::detail {

/// ∫ x² dt from the first sample, by the trapezoid rule.
std::vector<double> cumulative_square(const TimeSeries& series);

/// Time at which a cumulative sum reaches `share` of its last value, linear between samples; the last value must be positive.
scaling::Time time_of_share(const TimeSeries& series, const std::vector<double>& cumulative, double share);

}  // namespace musim::records::detail
