#include "scaling/uncertainty/uncertain_law.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

#include "scaling/laws/law_formulas.hpp"
#include "scaling/structures/distortion.hpp"
#include "scaling/uncertainty/input_values.hpp"

namespace musim::scaling {

namespace {

using detail::InputValues;
using detail::Place;
using detail::RatioPlace;
using detail::Values;

/// Check of what the law holds, which must follow from something that is solved, or be certain.
void check_held(const SolvedLaw& solved, const std::vector<UncertainFactor>& given) {
    for (const auto& [name, ratio] : given) {
        const std::size_t j = find_quantity(solved.problem.quantities, name);
        for (std::size_t i = 0; i < solved.problem.held.size() && ratio.is_uncertain(); ++i) {
            if (solved.solution.held[i].exponents[j] == 0) continue;
            const ScaleProduct& product = solved.problem.held[i];
            throw SimilitudeError(fmt::format(
                "law {}: the factor of {} is uncertain, where {} {} (no other factor is left to keep it); take its value alone{}",
                solved.law.name, name, product.text, product.is_definition ? "is 1 by definition" : "is held",
                product.is_definition ? ", or release another factor in it" : fmt::format(", or watch {} instead", product.text)));
        }
    }
}

/// Both are the prototype's. The numbers of a fraction may be in any unit, those of a plain number are in none.
void require_same(const PiQuantity& quantity, const Uncertain& value, const Uncertain& below) {
    const bool same_value = !quantity.dimension.is_dimensionless() || std::abs(value.value / below.value - 1.0) <= kFactorRounding;
    const bool same_share = !value.is_uncertain() || std::abs(value.relative() / below.relative() - 1.0) <= kFactorRounding;
    if (same_value && same_share) return;
    throw SimilitudeError(fmt::format(
        "{} of the prototype is {:g} +/- {:.3g} %, and {:g} +/- {:.3g} % below the factor's fraction (both are the prototype's); leave "
        "one out",
        quantity.name, value.value, 100.0 * value.relative(), below.value, 100.0 * below.relative()));
}

/// Whether a quantity is made of length and time alone, and of time.
bool is_motion(const PiQuantity& quantity) {
    for (const BaseDimension base : kBaseDimensions) {
        const bool may_be = base == BaseDimension::length || base == BaseDimension::time;
        if (!may_be && quantity.dimension[base] != 0) return false;
    }
    return quantity.dimension[BaseDimension::time] != 0;
}

/// δ of a product in a test whose solved factors of motion are at their values.
struct ShakenProduct {
    std::string text;             ///< of the product
    double delta;                 ///< at the values
    detail::RootedProduct moved;  ///< of the factors over their values, without those of motion
};

/// Where a value of the prototype stands, and what it is there, perhaps in another unit.
struct PrototypePlace {
    std::size_t place;
    double value;
};

/// Rows of numbers that are asked of a law, one for each set of values of its inputs. What is open has no number.
class LawRows {
  public:
    LawRows(const SolvedLaw& solved, const std::vector<UncertainFactor>& given, const std::vector<UncertainPrototype>& prototype)
        : formulas_(solved), factors_(quantities().size()), prototype_(quantities().size()) {
        for (const auto& [name, ratio] : given) factors_[find_quantity(quantities(), name)] = add_ratio(inputs_, name, ratio);
        for (const UncertainPrototype& each : prototype) {
            const Uncertain& value = each.value;
            const std::size_t j = find_quantity(quantities(), each.name);
            const auto named = std::find_if(given.begin(), given.end(), [&](const auto& factor) { return factor.name == each.name; });
            if (named != given.end() && named->factor.denominator) {
                require_same(quantities()[j], value, *named->factor.denominator);
                prototype_[j] = {*factors_[j]->denominator, named->factor.denominator->value};
            } else {
                prototype_[j] = {inputs_.add(each.name + "_prototype", value, quantities()[j].dimension), value.value};
            }
        }
        for (std::size_t i = 0; i < solved.problem.held.size(); ++i) {
            if (!solved.problem.held[i].is_definition) add_shaken(solved.problem.held[i], solved.solution.held[i]);
        }
        for (std::size_t i = 0; i < solved.problem.watched.size(); ++i) add_shaken(solved.problem.watched[i], solved.solution.watched[i]);
    }

    const std::vector<UncertainInput>& inputs() const { return inputs_.inputs(); }
    const std::vector<ShakenProduct>& shaken() const { return shaken_; }

