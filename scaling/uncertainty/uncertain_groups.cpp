#include "scaling/uncertainty/uncertain_groups.hpp"

#include <limits>
#include <span>
#include <utility>

namespace musim::scaling {

namespace {

bool is_uncertain(const PiQuantity& quantity) { return quantity.value && quantity.uncertainty > 0.0; }

}  // namespace

std::vector<UncertainInput> list_uncertain(const std::vector<PiQuantity>& quantities) {
    std::vector<UncertainInput> inputs;
    for (const PiQuantity& quantity : quantities) {
        if (is_uncertain(quantity)) inputs.push_back({quantity.name, {*quantity.value, quantity.uncertainty}, quantity.dimension});
    }
    return inputs;
}

std::optional<FirstOrder> find_uncertain_value(const PiGroup& group, const std::vector<PiQuantity>& quantities) {
    const std::optional<double> value = group_value(group, quantities);
    if (!value) return std::nullopt;
    std::vector<double> exponents;
    for (std::size_t i = 0; i < quantities.size(); ++i) {
        if (is_uncertain(quantities[i])) exponents.push_back(static_cast<double>(group[i]));
    }
    return make_first_order(*value, std::move(exponents), list_uncertain(quantities));
}

SampledGroups draw_groups(const std::vector<PiGroup>& groups, const std::vector<PiQuantity>& quantities, const MonteCarloSettings& settings,
                          const std::function<void(double)>& on_progress) {
    SampledGroups sampled;
    for (const PiGroup& group : groups) {
        if (group_value(group, quantities)) sampled.groups.emplace(group, SampleSummary{});
    }
    const Evaluation evaluate = [&](std::span<const double> drawn) {
        std::vector<PiQuantity> values = quantities;
        auto next = drawn.begin();
        for (PiQuantity& quantity : values) {
            if (is_uncertain(quantity)) quantity.value = *next++;
        }
        std::vector<double> results;
        for (const auto& entry : sampled.groups) {
            results.push_back(group_value(entry.first, values).value_or(std::numeric_limits<double>::quiet_NaN()));
        }
        return results;
    };
    const MonteCarloRun run = run_monte_carlo(list_uncertain(quantities), evaluate, settings, on_progress);
    auto next = run.results.begin();
    for (auto& entry : sampled.groups) entry.second = *next++;
    sampled.draws = run.draws;
    return sampled;
}

}  // namespace musim::scaling
