#include "scaling/detail/wide_product.hpp"

#include <cmath>
#include <cstdlib>

namespace musim::scaling::detail {

namespace {

/// Powers beyond this are given up [-]: binary exponents of doubles (up to 1074) times it stay far inside 64 bits.
constexpr std::int64_t kHighestPower = 1'000'000'000'000'000;

/// Binary exponents beyond this are outside the range of doubles, with room for a mantissa's own.
constexpr std::int64_t kLargestExponent = 4000;

/// Degrees above this are left to logarithms [-]: up to it 2^degree is a double.
constexpr std::int64_t kHighestRoot = 512;

/// x^(1/degree) for positive x. The long double holds what an odd root needs to round to the exact root where there is one.
double take_root(double x, std::int64_t degree) {
    for (; degree % 2 == 0; degree /= 2) x = std::sqrt(x);
    return degree == 1 ? x : static_cast<double>(std::pow(static_cast<long double>(x), 1.0L / static_cast<long double>(degree)));
}

}  // namespace

void WideProduct::Scaled::multiply(const Scaled& factor) {
    int shift = 0;
    mantissa = std::frexp(mantissa * factor.mantissa, &shift);
    exponent += factor.exponent + shift;
}

WideProduct::Scaled WideProduct::power(double value, std::int64_t n) {
    Scaled square;
    square.multiply({value, 0});
    Scaled result;
    for (; n > 0; n /= 2) {
        if (n % 2 == 1) result.multiply(square);
        if (n > 1) square.multiply(square);
    }
    return result;
}

void WideProduct::multiply(double base, std::int64_t n) {
    if (n > kHighestPower || n < -kHighestPower) {
        too_large_ = true;
    } else if (n > 0) {
        numerator_.multiply(power(base, n));
    } else if (n < 0) {
        denominator_.multiply(power(base, -n));
    }
}

std::optional<double> WideProduct::value() const {
    const std::int64_t exponent = numerator_.exponent - denominator_.exponent;
    if (too_large_ || denominator_.mantissa == 0.0 || std::abs(exponent) > kLargestExponent) return std::nullopt;
    const double value = std::ldexp(numerator_.mantissa / denominator_.mantissa, static_cast<int>(exponent));
    return std::isfinite(value) ? std::optional(value) : std::nullopt;
}

std::optional<double> WideProduct::root(std::int64_t degree) const {
    if (degree == 1) return value();
    if (too_large_) return std::nullopt;

    // mantissa in [1, 2), so that a power of two has the mantissa 1
    int shift = 0;
    const double mantissa = 2.0 * std::frexp(numerator_.mantissa / denominator_.mantissa, &shift);
    const std::int64_t exponent = numerator_.exponent - denominator_.exponent + shift - 1;

    // exponent = degree · whole + rest, 0 <= rest < degree
    std::int64_t whole = exponent / degree;
    if (whole * degree > exponent) --whole;
    if (std::abs(whole) > kLargestExponent) return std::nullopt;
    const std::int64_t rest = exponent - whole * degree;
    const double root =
        degree <= kHighestRoot
            ? take_root(std::ldexp(mantissa, static_cast<int>(rest)), degree)
            : static_cast<double>(std::exp2((std::log2(static_cast<long double>(mantissa)) + static_cast<long double>(rest)) /
                                            static_cast<long double>(degree)));
    const double value = std::ldexp(root, static_cast<int>(whole));
    return std::isfinite(value) ? std::optional(value) : std::nullopt;
}

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
