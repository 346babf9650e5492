#include "lsdem/study/two_samples.hpp"

#include <algorithm>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>
#include <limits>

#include "lsdem/study/sample_moments.hpp"

namespace musim::lsdem {
namespace {

/// Probability, on both sides, of Welch's t = (mean₁ − mean₂)/√(s₁²/n₁ + s₂²/n₂), with as many degrees of freedom as Welch and
/// Satterthwaite give it.
double find_probability(const SampleMoments& first, const SampleMoments& second) {
    if (first.count() < 2 || second.count() < 2) return std::numeric_limits<double>::quiet_NaN();
    const auto squared_error = [](const SampleMoments& moments) { return moments.sd()[0] * moments.sd()[0] / moments.count(); };
    const double one = squared_error(first), two = squared_error(second), both = one + two;
    const double difference = std::abs(first.mean()[0] - second.mean()[0]);
    if (!(both > 0.0)) return difference > 0.0 ? 0.0 : 1.0;
    const double freedom = both * both / (one * one / (first.count() - 1) + two * two / (second.count() - 1));
    const boost::math::students_t_distribution<double> distribution(freedom);
    return 2.0 * boost::math::cdf(boost::math::complement(distribution, difference / std::sqrt(both)));
}

std::vector<double> distances_from_median(std::vector<double> sample) {
    if (sample.empty()) return sample;
    std::sort(sample.begin(), sample.end());
    const std::size_t middle = sample.size() / 2;
    const double median = sample.size() % 2 == 1 ? sample[middle] : 0.5 * (sample[middle - 1] + sample[middle]);
    for (double& value : sample) value = std::abs(value - median);
    return sample;
}

}  // namespace

TwoSamples compare_samples(const std::vector<double>& first, const std::vector<double>& second) {
    const SampleMoments one = moments_of(first), two = moments_of(second);
    return {.first_count = first.size(),
            .second_count = second.size(),
            .first_mean = one.mean()[0],
            .first_sd = one.sd()[0],
            .second_mean = two.mean()[0],
            .second_sd = two.sd()[0],
            .mean_probability = find_probability(one, two),
            .scatter_probability = find_probability(moments_of(distances_from_median(first)), moments_of(distances_from_median(second)))};
}

}  // namespace musim::lsdem
