#pragma once

#include <string_view>

#include "scaling/uncertain.hpp"

namespace musim::scaling {

/// z with Φ(z) = p, the quantile of the standard normal distribution, for 0 < p < 1: rational functions, 1e-15 relative [Wichura88]. The
/// same bits on every machine with IEEE doubles.
double normal_quantile(double p);

/// Distribution of an uncertain value; each with the value as its mean and the standard uncertainty as its standard deviation [JCGM101]
/// 6.4.
enum class Distribution {
    normal,     ///< values known from repeated measurement; draws at or below zero are refused
    lognormal,  ///< always positive; σ² = ln(1 + u²/x²), median x/√(1 + u²/x²)
    uniform,    ///< only bounds x ± √3 u are known
};

/// The distribution called `name` ("normal", "lognormal" or "uniform"); throws SimilitudeError, which lists them, for any other.
Distribution parse_distribution(std::string_view name);

/// Name of a distribution, as parse_distribution() reads it.
std::string_view to_string(Distribution distribution);

/// The value below which `quantity` lies with probability p, 0 < p < 1. The same bits on every machine with IEEE doubles.
double find_quantile(Distribution distribution, const Uncertain& quantity, double p);

}  // namespace musim::scaling
