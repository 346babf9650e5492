#include "scaling/pi/fraction_text.hpp"

#include <fmt/format.h>

#include <string_view>

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
