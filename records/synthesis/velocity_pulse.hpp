#pragma once

#include "records/ground_motion.hpp"

namespace musim::records {

/// Near-fault velocity pulse of Mavroeidis and Papageorgiou [MavroeidisPapageorgiou03], τ counted from its middle, |τ| ≤ γ/(2 f_p), else
/// at rest. With θ = 2π f_p τ:
///
///   v = A/2 (1 + cos θ/γ) cos(θ + ν)
///   a = −A π f_p (1/γ sin θ/γ cos(θ + ν) + (1 + cos θ/γ) sin(θ + ν))
///   d = A/(4π f_p) (sin(θ + ν) + γ/(2(γ − 1)) sin((γ − 1)/γ θ + ν) + γ/(2(γ + 1)) sin((γ + 1)/γ θ + ν)) + constant
///
/// It ends at rest, in general displaced; d is counted from where it began.
struct VelocityPulse {
    scaling::Velocity amplitude = 0.5 * scaling::si::meters_per_second;  ///< A, of the envelope; the PGV for ν = 0
    scaling::Frequency frequency = 0.5 / scaling::si::seconds;           ///< f_p, prevailing; 1/f_p is the pulse's period
    double cycles = 2.0;                                                 ///< γ > 1: length of the envelope in periods
    double phase_deg = 0.0;                                              ///< ν [deg]

    scaling::Acceleration acceleration(scaling::Time tau) const;
    scaling::Velocity velocity(scaling::Time tau) const;
    scaling::Length displacement(scaling::Time tau) const;

    /// A sin(πγ) cos ν / (2π f_p (1 − γ²)).
    scaling::Length residual_displacement() const;
};

/// The pulse as a record, component "1", its middle a sample. The trapezoid sums of the samples would leave a velocity of order (f_p dt)²;
/// it is taken out as in bring_to_rest(), and the record ends at the pulse's residual displacement, or with `return_home` where it
/// began (which bends the whole record; the history records it). Throws ProcessingError when a setting is not positive and finite, for γ ≤
/// 1, a phase that is not finite, fewer than eight samples a period, and more than 10^8 steps.
GroundMotion make_velocity_pulse_record(const VelocityPulse& pulse, scaling::Time dt = 0.005 * scaling::si::seconds,
                                        bool return_home = false);

}  // namespace musim::records
