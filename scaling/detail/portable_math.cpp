#include "scaling/detail/portable_math.hpp"

#include <cmath>

namespace musim::scaling::detail {

namespace {

/// ln 2 in two parts, the first with so few digits that its product with any exponent of a double is exact.
constexpr double kLogTwoHigh = 0x1.62e42feep-1;
constexpr double kLogTwoLow = 0x1.a39ef35793c76p-33;
constexpr double kLogTwo = kLogTwoHigh + kLogTwoLow;

/// 2 artanh s = ln((1 + s)/(1 - s)) for |s| <= 0.18: the first term left out, 2 s^25/25, is below 1e-18 of the sum.
double twice_artanh(double s) {
    const double square = s * s;
    double sum = 0.0;
    for (int odd = 23; odd >= 1; odd -= 2) sum = sum * square + 1.0 / odd;
    return 2.0 * s * sum;
}

}  // namespace

double portable_log(double x) {
    int exponent = 0;
    double mantissa = std::frexp(x, &exponent);  // in [0.5, 1)
    if (mantissa * mantissa < 0.5) {
        mantissa *= 2.0;
        --exponent;
    }
    return exponent * kLogTwoHigh + (twice_artanh((mantissa - 1.0) / (mantissa + 1.0)) + exponent * kLogTwoLow);
}

double portable_log1p(double x) {
    // above, 1 + x loses nothing that matters
    if (x > 0.4) return portable_log(1.0 + x);
    return twice_artanh(x / (2.0 + x));
}

double portable_exp(double x) {
    const double exponent = std::floor(x / kLogTwo + 0.5);
    const double rest = (x - exponent * kLogTwoHigh) - exponent * kLogTwoLow;  // at most ln(2)/2
    // Taylor: the first term left out, rest^15/15!, is below 1e-19
    double sum = 1.0;
    for (int n = 14; n >= 1; --n) sum = 1.0 + sum * rest / n;
    return std::ldexp(sum, static_cast<int>(exponent));
}

}  // namespace musim::scaling::detail
