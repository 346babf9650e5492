#pragma once

#include <cmath>

namespace musim::lsdem::detail {

/// A time h of dv/dt = a − α·v with constant a, solved exactly: v ← keep·v + push·a,
///   keep = exp(−α h),   push = (1 − keep)/α;   without damping 1 and h, to the bit.
struct VelocityDecay {
    double keep = 1.0, push = 0.0;  ///< [-], [s]

    VelocityDecay(double rate, double h) : push(h) {
        if (rate == 0.0) return;
        keep = std::exp(-rate * h);
        push = -std::expm1(-rate * h) / rate;
    }
};

}  // namespace musim::lsdem::detail
