#include "scaling/uncertain_regimes.hpp"

#include <fmt/format.h>

#include <iterator>

#include "scaling/coverage.hpp"
#include "scaling/detail/regime_margins.hpp"

namespace musim::scaling {
namespace {

using detail::RegimeMargin;

/// All numbers that follow from facts, in one row: factors, groups, margins.
std::vector<double> list_numbers(const std::vector<NamedFactor>& factors, const std::vector<GroupComparison>& groups,
                                 const std::vector<RegimeMargin>& margins) {
    std::vector<double> numbers;
    for (const NamedFactor& factor : factors) numbers.push_back(factor.value);
    for (const GroupComparison& group : groups) numbers.insert(numbers.end(), {group.prototype, group.model, group.factor()});
    for (const RegimeMargin& margin : margins) numbers.push_back(margin.ratio);
    return numbers;
}

/// What a margin says of a regime whose border lies within its interval; empty where it does not.
std::string describe_doubt(const RegimeMargin& margin, const FirstOrder& ratio) {
    const CoverageInterval interval = find_interval(ratio);
    if (!margin.matters || ratio.relative == 0.0 || !interval.contains(1.0)) return "";
    return fmt::format("; not sure: {} is {:.4g} times its limit ({:g} %: {:.4g} to {:.4g})", margin.what, ratio.value, 100.0 * kCoverage,
                       interval.lower, interval.upper);
}

void add_doubt(std::vector<RegimeStatement>& regimes, const RegimeMargin& margin, const std::string& doubt) {
    if (doubt.empty()) return;
    for (RegimeStatement& regime : regimes) {
        if (regime.topic != margin.topic || regime.direction != margin.direction) continue;
        regime.statement += doubt;
        regime.is_open = true;
        if (!regime.severity) regime.severity = Severity::warning;
    }
}

}  // namespace

UncertainRegimes propagate(RegimeReport& report, const FactsAndLaw& facts, const KeptNumbers& kept,
                           const std::vector<UncertainInput>& inputs, const std::vector<MovedFacts>& moved) {
    // λ_l of the groups is the one that was chosen, whatever the facts
    const auto evaluate = [&](const FactsAndLaw& each) {
        const std::vector<GroupComparison> groups = make_regime_report(each.facts, facts.similitude, kept).groups;
        return list_numbers(each.similitude.factors(), groups, detail::find_regime_margins(each.facts, groups));
    };
    const std::vector<RegimeMargin> margins = detail::find_regime_margins(facts.facts, report.groups);
    std::vector<MovedResults> results;
    for (const MovedFacts& each : moved) results.push_back({evaluate(each.below), evaluate(each.above)});
    const std::vector<FirstOrder> numbers =
        find_first_order(list_numbers(facts.similitude.factors(), report.groups, margins), inputs, results);

    UncertainRegimes uncertain{.inputs = inputs, .factors = {}, .groups = {}};
    auto next = numbers.begin();
    for (const NamedFactor& factor : facts.similitude.factors()) uncertain.factors.push_back({std::string(factor.name), *next++, {}});
    for (std::size_t i = 0; i < report.groups.size(); ++i, std::advance(next, 3)) {
        uncertain.groups.push_back({*next, *std::next(next), *std::next(next, 2)});
    }
    for (const RegimeMargin& margin : margins) add_doubt(report.regimes, margin, describe_doubt(margin, *next++));
    return uncertain;
}

}  // namespace musim::scaling
