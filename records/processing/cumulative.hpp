#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "records/time_series.hpp"

namespace musim::records::detail {

/// Cumulative trapezoid sums y_i = y_{i-1} + dt (x_{i-1} + x_i)/2 from y_0 = 0.
std::vector<double> cumulative_trapezoid(std::span<const double> x, double dt);

/// Weight w of the two shapes of a correction to rest over τ from 0 to 1.
enum class RestShape {
    faded,  ///< τ(1 − τ): zero at both ends
    open    ///< 1: the least ∫e² dt that ends there
};

/// Acceleration samples e whose trapezoid integrals end at the given velocity and, if one is given, displacement: subtracting them from a
/// motion that ends there brings it to rest. e = w (α + β (1 − 2τ)), no sharper than the record is long; β = 0 without a displacement.
/// `size` is at least 4 (below, the two shapes are not independent).
std::vector<double> rest_correction(std::size_t size, double dt, double velocity_end, std::optional<double> displacement_end,
                                    RestShape shape = RestShape::faded);

/// An acceleration less the rest_correction() that lets its trapezoid integrals end with zero velocity at this displacement; at any
/// without one.
std::vector<double> end_at_rest(std::vector<double> acceleration, double dt, std::optional<double> displacement = 0.0);

/// ∫ x² dt from the first sample, by the trapezoid rule.
std::vector<double> cumulative_square(const TimeSeries& series);

/// Time at which a cumulative sum reaches `share` of its last value, linear between samples; the last value must be positive.
scaling::Time time_of_share(const TimeSeries& series, const std::vector<double>& cumulative, double share);

}  // namespace musim::records::detail
