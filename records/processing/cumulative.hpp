#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "records/time_series.hpp"

namespace musim::records::detail {

/// Cumulative trapezoid sums y_i = y_{i-1} + dt (x_{i-1} + x_i)/2 from y_0 = 0.
std::vector<double> cumulative_trapezoid(std::span<const double> x, double dt);

/// Acceleration samples e whose trapezoid integrals end at the given velocity and displacement: subtracting them from a motion that ends
/// there brings it to rest. e = α τ(1 − τ) + β τ(1 − τ)(1 − 2τ) with τ from 0 to 1 over the record: zero at both ends, no sharper than the
/// record is long. `size` is at least 4 (below, the two shapes are not independent).
std::vector<double> rest_correction(std::size_t size, double dt, double velocity_end, double displacement_end);

/// An acceleration less the rest_correction() that lets its trapezoid integrals end with zero velocity at this displacement.
std::vector<double> end_at_rest(std::vector<double> acceleration, double dt, double displacement = 0.0);

/// ∫ x² dt from the first sample, by the trapezoid rule.
std::vector<double> cumulative_square(const TimeSeries& series);

/// Time at which a cumulative sum reaches `share` of its last value, linear between samples; the last value must be positive.
scaling::Time time_of_share(const TimeSeries& series, const std::vector<double>& cumulative, double share);

}  // namespace musim::records::detail