    /// Factors, held and watched products that are settled; shaken ones; a pair for each value whose model is known; for each addition that
    /// is settled the total factor, the own one and their difference, and these again times the prototype's value where that is known.
    std::vector<double> evaluate(std::span<const double> drawn) const {
        const Values values = inputs_.fill(drawn);
        ChosenFactors chosen = solved().problem.chosen;
        for (std::size_t j = 0; j < chosen.size(); ++j) {
            if (factors_[j]) chosen[j] = factors_[j]->value(values);
        }
        std::vector<double> row;
        const auto add = [&](const std::optional<double>& value) {
            if (value) row.push_back(*value);
        };
        std::vector<std::optional<double>> factors, moved;
        for (std::size_t j = 0; j < chosen.size(); ++j) {
            factors.push_back(formulas_.factor(j, chosen));
            const auto& at_value = solved().solution.quantities[j].factor.value;
            moved.push_back(factors[j] ? std::optional(*factors[j] / *at_value) : std::nullopt);
            add(factors[j]);
        }
        for (std::size_t i = 0; i < solved().problem.held.size(); ++i) add(formulas_.held(i, chosen));
        for (std::size_t i = 0; i < solved().problem.watched.size(); ++i) add(formulas_.watched(i, chosen));
        for (const ShakenProduct& product : shaken_)
            row.push_back(product.delta * product.moved.value(moved).value_or(std::numeric_limits<double>::quiet_NaN()));
        for (std::size_t j = 0; j < factors.size(); ++j) {
            if (!quantities()[j].value || !factors[j]) continue;
            row.insert(row.end(), {prototype(j, values), prototype(j, values) * *factors[j]});
        }
        for (const LawAddition& addition : solved().law.additions) {
            if (!solved().added(addition)) continue;
            const double total = *factors[find_quantity(quantities(), addition.total)],
                         own = *factors[find_quantity(quantities(), addition.own)];
            row.insert(row.end(), {total, own, total - own});
            if (const auto base = solved().find_base(addition)) {
                const double value = prototype(*base, values);
                row.insert(row.end(), {value * total, value * own, value * total - value * own});
            }
        }
        return row;
    }

  private:
    const SolvedLaw& solved() const { return formulas_.solved(); }
    const std::vector<PiQuantity>& quantities() const { return solved().problem.quantities; }

    double prototype(std::size_t quantity, const Values& values) const {
        const auto& place = prototype_[quantity];
        return *quantities()[quantity].value * (place ? values[place->place] / place->value : 1.0);
    }

    void add_shaken(const ScaleProduct& product, const ScaleFactor& delta) {
        if (!delta.value) return;
        std::vector<Rational> exponents = product.exponents;
        bool has_motion = false;
        for (std::size_t j = 0; j < exponents.size(); ++j) {
            const bool is_solved = solved().solution.quantities[j].state == ScaleState::solved;
            if (exponents[j] == 0 || !is_solved || !is_motion(quantities()[j])) continue;
            has_motion = true;
            exponents[j] = 0;
        }
        if (has_motion) shaken_.push_back({product.text, *delta.value, detail::RootedProduct(exponents)});
    }

    LawFormulas formulas_;
    InputValues inputs_;
    std::vector<std::optional<RatioPlace>> factors_;        ///< of each quantity
    std::vector<std::optional<PrototypePlace>> prototype_;  ///< of each quantity
    std::vector<ShakenProduct> shaken_;
};

/// The result when there is a factor.
std::optional<UncertainResult> take(ResultsInOrder& results, const std::string& name, const ScaleFactor& factor) {
    return factor.value ? std::optional(results.take(name)) : std::nullopt;
}

/// u² = Σ (Σ ± value power_i)² (u_i/x_i)² over both terms: a difference may be zero, where it has no powers of its own.
UncertainDifference take_difference(ResultsInOrder& results, const std::string& name, const std::vector<UncertainInput>& inputs) {
    const FirstOrder total = results.take(name).first_order, own = results.take(name).first_order;
    UncertainDifference difference{total.value - own.value, 0.0, results.take(name).samples};
    for (std::size_t k = 0; k < inputs.size(); ++k) {
        const double slope = total.value * total.exponents[k] - own.value * own.exponents[k];
        difference.uncertainty = std::hypot(difference.uncertainty, slope * inputs[k].quantity.relative());
    }
    return difference;
}

}  // namespace

UncertainLawReport propagate(const SolvedLaw& solved, const std::vector<UncertainFactor>& given,
                             const std::vector<UncertainPrototype>& prototype, const std::optional<MonteCarloSettings>& monte_carlo) {
    const LawRows rows(solved, given, prototype);
    check_held(solved, given);
    const Evaluation evaluate = [&](std::span<const double> drawn) { return rows.evaluate(drawn); };
    ResultsInOrder results(rows.inputs(), evaluate, monte_carlo);

    UncertainLawReport report;
    report.inputs = rows.inputs();
    report.draws = results.draws();
    const ScaleProblem& problem = solved.problem;
    const ScaleSolution& solution = solved.solution;
    for (std::size_t j = 0; j < problem.quantities.size(); ++j) {
        report.factors.push_back(take(results, problem.quantities[j].name, solution.quantities[j].factor));
    }
    for (std::size_t i = 0; i < problem.held.size(); ++i) report.held.push_back(take(results, problem.held[i].text, solution.held[i]));
    for (std::size_t i = 0; i < problem.watched.size(); ++i) {
        report.watched.push_back(take(results, problem.watched[i].text, solution.watched[i]));
    }
    for (const ShakenProduct& product : rows.shaken()) report.shaken.push_back(results.take(product.text));
    for (std::size_t j = 0; j < problem.quantities.size(); ++j) {
        const PiQuantity& quantity = problem.quantities[j];
        if (!quantity.value || !solution.quantities[j].factor.value) continue;
        UncertainResult of_prototype = results.take(quantity.name);
        report.values.push_back({quantity.name, quantity.dimension, std::move(of_prototype), results.take(quantity.name)});
    }
    for (const LawAddition& addition : solved.law.additions) {
        std::optional<UncertainAddition>& entry = report.additions.emplace_back();
        if (!solved.added(addition)) continue;
        entry = UncertainAddition{take_difference(results, addition.name, report.inputs), {}};
        if (solved.find_base(addition)) entry->model = take_difference(results, addition.name, report.inputs);
    }
    return report;
}

}  // namespace musim::scaling
