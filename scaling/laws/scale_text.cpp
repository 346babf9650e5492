#include "scaling/laws/scale_text.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "scaling/pi/pi_text.hpp"

namespace musim::scaling {

std::string latex_factor_name(const std::string& quantity) { return fmt::format("\\lambda_{{{}}}", latex_name(quantity)); }

std::string format_factor(const std::vector<Rational>& exponents, const std::vector<PiQuantity>& quantities, PiNotation notation) {
    const bool is_text = notation == PiNotation::text;
    const bool in_halves = std::all_of(exponents.begin(), exponents.end(), [](const Rational& e) { return e.denominator() <= 2; });
    // 5/2 = 2 + 1/2, towards zero
    const auto root_of = [&](const Rational& exponent) {
        if (!in_halves || exponent.is_whole()) return Rational(0);
        return Rational(exponent.numerator() > 0 ? 1 : -1);
    };
    // v/sqrt(g*l), not v*sqrt(1/(g*l))
    const bool is_above = std::any_of(exponents.begin(), exponents.end(), [&](const Rational& e) { return root_of(e) == 1; });

    detail::FractionText whole(notation);
    detail::FractionText under_root(notation);
    for (std::size_t j = 0; j < quantities.size(); ++j) {
        const std::string factor = is_text ? quantities[j].name : latex_factor_name(quantities[j].name);
        const Rational root = root_of(exponents[j]);
        whole.multiply(factor, exponents[j] - root * Rational(1, 2));
        under_root.multiply(factor, is_above ? root : -root);
    }
    if (!under_root.is_empty()) {
        whole.multiply(fmt::format("{}{}{}", is_text ? "sqrt(" : "\\sqrt{", under_root.text(), is_text ? ")" : "}"), is_above ? 1 : -1);
    }
    return whole.text();
}

}  // namespace musim::scaling
