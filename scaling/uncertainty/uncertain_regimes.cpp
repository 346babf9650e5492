#include "scaling/uncertainty/uncertain_regimes.hpp"

#include <fmt/format.h>

#include <iterator>

#include "scaling/structures/regime_borders.hpp"
#include "scaling/uncertainty/propagate.hpp"

namespace musim::scaling {
namespace {

using detail::RegimeMargin;

/// Factors and groups that follow from properties, in one row.
std::vector<double> list_numbers(const std::vector<NamedFactor>& factors, const std::vector<GroupComparison>& groups) {
    std::vector<double> numbers;
    numbers.reserve(factors.size());
    for (const NamedFactor& factor : factors) numbers.push_back(factor.value);
    for (const GroupComparison& group : groups) numbers.insert(numbers.end(), {group.prototype, group.model, group.factor()});
    return numbers;
}

/// The same and margins.
std::vector<double> list_numbers(const std::vector<NamedFactor>& factors, const std::vector<GroupComparison>& groups,
                                 const std::vector<RegimeMargin>& margins) {
    std::vector<double> numbers = list_numbers(factors, groups);
    for (const RegimeMargin& margin : margins) numbers.push_back(margin.ratio);
    return numbers;
}

bool belongs(const RegimeMargin& margin, const RegimeStatement& regime) {
    return margin.topic == regime.topic && margin.direction == regime.direction;
}

/// Where properties lie against a border.
enum class Side { of_no_matter, below, above };

/// Against all borders of a regime.
std::vector<Side> find_sides(const RegimeStatement& regime, const std::vector<RegimeMargin>& margins) {
    std::vector<Side> sides;
    for (const RegimeMargin& margin : margins) {
        if (!belongs(margin, regime)) continue;
        sides.push_back(!margin.matters ? Side::of_no_matter : margin.ratio > 1.0 ? Side::above : Side::below);
    }
    return sides;
}

/// Words of a margin about a regime whose border lies within its interval; empty where it does not.
std::string describe_uncertainty(const RegimeMargin& margin, const FirstOrder& ratio) {
    const CoverageInterval interval = find_interval(ratio);
    if (!margin.matters || ratio.relative == 0.0 || !interval.contains(1.0)) return "";
    return fmt::format("; not sure: {} is {:.4g} times its limit ({:g} %: {:.4g} to {:.4g})", margin.what, ratio.value, 100.0 * kCoverage,
                       interval.lower, interval.upper);
}

void add_uncertainty(std::vector<RegimeStatement>& regimes, const RegimeMargin& margin, const std::string& warning) {
    if (warning.empty()) return;
    for (RegimeStatement& regime : regimes) {
        if (!belongs(margin, regime)) continue;
        regime.statement += warning;
        regime.is_open = true;
        if (!regime.severity) regime.severity = Severity::warning;
    }
}

}  // namespace

UncertainRegimes propagate(RegimeReport& report, const PropertiesAndLaw& properties, const KeptNumbers& kept,
                           const std::vector<UncertainInput>& inputs, const std::vector<MovedProperties>& moved) {
    // λ_l of the groups is the one that was chosen, whatever the properties
    const auto evaluate = [&](const PropertiesAndLaw& each) {
        const std::vector<GroupComparison> groups = make_regime_report(each.properties, properties.similitude, kept).groups;
        return list_numbers(each.similitude.factors(), groups, detail::find_regime_margins(each.properties, groups));
    };
    const std::vector<RegimeMargin> margins = detail::find_regime_margins(properties.properties, report.groups);
    std::vector<MovedResults> results;
    results.reserve(moved.size());
    for (const MovedProperties& each : moved) results.push_back({evaluate(each.below), evaluate(each.above)});
    const std::vector<FirstOrder> numbers =
        find_first_order(list_numbers(properties.similitude.factors(), report.groups, margins), inputs, results);

    UncertainRegimes uncertain{.inputs = inputs, .factors = {}, .groups = {}, .samples = {}};
    auto next = numbers.begin();
    for (const NamedFactor& factor : properties.similitude.factors()) uncertain.factors.push_back({std::string(factor.name), *next++, {}});
    for (std::size_t i = 0; i < report.groups.size(); ++i, std::advance(next, 3)) {
        uncertain.groups.push_back({*next, *std::next(next), *std::next(next, 2)});
    }
    for (const RegimeMargin& margin : margins) add_uncertainty(report.regimes, margin, describe_uncertainty(margin, *next++));
    return uncertain;
}

void add_samples(UncertainRegimes& uncertain, const RegimeReport& report, const PropertiesAndLaw& properties, const KeptNumbers& kept,
                 const DrawProperties& draw, const MonteCarloSettings& settings, const std::function<void(double)>& on_progress) {
    const std::vector<RegimeMargin> own = detail::find_regime_margins(properties.properties, report.groups);
    std::vector<std::vector<Side>> own_sides;
    for (const RegimeStatement& regime : report.regimes) own_sides.push_back(find_sides(regime, own));
    const Evaluation evaluate = [&](std::span<const double> drawn) {
        const PropertiesAndLaw each = draw(drawn);
        const std::vector<GroupComparison> groups = make_regime_report(each.properties, properties.similitude, kept).groups;
        const std::vector<RegimeMargin> margins = detail::find_regime_margins(each.properties, groups);
        std::vector<double> numbers = list_numbers(each.similitude.factors(), groups);
        for (std::size_t i = 0; i < own_sides.size(); ++i) {
            numbers.push_back(find_sides(report.regimes[i], margins) == own_sides[i] ? 0.0 : 1.0);
        }
        return numbers;
    };
    const MonteCarloRun run = run_monte_carlo(uncertain.inputs, evaluate, settings, on_progress);

    auto next = run.results.begin();
    for (UncertainResult& factor : uncertain.factors) factor.samples = *next++;
    for (UncertainComparison& group : uncertain.groups) {
        group.samples = ComparisonSamples{*next, *std::next(next), *std::next(next, 2)};
        std::advance(next, 3);
    }
    uncertain.samples = RegimeSamples{{}, run.draws};
    for (; next != run.results.end(); ++next) uncertain.samples->shares_elsewhere.push_back(find_share(*next));
}

}  // namespace musim::scaling
