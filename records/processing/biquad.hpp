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

/// State of a section between two samples; as it is here, at rest.
struct BiquadMemory {
    double first = 0.0;
    double second = 0.0;

    /// As after a constant sample that has lasted for ever, of which the section makes the constant `output`.
    static BiquadMemory settled(const Biquad& filter, double sample, double output) {
        const double second = filter.b2 * sample - filter.a2 * output;
        return {filter.b1 * sample - filter.a1 * output + second, second};
    }
};

/// Next sample of the output.
inline double apply_biquad(const Biquad& filter, double sample, BiquadMemory& memory) {
    const double output = filter.b0 * sample + memory.first;
    memory.first = filter.b1 * sample - filter.a1 * output + memory.second;
    memory.second = filter.b2 * sample - filter.a2 * output;
    return output;
}

/// Filters in place, from rest.
inline void apply_biquad(const Biquad& filter, std::span<double> samples) {
    BiquadMemory memory;
    for (double& sample : samples) sample = apply_biquad(filter, sample, memory);
}

}  // namespace musim::records::detail
