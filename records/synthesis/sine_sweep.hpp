#pragma once

#include "records/ground_motion.hpp"

namespace musim::records {

/// Course of a sweep's frequency from its first to its last value.
enum class SweepKind {
    linear,       ///< f₀ + (f₁ − f₀) t/T: equal time per Hz
    logarithmic,  ///< f₀ (f₁/f₀)^{t/T}: equal time per octave
};

/// Wishes for a sine sweep: a = A w(t) sin φ(t), φ̇ = 2π f(t), up or down.
struct SineSweepSettings {
    scaling::Acceleration amplitude = 0.1 * scaling::kStandardGravity;  ///< A
    scaling::Frequency first = 0.5 / scaling::si::seconds;              ///< f₀
    scaling::Frequency last = 10.0 / scaling::si::seconds;              ///< f₁ ≠ f₀
    SweepKind kind = SweepKind::logarithmic;
    scaling::Time dt = 0.005 * scaling::si::seconds;
    scaling::Time duration = 40.0 * scaling::si::seconds;  ///< T, rounded to whole steps
    double taper = 0.05;                                   ///< w: half cosines at both ends, fraction of T each, up to 1/2
};

/// The sweep as a record, component "1". A sine has no reason to end where it began, so velocity and displacement are taken out as in
/// bring_to_rest(); the history records it. Throws ProcessingError when a setting is not positive and finite, for equal frequencies, a
/// taper that is not within 0 to 1/2, fewer than eight samples a period, and fewer than 64 steps or more than 10^8.
GroundMotion make_sine_sweep_record(const SineSweepSettings& settings = {});

}  // namespace musim::records
