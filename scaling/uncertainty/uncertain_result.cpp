#include "scaling/uncertainty/uncertain_result.hpp"

#include <utility>

namespace musim::scaling {

std::vector<GivenFactor> values_of(const std::vector<UncertainFactor>& factors) {
    std::vector<GivenFactor> values;
    values.reserve(factors.size());
    for (const auto& [name, factor] : factors) values.push_back({name, factor.value()});
    return values;
}

ResultsInOrder::ResultsInOrder(const std::vector<UncertainInput>& inputs, const Evaluation& evaluate,
                               const std::optional<MonteCarloSettings>& samples)
    : results_(propagate_first_order(inputs, evaluate)) {
    if (!samples) return;
    MonteCarloRun run = run_monte_carlo(inputs, evaluate, *samples);
    samples_ = std::move(run.results);
    draws_ = run.draws;
}

UncertainResult ResultsInOrder::take(const std::string& name) {
    UncertainResult result{name, std::move(results_[next_]), {}};
    if (draws_) result.samples = samples_[next_];
    ++next_;
    return result;
}

}  // namespace musim::scaling
