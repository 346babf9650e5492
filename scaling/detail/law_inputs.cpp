#include "scaling/detail/law_inputs.hpp"

#include <fmt/format.h>

#include <cmath>
#include <string_view>

#include "scaling/distortion.hpp"

namespace musim::scaling::detail {
namespace {

const UncertainRatio* find_ratio(const std::vector<UncertainFactor>& given, std::string_view name) {
    for (const UncertainFactor& factor : given) {
        if (factor.name == name) return &factor.factor;
    }
    return nullptr;
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

}  // namespace

void add(Powers& sum, const Powers& powers, double times) {
    for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += times * powers[i];
}

double to_double(const Rational& number) { return static_cast<double>(number.numerator()) / static_cast<double>(number.denominator()); }

LawInputs::LawInputs(const SolvedLaw& solved, const std::vector<UncertainFactor>& given, const std::vector<UncertainPrototype>& prototype) {
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

Powers LawInputs::of_factors(const std::vector<Rational>& exponents) const {
    Powers powers(inputs_.size());
    for (std::size_t j = 0; j < exponents.size(); ++j) {
        if (factors_[j].above) powers[*factors_[j].above] += to_double(exponents[j]);
        if (factors_[j].below) powers[*factors_[j].below] -= to_double(exponents[j]);
    }
    return powers;
}

Powers LawInputs::of_value(std::size_t quantity) const {
    Powers powers(inputs_.size());
    if (values_[quantity]) powers[*values_[quantity]] = 1.0;
    return powers;
}

LawInputs::Place LawInputs::add_input(const std::string& name, const Uncertain& quantity, const RationalDimension& dimension) {
    if (!quantity.is_uncertain()) return std::nullopt;
    inputs_.push_back({name, quantity, dimension});
    return inputs_.size() - 1;
}

}  // namespace musim::scaling::detail
