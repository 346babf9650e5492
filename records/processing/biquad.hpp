#pragma once

#include <span>
#include <vector>

namespace musim::records::detail {

/// Second-order digital filter section, transposed direct form II:
///
///   H(z) = (b0 + b1 z⁻¹ + b2 z⁻²) / (1 + a1 z⁻¹ + a2 z⁻²)
struct Biquad {
    double b0 = 1.0;
    double b1 = 0.0;
    double b2 = 0.0;
    double a1 = 0.0;
    double a2 = 0.0;
};

/// Analog (n0 + n1 s + n2 s²) / (d0 + d1 s + d2 s²) by the bilinear transform s = (1 − z⁻¹)/(1 + z⁻¹): frequencies in units of 2/dt.
constexpr Biquad bilinear(double n0, double n1, double n2, double d0, double d1, double d2) {
    const double scale = 1.0 / (d0 + d1 + d2);
    return {.b0 = (n0 + n1 + n2) * scale,
            .b1 = 2.0 * (n0 - n2) * scale,
            .b2 = (n0 - n1 + n2) * scale,
            .a1 = 2.0 * (d0 - d2) * scale,
            .a2 = (d0 - d1 + d2) * scale};
}

/// Filters in place, from rest.
inline void apply_biquad(const Biquad& filter, std::span<double> samples) {
    double memory1 = 0.0;
    double memory2 = 0.0;
    for (double& sample : samples) {
        const double output = filter.b0 * sample + memory1;
        memory1 = filter.b1 * sample - filter.a1 * output + memory2;
        memory2 = filter.b2 * sample - filter.a2 * output;
        sample = output;
    }
}

}  // namespace musim::records::detail
