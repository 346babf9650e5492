#pragma once

#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "scaling/rational.hpp"

namespace musim::scaling::detail {

/// A product of whole powers that neither overflows nor underflows on the way: mantissa and exponent of 2 apart, numerator and denominator
/// apart until the end. Bases scaled by powers of two leave the same bits in the mantissa.
class WideProduct {
  public:
    /// Multiplies by base^n.
    void multiply(double base, std::int64_t n);

    /// The product; none when it divides by zero or no double can hold it.
    std::optional<double> value() const;

    /// The root of a degree from 1 of a product of positive bases. Square roots are taken as such, hence correctly rounded; where the
    /// product is a power of 2^degree the root is a power of two. None as in value().
    std::optional<double> root(std::int64_t degree) const;

  private:
    /// mantissa · 2^exponent.
    struct Scaled {
        double mantissa = 1.0;
        std::int64_t exponent = 0;

        void multiply(const Scaled& factor);
    };
    static Scaled power(double value, std::int64_t n);

    Scaled numerator_;
    Scaled denominator_;
    bool too_large_ = false;
};

/// Π x_j^(n_j) with fixed rational exponents, ready for numbers: whole powers first, one root at the end, so that powers of two stay exact
/// where the exponents allow.
class RootedProduct {
  public:
    /// Throws SimilitudeError when a power leaves 64 bits.
    explicit RootedProduct(const std::vector<Rational>& exponents);

    /// The product; none while one of its factors is missing, or when no normal double can hold it.
    std::optional<double> value(const std::vector<std::optional<double>>& factors) const;

  private:
    std::int64_t degree_ = 1;                                     ///< of the root
    std::vector<std::pair<std::size_t, std::int64_t>> powers_{};  ///< positions and powers under it
};

}  // namespace musim::scaling::detail
