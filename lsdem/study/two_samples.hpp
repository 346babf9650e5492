#pragma once

#include <cstddef>
#include <vector>

namespace musim::lsdem {

/// Two samples of one quantity beside each other, in its unit. Standard deviations are those of the populations, √(Σ (x − mean)²/(n − 1)).
struct TwoSamples {
    std::size_t first_count = 0, second_count = 0;
    double first_mean = 0.0, first_sd = 0.0;
    double second_mean = 0.0, second_sd = 0.0;
    /// With what probability two samples of one population differ in their means by as much or more [-]: Welch's t, which does not ask for
    /// equal scatter [Welch47].
    double mean_probability = 0.0;
    /// The same of their scatter: Welch's t of the distances from the own median, which is robust where the quantity is not normally
    /// distributed [BrownForsythe74].
    double scatter_probability = 0.0;
};

/// Compares two samples. Means and deviations of too few members, and probabilities then, are NaN; of two samples without any scatter the
/// probability is 1 when they are the same, else 0.
TwoSamples compare_samples(const std::vector<double>& first, const std::vector<double>& second);

}  // namespace musim::lsdem
