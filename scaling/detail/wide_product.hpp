#pragma once

#include <cstdint>
#include <optional>

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

}  // namespace musim::scaling::detail
