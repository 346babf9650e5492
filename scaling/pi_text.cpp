#include "scaling/pi_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

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

std::string factor_text(std::string_view name, const Rational& power, PiNotation notation) {
    if (notation == PiNotation::text) return fmt::format("{}{}", name, power_text(power));
    const std::string base = latex_name(name);
    return power == 1 ? base : fmt::format("{}^{{{}}}", base, to_string(power));
}

}  // namespace

std::string latex_name(std::string_view name) {
    const std::size_t mark = name.find('_');
    if (mark == std::string_view::npos || mark == 0 || mark + 1 == name.size()) return latex_word(name);
    return fmt::format("{}_{{{}}}", latex_word(name.substr(0, mark)), latex_word(name.substr(mark + 1)));
}

std::string format_group(const std::vector<Rational>& exponents, const std::vector<PiQuantity>& quantities, PiNotation notation) {
    std::vector<std::string> above;
    std::vector<std::string> below;
    for (std::size_t i = 0; i < quantities.size(); ++i) {
        const Rational& exponent = exponents[i];
        if (exponent.numerator() > 0) above.push_back(factor_text(quantities[i].name, exponent, notation));
        if (exponent.numerator() < 0) below.push_back(factor_text(quantities[i].name, -exponent, notation));
    }
    const std::string_view times = notation == PiNotation::text ? "*" : "\\,";
    std::string numerator = above.empty() ? "1" : fmt::format("{}", fmt::join(above, times));
    if (below.empty()) return numerator;
    const std::string denominator = fmt::format("{}", fmt::join(below, times));
    if (notation == PiNotation::latex) return fmt::format("\\frac{{{}}}{{{}}}", numerator, denominator);
    return below.size() == 1 ? fmt::format("{}/{}", numerator, denominator) : fmt::format("{}/({})", numerator, denominator);
}

std::string format_group(const PiGroup& group, const std::vector<PiQuantity>& quantities, PiNotation notation) {
    return format_group(std::vector<Rational>(group.begin(), group.end()), quantities, notation);
}

}  // namespace musim::scaling
