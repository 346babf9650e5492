#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "scaling/uncertainty/distribution.hpp"
#include "scaling/uncertainty/propagate.hpp"

namespace musim::scaling {

/// Settings of propagating distributions by drawing from them.
struct MonteCarloSettings {
    std::size_t samples = 100'000;
    std::uint64_t seed = 1;
    Distribution distribution = Distribution::normal;  ///< of every input
    int threads = 0;                                   ///< 0: all cores. Changes the speed, never the result
};

/// Fewest and most samples. Below the one, ends of a 95 % interval rest on a handful of samples; above the other, the samples of some fifty
/// results take more than half a gigabyte.
inline constexpr std::size_t kFewestSamples = 1'000;
inline constexpr std::size_t kMostSamples = 1'000'000;

/// Samples of one result. All numbers but `given` are none where no sample has it.
struct SampleSummary {
    std::size_t given = 0;  ///< samples that have the result; the rest follows from them alone
    double mean = 0.0;
    double standard_deviation = 0.0;
    double median = 0.0;
    double lower = 0.0, upper = 0.0;  ///< ends of the coverage interval
    double share_above_one = 0.0;     ///< samples above 1: the probability of another regime where 1 divides two
};

/// The share of samples in which a result that is either 0 or 1 is 1, without what rounding adds to its mean.
double find_share(const SampleSummary& samples);

/// Draws of the samples.
struct Draws {
    MonteCarloSettings settings;
    std::size_t rejected = 0;  ///< draws that were not positive, and drawn again
};

/// Samples of all results.
struct MonteCarloRun {
    std::vector<SampleSummary> results;
    Draws draws;
};

/// Propagates distributions [JCGM101]: draws every input, evaluates, and sums up each result: mean, standard deviation, median, and the
/// interval between the quantiles (1 ∓ kCoverage)/2, linear between neighbors in rank. Draw a of sample s of an input takes the random bits
/// a N + s of the input's own sequence, so that the result depends on seed and samples only: not on threads, nor on the machine. Draws that
/// are not positive (a normal distribution has some) are counted and drawn again. A result that a sample does not have is NaN.
/// `on_progress`, when given, is called with the fraction done, from any thread.
///
/// Throws SimilitudeError when nothing is uncertain or for a number of samples outside the bounds above, and what `evaluate` throws.
MonteCarloRun run_monte_carlo(const std::vector<UncertainInput>& inputs, const Evaluation& evaluate, const MonteCarloSettings& settings,
                              const std::function<void(double)>& on_progress = {});

}  // namespace musim::scaling
