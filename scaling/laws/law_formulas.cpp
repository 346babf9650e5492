#include "scaling/laws/law_formulas.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "scaling/factor_rounding.hpp"

namespace musim::scaling {

namespace {

std::vector<detail::RootedProduct> make_products(const std::vector<ScaleFactor>& factors) {
    std::vector<detail::RootedProduct> products;
    products.reserve(factors.size());
    for (const ScaleFactor& factor : factors) products.emplace_back(factor.exponents);
    return products;
}

std::optional<double> evaluate(const detail::RootedProduct& product, const ScaleFactor& factor, const ChosenFactors& chosen,
                               std::string_view name) {
    if (!factor.value) return std::nullopt;
    const auto value = product.value(chosen);
    if (value) return value;
    throw SimilitudeError(fmt::format("the factor of {} leaves the range of doubles; choose factors nearer 1", name));
}

}  // namespace

LawFormulas::LawFormulas(SolvedLaw solved)
    : solved_(std::move(solved)), held_(make_products(solved_.solution.held)), watched_(make_products(solved_.solution.watched)) {
    for (const QuantityScale& scale : solved_.solution.quantities) factors_.emplace_back(scale.factor.exponents);
    for (std::size_t i = 0; i < held_.size(); ++i) {
        const std::vector<Rational>& exponents = solved_.solution.held[i].exponents;
        if (std::any_of(exponents.begin(), exponents.end(), [](const Rational& exponent) { return exponent != 0; })) settled_.push_back(i);
    }
}

ChosenFactors LawFormulas::choose(const std::vector<GivenFactor>& given) const {
    ChosenFactors chosen = solved_.problem.chosen;
    for (const auto& [name, factor] : given) {
        const std::size_t j = find_quantity(solved_.problem.quantities, name);
        if (!chosen[j] || solved_.is_default[j]) {
            throw PiError(fmt::format("law {}: {} was not given when the law was solved; solve it again", solved_.law.name, name));
        }
        check_chosen_factor(name, factor);
        chosen[j] = factor;
    }
    for (const std::size_t i : settled_) {
        // solving again says which factors contradict which products
        if (std::abs(*held(i, chosen) - 1.0) > kFactorRounding) return solve_law(solved_.law, given).problem.chosen;
    }
    return chosen;
}

std::optional<double> LawFormulas::factor(std::size_t quantity, const ChosenFactors& chosen) const {
    return evaluate(factors_[quantity], solved_.solution.quantities[quantity].factor, chosen, solved_.problem.quantities[quantity].name);
}

std::optional<double> LawFormulas::held(std::size_t product, const ChosenFactors& chosen) const {
    return evaluate(held_[product], solved_.solution.held[product], chosen, solved_.problem.held[product].text);
}

std::optional<double> LawFormulas::watched(std::size_t product, const ChosenFactors& chosen) const {
    return evaluate(watched_[product], solved_.solution.watched[product], chosen, solved_.problem.watched[product].text);
}

}  // namespace musim::scaling
