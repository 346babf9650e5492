#pragma once

#include "records/ground_motion.hpp"

namespace musim::records {

/// Ricker wavelet as an acceleration pulse [Ricker53], τ counted from its peak:
///
///   a = A (1 − 2φ²) e^{−φ²},   v = A τ e^{−φ²},   φ = π f τ
///
/// It begins and ends at rest where it began. f is the frequency of the largest Fourier amplitude.
struct RickerWavelet {
    scaling::Acceleration amplitude = 0.5 * scaling::kStandardGravity;  ///< A, the PGA
    scaling::Frequency frequency = 1.0 / scaling::si::seconds;          ///< f

    scaling::Acceleration acceleration(scaling::Time tau) const;
    scaling::Velocity velocity(scaling::Time tau) const;
};

/// The wavelet as a record, component "1", two periods to each side of its peak, which is a sample: cut there, velocity and displacement
/// are left to rounding (e^{−4π²} = 7e-18). Nothing else is corrected. Throws ProcessingError when a setting is not positive and finite,
/// for fewer than eight samples a period, and for more than 10^8 steps.
GroundMotion make_ricker_record(const RickerWavelet& wavelet, scaling::Time dt = 0.005 * scaling::si::seconds);

}  // namespace musim::records
