#include "scaling/uncertain_law.hpp"

#include <fmt/format.h>

#include <cmath>
#include <span>
#include <utility>

#include "scaling/detail/portable_math.hpp"
#include "scaling/distortion.hpp"

namespace musim::scaling {

namespace {

using Exponents = std::vector<Rational>;  ///< one per quantity
using Powers = std::vector<double>;       ///< one per input

double to_double(const Rational& number) { return static_cast<double>(number.numerator()) / static_cast<double>(number.denominator()); }

void add(Powers& sum, const Powers& powers, double times) {
    for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += times * powers[i];
}

/// Which inputs are in the factors that were given and in the prototype's values, and to which power.
class Inputs {
  public:
    Inputs(const SolvedLaw& solved, const std::vector<UncertainFactor>& given, const std::vector<UncertainPrototype>& prototype) {
        const std::vector<PiQuantity>& quantities = solved.problem.quantities;
        factors_.resize(quantities.size());
        values_.resize(quantities.size());
        for (const auto& [name, ratio] : given) {
            const std::size_t j = find_quantity(quantities, name);
            factors_[j].above = add_input(ratio.denominator ? name + "_model" : name, ratio.numerator, {});
            if (ratio.denominator) factors_[j].below = add_input(name + "_prototype", *ratio.denominator, {});
        }
        for (const auto& [name, value] : prototype) {
            const std::size_t j = find_quantity(quantities, name);
            const UncertainRatio* const ratio = find_ratio(given, name);
            if (ratio != nullptr && ratio->denominator) {
                require_same(quantities[j], value, *ratio->denominator);
                values_[j] = factors_[j].below;
            } else {
                values_[j] = add_input(name + "_prototype", value, quantities[j].dimension);
            }
        }
    }

    const std::vector<UncertainInput>& all() const { return inputs_; }

    /// Powers of the inputs in Π λ_j^exponent_j of chosen factors.
    Powers of_factors(const Exponents& exponents) const {
        Powers powers(inputs_.size());
        for (std::size_t j = 0; j < exponents.size(); ++j) {
            if (factors_[j].above) powers[*factors_[j].above] += to_double(exponents[j]);
            if (factors_[j].below) powers[*factors_[j].below] -= to_double(exponents[j]);
        }
        return powers;
    }

    /// Powers of the inputs in a quantity of the prototype.
    Powers of_value(std::size_t quantity) const {
        Powers powers(inputs_.size());
        if (values_[quantity]) powers[*values_[quantity]] = 1.0;
        return powers;
    }

    /// Whether a factor was given with an uncertainty.
    bool is_uncertain(std::size_t quantity) const { return factors_[quantity].above || factors_[quantity].below; }

  private:
    using Place = std::optional<std::size_t>;
    struct RatioPlaces {
        Place above, below;
    };

    static const UncertainRatio* find_ratio(const std::vector<UncertainFactor>& given, std::string_view name) {
        for (const UncertainFactor& factor : given) {
            if (factor.name == name) return &factor.factor;
        }
        return nullptr;
    }

    /// Both are the prototype's. The numbers of a fraction may be in any unit, those of a plain number are in none.
    static void require_same(const PiQuantity& quantity, const Uncertain& value, const Uncertain& below) {
        const bool same_value = !quantity.dimension.is_dimensionless() || std::abs(value.value / below.value - 1.0) <= kFactorRounding;
        const bool same_share = !value.is_uncertain() || std::abs(value.relative() / below.relative() - 1.0) <= kFactorRounding;
        if (same_value && same_share) return;
        throw SimilitudeError(fmt::format(
            "{} of the prototype is {:g} +/- {:.3g} %, and {:g} +/- {:.3g} % below the factor's fraction (both are the prototype's); leave "
            "one out",
            quantity.name, value.value, 100.0 * value.relative(), below.value, 100.0 * below.relative()));
    }

    Place add_input(const std::string& name, const Uncertain& quantity, const RationalDimension& dimension) {
        if (!quantity.is_uncertain()) return std::nullopt;
        inputs_.push_back({name, quantity, dimension});
        return inputs_.size() - 1;
    }

