#include "scaling/pi/pi_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string_view>

namespace musim::scaling {

namespace {

constexpr std::array<std::string_view, 29> kGreek = {
    "alpha", "beta",  "gamma", "delta", "epsilon", "zeta", "eta",   "theta", "iota",  "kappa", "lambda", "mu",    "nu",    "xi", "pi",
    "rho",   "sigma", "tau",   "phi",   "chi",     "psi",  "omega", "Delta", "Sigma", "Phi",   "Omega",  "Theta", "Gamma", "Pi"};

/// A word in LaTeX: Greek letters by name, single letters in italics, others upright; signs of LaTeX escaped.
std::string latex_word(std::string_view word) {
    if (std::find(kGreek.begin(), kGreek.end(), word) != kGreek.end()) return fmt::format("\\{}", word);
    std::string escaped;
    for (const char letter : word) {
        if (std::string_view("#$%&_{}").find(letter) != std::string_view::npos) escaped += '\\';
        escaped += letter == '~' ? ' ' : letter;
    }
    return word.size() == 1 ? escaped : fmt::format("\\mathrm{{{}}}", escaped);
}

}  // namespace

std::string latex_name(std::string_view name) {
    const std::size_t mark = name.find('_');
    if (mark == std::string_view::npos || mark == 0 || mark + 1 == name.size()) return latex_word(name);
    return fmt::format("{}_{{{}}}", latex_word(name.substr(0, mark)), latex_word(name.substr(mark + 1)));
}

std::string format_group(const std::vector<Rational>& exponents, const std::vector<PiQuantity>& quantities, PiNotation notation) {
    detail::FractionText product(notation);
    for (std::size_t i = 0; i < quantities.size(); ++i) {
        const std::string& name = quantities[i].name;
        product.multiply(notation == PiNotation::text ? name : latex_name(name), exponents[i]);
    }
    return product.text();
}

std::string format_group(const PiGroup& group, const std::vector<PiQuantity>& quantities, PiNotation notation) {
    return format_group(std::vector<Rational>(group.begin(), group.end()), quantities, notation);
}

}  // namespace musim::scaling

namespace musim::scaling::detail {

void FractionText::multiply(const std::string& name, const Rational& exponent) {
    if (exponent == 0) return;
    const bool is_above = exponent.numerator() > 0;
    const Rational power = is_above ? exponent : -exponent;
    const bool is_text = notation_ == PiNotation::text;
    const std::string raised = is_text ? power_text(power) : power == 1 ? "" : fmt::format("^{{{}}}", to_string(power));
    (is_above ? above_ : below_).push_back(name + raised);
}

std::string FractionText::text() const {
    const std::string_view times = notation_ == PiNotation::text ? "*" : "\\,";
    std::string numerator = above_.empty() ? "1" : fmt::format("{}", fmt::join(above_, times));
    if (below_.empty()) return numerator;
    const std::string denominator = fmt::format("{}", fmt::join(below_, times));
    if (notation_ == PiNotation::latex) return fmt::format("\\frac{{{}}}{{{}}}", numerator, denominator);
    return below_.size() == 1 ? fmt::format("{}/{}", numerator, denominator) : fmt::format("{}/({})", numerator, denominator);
}

}  // namespace musim::scaling::detail
