#pragma once

#include <algorithm>
#include <cmath>
#include <random>
#include <span>
#include <utility>
#include <vector>

#include "records/time_series.hpp"

namespace musim::records {

inline TimeSeries make_series(std::vector<double> samples, double dt = 0.01, SampleQuantity quantity = SampleQuantity::acceleration) {
    return {quantity, 0.0 * scaling::si::seconds, dt * scaling::si::seconds, std::move(samples)};
}

/// Samples between -0.5 and 0.5, the same for a seed everywhere.
inline std::vector<double> random_samples(std::size_t size, unsigned seed) {
    std::mt19937 random(seed);
    std::vector<double> samples(size);
    for (double& sample : samples) sample = static_cast<double>(random()) / 4294967296.0 - 0.5;
    return samples;
}

inline double largest(std::span<const double> samples) {
    double value = 0.0;
    for (const double sample : samples) value = std::max(value, std::abs(sample));
    return value;
}

}  // namespace musim::records