    std::vector<UncertainInput> inputs_;
    std::vector<RatioPlaces> factors_;
    std::vector<Place> values_;
};

/// value · Π (x_i/value of x_i)^power_i.
struct Term {
    double value = 0.0;
    Powers powers;

    double sample(const std::vector<double>& logs) const {
        double sum = 0.0;
        for (std::size_t i = 0; i < logs.size(); ++i) sum += powers[i] * logs[i];
        return value * detail::portable_exp(sum);
    }
};

/// A product, or a difference of two.
struct Row {
    std::string name;
    Term plus;
    std::optional<Term> minus;

    double sample(const std::vector<double>& logs) const { return plus.sample(logs) - (minus ? minus->sample(logs) : 0.0); }
};

/// Whether a quantity is made of length and time alone, and of time.
bool is_motion(const PiQuantity& quantity) {
    for (const BaseDimension base : kBaseDimensions) {
        const bool may_be = base == BaseDimension::length || base == BaseDimension::time;
        if (!may_be && quantity.dimension[base] != 0) return false;
    }
    return quantity.dimension[BaseDimension::time] != 0;
}

/// The rows of a law, in the order in which the report takes them back.
class Rows {
  public:
    Rows(const SolvedLaw& solved, const Inputs& inputs) : solved_(solved), inputs_(inputs) {}

    std::optional<std::size_t> add_factor(const std::string& name, const ScaleFactor& factor) {
        return factor.value ? std::optional(add({name, make_term(factor), {}})) : std::nullopt;
    }

    std::size_t add(Row row) {
        rows_.push_back(std::move(row));
        return rows_.size() - 1;
    }

    Term make_term(const ScaleFactor& factor) const { return {*factor.value, inputs_.of_factors(factor.exponents)}; }

    /// A factor times a value of the prototype.
    Term times_value(const Term& term, std::size_t quantity) const {
        Term product{term.value * *solved_.problem.quantities[quantity].value, term.powers};
        scaling::add(product.powers, inputs_.of_value(quantity), 1.0);
        return product;
    }

    /// δ of a product with what is solved of motion at its value; nothing where there is none of it, or where δ is open.
    std::optional<std::size_t> add_shaken(const ScaleProduct& product, const ScaleFactor& delta) {
        if (!delta.value) return std::nullopt;
        Powers powers = inputs_.of_factors(delta.exponents);
        bool has_motion = false;
        for (std::size_t j = 0; j < product.exponents.size(); ++j) {
            const QuantityScale& scale = solved_.solution.quantities[j];
            if (product.exponents[j] == 0 || scale.state != ScaleState::solved || !is_motion(solved_.problem.quantities[j])) continue;
            has_motion = true;
            scaling::add(powers, inputs_.of_factors(scale.factor.exponents), -to_double(product.exponents[j]));
        }
        return has_motion ? std::optional(add({product.text, {*delta.value, std::move(powers)}, {}})) : std::nullopt;
    }

    const std::vector<Row>& all() const { return rows_; }

