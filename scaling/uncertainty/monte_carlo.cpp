#include "scaling/uncertainty/monte_carlo.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include "scaling/random_bits.hpp"
#include "scaling/side_by_side.hpp"

namespace musim::scaling {

namespace {

/// Samples that a thread takes at a time: enough that taking them costs nothing. Does not change results.
constexpr std::size_t kSamplesAtATime = 1024;

void check(const std::vector<UncertainInput>& inputs, const MonteCarloSettings& settings) {
    if (std::none_of(inputs.begin(), inputs.end(), [](const UncertainInput& input) { return input.quantity.is_uncertain(); })) {
        throw SimilitudeError("Monte Carlo: nothing is uncertain (no input has an uncertainty); write one, such as 0.63+/-0.03");
    }
    if (settings.samples < kFewestSamples || settings.samples > kMostSamples) {
        throw SimilitudeError(fmt::format("Monte Carlo: {} samples (must be from {} to {}); choose a number such as 100000",
                                          settings.samples, kFewestSamples, kMostSamples));
    }
}

/// Quantile p of sorted samples, linear between neighbors.
double find_sample_quantile(const std::vector<double>& sorted, double p) {
    const double rank = p * static_cast<double>(sorted.size() - 1);
    const auto below = static_cast<std::size_t>(rank);
    const std::size_t above = std::min(below + 1, sorted.size() - 1);
    return sorted[below] + (rank - static_cast<double>(below)) * (sorted[above] - sorted[below]);
}

SampleSummary summarize(std::vector<double>& samples) {
    samples.erase(std::remove_if(samples.begin(), samples.end(), [](double sample) { return std::isnan(sample); }), samples.end());
    constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
    if (samples.empty()) return {0, kNone, kNone, kNone, kNone, kNone, kNone};
    std::sort(samples.begin(), samples.end());
    const auto count = static_cast<double>(samples.size());
    SampleSummary summary{.given = samples.size()};
    for (const double sample : samples) summary.mean += sample / count;
    double squares = 0.0;
    for (const double sample : samples) squares += (sample - summary.mean) * (sample - summary.mean);
    summary.standard_deviation = std::sqrt(squares / (count - 1.0));
    summary.median = find_sample_quantile(samples, 0.5);
    summary.lower = find_sample_quantile(samples, 0.5 * (1.0 - kCoverage));
    summary.upper = find_sample_quantile(samples, 0.5 * (1.0 + kCoverage));
    summary.share_above_one = static_cast<double>(samples.end() - std::upper_bound(samples.begin(), samples.end(), 1.0)) / count;
    return summary;
}

}  // namespace

double find_share(const SampleSummary& samples) {
    const auto count = static_cast<double>(samples.given);
    return std::round(samples.mean * count) / count;
}

MonteCarloRun run_monte_carlo(const std::vector<UncertainInput>& inputs, const Evaluation& evaluate, const MonteCarloSettings& settings,
                              const std::function<void(double)>& on_progress) {
    check(inputs, settings);
    std::vector<double> values;
    values.reserve(inputs.size());
    for (const UncertainInput& input : inputs) values.push_back(input.quantity.value);
    std::vector<std::vector<double>> samples(evaluate(values).size(), std::vector<double>(settings.samples));

    // draw and evaluate
    const std::size_t turns = (settings.samples + kSamplesAtATime - 1) / kSamplesAtATime;
    std::vector<std::size_t> rejected(turns, 0);
    const auto take_turn = [&](std::size_t turn) {
        std::vector<double> drawn(inputs.size());
        const std::size_t end = std::min(settings.samples, (turn + 1) * kSamplesAtATime);
        for (std::size_t s = turn * kSamplesAtATime; s < end; ++s) {
            for (std::size_t i = 0; i < inputs.size(); ++i) {
                const std::uint64_t sequence = random_bits(settings.seed, i);
                for (std::uint64_t index = s;; index += settings.samples) {
                    drawn[i] = find_quantile(settings.distribution, inputs[i].quantity, to_probability(random_bits(sequence, index)));
                    if (drawn[i] > 0.0) break;
                    ++rejected[turn];
                }
            }
            const std::vector<double> results = evaluate(drawn);
            for (std::size_t r = 0; r < results.size(); ++r) samples[r][s] = results[r];
        }
    };
    std::vector<std::function<void()>> jobs;
    for (std::size_t turn = 0; turn < turns; ++turn) jobs.emplace_back([&take_turn, turn] { take_turn(turn); });
    run_side_by_side(jobs, settings.threads, on_progress);

    // sum up
    MonteCarloRun run{{}, {settings, 0}};
    run.results.resize(samples.size());
    jobs.clear();
    for (std::size_t r = 0; r < samples.size(); ++r) jobs.emplace_back([&run, &samples, r] { run.results[r] = summarize(samples[r]); });
    run_side_by_side(jobs, settings.threads);
    for (const std::size_t count : rejected) run.draws.rejected += count;
    return run;
}

}  // namespace musim::scaling
