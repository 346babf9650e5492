#include "scaling/rational.hpp"

#include <fmt/format.h>

namespace musim::scaling {

std::string to_string(const Rational& number) {
    return number.is_whole() ? fmt::format("{}", number.numerator()) : fmt::format("{}/{}", number.numerator(), number.denominator());
}

std::string power_text(const Rational& exponent) {
    if (exponent == 1) return "";
    return exponent.is_whole() ? fmt::format("^{}", exponent.numerator()) : fmt::format("^({})", to_string(exponent));
}

}  // namespace musim::scaling