  private:
    const SolvedLaw& solved_;
    const Inputs& inputs_;
    std::vector<Row> rows_;
};

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

/// What the law holds must follow from something that is solved, or be certain.
void check_held(const SolvedLaw& solved, const Inputs& inputs) {
    for (std::size_t i = 0; i < solved.problem.held.size(); ++i) {
        const Exponents& exponents = solved.solution.held[i].exponents;
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

}  // namespace

UncertainLawReport propagate(const SolvedLaw& solved, const std::vector<UncertainFactor>& given,
                             const std::vector<UncertainPrototype>& prototype, const std::optional<MonteCarloSettings>& monte_carlo) {
    const Inputs inputs(solved, given, prototype);
    check_held(solved, inputs);
    const ScaleProblem& problem = solved.problem;
    const ScaleSolution& solution = solved.solution;

    // what is asked for
    Rows rows(solved, inputs);
    using Place = std::optional<std::size_t>;
    std::vector<Place> factors, held, watched, shaken;
    for (std::size_t j = 0; j < problem.quantities.size(); ++j) {
        factors.push_back(rows.add_factor(problem.quantities[j].name, solution.quantities[j].factor));
    }
    for (std::size_t i = 0; i < problem.held.size(); ++i) {
        held.push_back(rows.add_factor(problem.held[i].text, solution.held[i]));
        if (!problem.held[i].is_definition) shaken.push_back(rows.add_shaken(problem.held[i], solution.held[i]));
    }
    for (std::size_t i = 0; i < problem.watched.size(); ++i) {
        watched.push_back(rows.add_factor(problem.watched[i].text, solution.watched[i]));
        shaken.push_back(rows.add_shaken(problem.watched[i], solution.watched[i]));
    }
    struct PairPlace {
        std::size_t quantity, prototype, model;
    };
    std::vector<PairPlace> pairs;
    for (std::size_t j = 0; j < problem.quantities.size(); ++j) {
        const PiQuantity& quantity = problem.quantities[j];
        const ScaleFactor& factor = solution.quantities[j].factor;
        if (!quantity.value || !factor.value) continue;
        const std::size_t of_prototype = rows.add({quantity.name, rows.times_value({1.0, Powers(inputs.all().size())}, j), {}});
        pairs.push_back({j, of_prototype, rows.add({quantity.name, rows.times_value(rows.make_term(factor), j), {}})});
    }
    struct AdditionPlace {
        Place factor, model;
    };
    std::vector<AdditionPlace> additions;
    for (const LawAddition& addition : solved.law.additions) {
        AdditionPlace& place = additions.emplace_back();
        if (!solved.added(addition)) continue;
        const Term total = rows.make_term(solution.quantities[find_quantity(problem.quantities, addition.total)].factor);
        const Term own = rows.make_term(solution.quantities[find_quantity(problem.quantities, addition.own)].factor);
        place.factor = rows.add({addition.name, total, own});
        const auto base = solved.find_base(addition);
        if (base) place.model = rows.add({addition.name, rows.times_value(total, *base), rows.times_value(own, *base)});
    }

    // samples
    UncertainLawReport report;
    report.inputs = inputs.all();
    Propagated propagated{rows.all(), inputs.all(), std::vector<std::optional<SampleSummary>>(rows.all().size())};
    if (monte_carlo) {
        const Evaluation evaluate = [&](std::span<const double> drawn) {
            std::vector<double> logs;
            for (std::size_t i = 0; i < drawn.size(); ++i) {
                logs.push_back(detail::portable_log(drawn[i] / report.inputs[i].quantity.value));
            }
            std::vector<double> values;
            for (const Row& row : rows.all()) values.push_back(row.sample(logs));
            return values;
        };
        MonteCarloRun run = run_monte_carlo(report.inputs, evaluate, *monte_carlo);
        for (std::size_t i = 0; i < run.results.size(); ++i) propagated.samples[i] = run.results[i];
        report.rejected = run.rejected;
    }

    // and back
    for (const Place& place : factors) report.factors.push_back(propagated.result(place));
    for (const Place& place : held) report.held.push_back(propagated.result(place));
    for (const Place& place : watched) report.watched.push_back(propagated.result(place));
    for (const Place& place : shaken) {
        if (place) report.shaken.push_back(propagated.result(*place));
    }
    for (const PairPlace& pair : pairs) {
        const PiQuantity& quantity = problem.quantities[pair.quantity];
        report.values.push_back({quantity.name, quantity.dimension, propagated.result(pair.prototype), propagated.result(pair.model)});
    }
    for (const AdditionPlace& place : additions) {
        std::optional<UncertainAddition>& addition = report.additions.emplace_back();
        if (!place.factor) continue;
        addition = UncertainAddition{propagated.difference(*place.factor), {}};
        if (place.model) addition->model = propagated.difference(*place.model);
    }
    return report;
}

}  // namespace musim::scaling
