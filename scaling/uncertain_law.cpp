#include "scaling/uncertain_law.hpp"

#include <fmt/format.h>

#include <cmath>
#include <span>

#include "scaling/detail/law_rows.hpp"
#include "scaling/detail/portable_math.hpp"

namespace musim::scaling {

namespace {

using detail::LawInputs;
using detail::LawRows;
using detail::Powers;
using detail::Row;
using detail::Term;
using Place = std::optional<std::size_t>;

/// What the law holds must follow from something that is solved, or be certain.
void check_held(const SolvedLaw& solved, const LawInputs& inputs) {
    for (std::size_t i = 0; i < solved.problem.held.size(); ++i) {
        const std::vector<Rational>& exponents = solved.solution.held[i].exponents;
        for (std::size_t j = 0; j < exponents.size(); ++j) {
            if (exponents[j] == 0 || !inputs.is_uncertain(j)) continue;
            const ScaleProduct& product = solved.problem.held[i];
            throw SimilitudeError(fmt::format(
                "law {}: the factor of {} is uncertain, where {} {} (no other factor is left to keep it); take its value alone{}",
                solved.law.name, solved.problem.quantities[j].name, product.text, product.is_definition ? "is 1 by definition" : "is held",
                product.is_definition ? ", or release another factor in it" : fmt::format(", or watch {} instead", product.text)));
        }
    }
}

/// Where the rows of a report stand.
struct Places {
    struct Pair {
        std::size_t quantity, prototype, model;
    };
    struct Addition {
        Place factor, model;
    };
    std::vector<Place> factors, held, watched, shaken;
    std::vector<Pair> values;
    std::vector<Addition> additions;
};

void add_products(Places& places, LawRows& rows, const SolvedLaw& solved) {
    const ScaleProblem& problem = solved.problem;
    const ScaleSolution& solution = solved.solution;
    for (std::size_t j = 0; j < problem.quantities.size(); ++j) {
        places.factors.push_back(rows.add_factor(problem.quantities[j].name, solution.quantities[j].factor));
    }
    for (std::size_t i = 0; i < problem.held.size(); ++i) {
        places.held.push_back(rows.add_factor(problem.held[i].text, solution.held[i]));
        if (!problem.held[i].is_definition) places.shaken.push_back(rows.add_shaken(problem.held[i], solution.held[i]));
    }
    for (std::size_t i = 0; i < problem.watched.size(); ++i) {
        places.watched.push_back(rows.add_factor(problem.watched[i].text, solution.watched[i]));
        places.shaken.push_back(rows.add_shaken(problem.watched[i], solution.watched[i]));
    }
}

void add_values(Places& places, LawRows& rows, const SolvedLaw& solved, const LawInputs& inputs) {
    for (std::size_t j = 0; j < solved.problem.quantities.size(); ++j) {
        const PiQuantity& quantity = solved.problem.quantities[j];
        const ScaleFactor& factor = solved.solution.quantities[j].factor;
        if (!quantity.value || !factor.value) continue;
        const std::size_t of_prototype = rows.add({quantity.name, rows.times_value({1.0, Powers(inputs.all().size())}, j), {}});
        places.values.push_back({j, of_prototype, rows.add({quantity.name, rows.times_value(rows.make_term(factor), j), {}})});
    }
}

void add_additions(Places& places, LawRows& rows, const SolvedLaw& solved) {
    const std::vector<PiQuantity>& quantities = solved.problem.quantities;
    const auto find_term = [&](const std::string& name) {
        return rows.make_term(solved.solution.quantities[find_quantity(quantities, name)].factor);
    };
    for (const LawAddition& addition : solved.law.additions) {
        Places::Addition& place = places.additions.emplace_back();
        if (!solved.added(addition)) continue;
        const Term total = find_term(addition.total), own = find_term(addition.own);
        place.factor = rows.add({addition.name, total, own});
        const auto base = solved.find_base(addition);
        if (base) place.model = rows.add({addition.name, rows.times_value(total, *base), rows.times_value(own, *base)});
    }
}

/// Rows with what the samples say of each.
struct Propagated {
    const std::vector<Row>& rows;
    const std::vector<UncertainInput>& inputs;
    std::vector<std::optional<SampleSummary>> samples;

