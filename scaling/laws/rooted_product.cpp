#include "scaling/laws/rooted_product.hpp"

#include <cmath>

#include "scaling/detail/wide_product.hpp"

namespace musim::scaling::detail {

RootedProduct::RootedProduct(const std::vector<Rational>& exponents) {
    // a multiple of all denominators: each step adds what the one at hand still needs
    for (const Rational& exponent : exponents) degree_ = (Rational(degree_) * (exponent * degree_).denominator()).numerator();
    for (std::size_t j = 0; j < exponents.size(); ++j) {
        if (exponents[j] != 0) powers_.emplace_back(j, (exponents[j] * degree_).numerator());
    }
}

std::optional<double> RootedProduct::value(const std::vector<std::optional<double>>& factors) const {
    WideProduct product;
    for (const auto& [position, power] : powers_) {
        if (!factors[position]) return std::nullopt;
        product.multiply(*factors[position], power);
    }
    const auto value = product.root(degree_);
    return value && std::isnormal(*value) ? value : std::nullopt;
}

}  // namespace musim::scaling::detail
