#pragma once

#include "scaling/uncertainty/propagate.hpp"

namespace musim::scaling {

/// Probability of the coverage interval, as much of it on either side.
inline constexpr double kCoverage = 0.95;

/// From the lower to the upper end, both included.
struct CoverageInterval {
    double lower = 0.0, upper = 0.0;

    bool contains(double value) const { return lower <= value && value <= upper; }
};

/// The interval of a result to first order: value e^(∓ z u/value) with z the normal quantile of (1 + kCoverage)/2, 1.96 [JCGM100] G.1.3.
/// Symmetric in logarithms, in which a product of powers is linear: the interval of 1/y has the ends of that of y upside down, and never
/// reaches zero. For small u/value it is value ∓ z u.
CoverageInterval find_interval(const FirstOrder& result);

}  // namespace musim::scaling