    UncertainResult result(std::size_t i) const {
        return {rows[i].name, make_first_order(rows[i].plus.value, rows[i].plus.powers, inputs), samples[i]};
    }
    std::optional<UncertainResult> result(const std::optional<std::size_t>& i) const {
        return i ? std::optional(result(*i)) : std::nullopt;
    }
    /// u² = Σ (Σ ± value power_i)² (u_i/x_i)² over the terms.
    UncertainDifference difference(std::size_t i) const {
        const auto& [name, plus, minus] = rows[i];
        UncertainDifference difference{plus.value - minus->value, 0.0, samples[i]};
        for (std::size_t k = 0; k < inputs.size(); ++k) {
            const double slope = plus.value * plus.powers[k] - minus->value * minus->powers[k];
            difference.uncertainty = std::hypot(difference.uncertainty, slope * inputs[k].quantity.relative());
        }
        return difference;
    }
};

/// What samples of the inputs make of the rows.
MonteCarloRun draw(const std::vector<Row>& rows, const std::vector<UncertainInput>& inputs, const MonteCarloSettings& settings) {
    const Evaluation evaluate = [&](std::span<const double> drawn) {
        std::vector<double> logs;
        for (std::size_t i = 0; i < drawn.size(); ++i) logs.push_back(detail::portable_log(drawn[i] / inputs[i].quantity.value));
        std::vector<double> values;
        values.reserve(rows.size());
        for (const Row& row : rows) values.push_back(row.sample(logs));
        return values;
    };
    return run_monte_carlo(inputs, evaluate, settings);
}

/// The rows as a report.
void fill(UncertainLawReport& report, const Places& places, const Propagated& propagated, const SolvedLaw& solved) {
    for (const Place& place : places.factors) report.factors.push_back(propagated.result(place));
    for (const Place& place : places.held) report.held.push_back(propagated.result(place));
    for (const Place& place : places.watched) report.watched.push_back(propagated.result(place));
    for (const Place& place : places.shaken) {
        if (place) report.shaken.push_back(propagated.result(*place));
    }
    for (const Places::Pair& pair : places.values) {
        const PiQuantity& quantity = solved.problem.quantities[pair.quantity];
        report.values.push_back({quantity.name, quantity.dimension, propagated.result(pair.prototype), propagated.result(pair.model)});
    }
    for (const Places::Addition& place : places.additions) {
        std::optional<UncertainAddition>& addition = report.additions.emplace_back();
        if (!place.factor) continue;
        addition = UncertainAddition{propagated.difference(*place.factor), {}};
        if (place.model) addition->model = propagated.difference(*place.model);
    }
}

}  // namespace

UncertainLawReport propagate(const SolvedLaw& solved, const std::vector<UncertainFactor>& given,
                             const std::vector<UncertainPrototype>& prototype, const std::optional<MonteCarloSettings>& monte_carlo) {
    const LawInputs inputs(solved, given, prototype);
    check_held(solved, inputs);
    LawRows rows(solved, inputs);
    Places places;
    add_products(places, rows, solved);
    add_values(places, rows, solved, inputs);
    add_additions(places, rows, solved);

    UncertainLawReport report;
    report.inputs = inputs.all();
    Propagated propagated{rows.all(), inputs.all(), std::vector<std::optional<SampleSummary>>(rows.all().size())};
    if (monte_carlo) {
        const MonteCarloRun run = draw(rows.all(), inputs.all(), *monte_carlo);
        propagated.samples.assign(run.results.begin(), run.results.end());
        report.rejected = run.rejected;
    }
    fill(report, places, propagated, solved);
    return report;
}

}  // namespace musim::scaling
