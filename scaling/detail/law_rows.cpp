#include "scaling/detail/law_rows.hpp"

#include <utility>

#include "scaling/detail/portable_math.hpp"

namespace musim::scaling::detail {
namespace {

/// Whether a quantity is made of length and time alone, and of time.
bool is_motion(const PiQuantity& quantity) {
    for (const BaseDimension base : kBaseDimensions) {
        const bool may_be = base == BaseDimension::length || base == BaseDimension::time;
        if (!may_be && quantity.dimension[base] != 0) return false;
    }
    return quantity.dimension[BaseDimension::time] != 0;
}

}  // namespace

double Term::sample(const std::vector<double>& logs) const {
    double sum = 0.0;
    for (std::size_t i = 0; i < logs.size(); ++i) sum += powers[i] * logs[i];
    return value * portable_exp(sum);
}

std::optional<std::size_t> LawRows::add_factor(const std::string& name, const ScaleFactor& factor) {
    return factor.value ? std::optional(add({name, make_term(factor), {}})) : std::nullopt;
}

std::size_t LawRows::add(Row row) {
    rows_.push_back(std::move(row));
    return rows_.size() - 1;
}

std::optional<std::size_t> LawRows::add_shaken(const ScaleProduct& product, const ScaleFactor& delta) {
    if (!delta.value) return std::nullopt;
    Powers powers = inputs_.of_factors(delta.exponents);
    bool has_motion = false;
    for (std::size_t j = 0; j < product.exponents.size(); ++j) {
        const QuantityScale& scale = solved_.solution.quantities[j];
        if (product.exponents[j] == 0 || scale.state != ScaleState::solved || !is_motion(solved_.problem.quantities[j])) continue;
        has_motion = true;
        detail::add(powers, inputs_.of_factors(scale.factor.exponents), -to_double(product.exponents[j]));
    }
    return has_motion ? std::optional(add({product.text, {*delta.value, std::move(powers)}, {}})) : std::nullopt;
}

Term LawRows::times_value(const Term& term, std::size_t quantity) const {
    Term product{term.value * *solved_.problem.quantities[quantity].value, term.powers};
    detail::add(product.powers, inputs_.of_value(quantity), 1.0);
    return product;
}

}  // namespace musim::scaling::detail
