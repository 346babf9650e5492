#pragma once

#include <cstdint>
#include <limits>
#include <numeric>
#include <string>

#include "scaling/error.hpp"

namespace musim::scaling {

/// An exact fraction in lowest terms, denominator positive. Arithmetic that leaves 64 bits throws SimilitudeError, it never wraps.
class Rational {
  public:
    constexpr Rational() = default;
    constexpr Rational(std::int64_t whole) : numerator_(whole) {  // NOLINT(google-explicit-constructor): every integer is one
        if (whole == kNoOpposite) fail();
    }

    /// numerator/denominator. Throws SimilitudeError for a zero denominator.
    constexpr Rational(std::int64_t numerator, std::int64_t denominator) {
        if (denominator == 0) throw SimilitudeError("a fraction has denominator 0; correct the exponent");
        if (numerator == kNoOpposite || denominator == kNoOpposite) fail();
        const std::int64_t divisor = std::gcd(numerator, denominator) * (denominator < 0 ? -1 : 1);
        numerator_ = numerator / divisor;
        denominator_ = denominator / divisor;
    }

    constexpr std::int64_t numerator() const { return numerator_; }
    constexpr std::int64_t denominator() const { return denominator_; }
    constexpr bool is_whole() const { return denominator_ == 1; }

    friend constexpr bool operator==(const Rational&, const Rational&) = default;

    friend constexpr Rational operator-(const Rational& a) { return {-a.numerator_, a.denominator_}; }
    friend constexpr Rational operator+(const Rational& a, const Rational& b) {
        return {add(multiply(a.numerator_, b.denominator_), multiply(b.numerator_, a.denominator_)),
                multiply(a.denominator_, b.denominator_)};
    }
    friend constexpr Rational operator-(const Rational& a, const Rational& b) { return a + -b; }
    friend constexpr Rational operator*(const Rational& a, const Rational& b) {
        // crosswise first, so that a product that fits is not lost on the way
        const Rational left(a.numerator_, b.denominator_);
        const Rational right(b.numerator_, a.denominator_);
        return {multiply(left.numerator_, right.numerator_), multiply(left.denominator_, right.denominator_)};
    }
    friend constexpr Rational operator/(const Rational& a, const Rational& b) { return a * Rational(b.denominator_, b.numerator_); }

  private:
    static constexpr std::int64_t kNoOpposite = std::numeric_limits<std::int64_t>::min();

    [[noreturn]] static void fail() { throw SimilitudeError("an exponent does not fit 64 bits; check the powers of the units"); }
    static constexpr std::int64_t add(std::int64_t a, std::int64_t b) {
        std::int64_t sum = 0;
        if (__builtin_add_overflow(a, b, &sum)) fail();
        return sum;
    }
    static constexpr std::int64_t multiply(std::int64_t a, std::int64_t b) {
        std::int64_t product = 0;
        if (__builtin_mul_overflow(a, b, &product)) fail();
        return product;
    }

    std::int64_t numerator_ = 0;
    std::int64_t denominator_ = 1;
};

/// "2", "-1/2".
std::string to_string(const Rational& number);

/// An exponent behind a symbol: "" for 1, "^2", "^-1", "^(1/2)".
std::string power_text(const Rational& exponent);

}  // namespace musim::scaling
