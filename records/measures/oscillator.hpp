#pragma once

#include <numbers>

#include "scaling/units.hpp"

namespace musim::records::detail {

/// One step of ü + 2ζω u̇ + ω² u = −a with a linear between a₀ at its start and a₁ at its end, in units of the step: u/dt², u̇/dt.
///
///   u ← u_u·u + u_v·u̇ + u_0·a₀ + u_1·a₁,      u̇ ← v_u·u + v_v·u̇ + v_0·a₀ + v_1·a₁
struct OscillatorStep {
    double u_u = 1.0, u_v = 1.0, u_0 = 0.0, u_1 = 0.0;
    double v_u = 0.0, v_v = 1.0, v_0 = 0.0, v_1 = 0.0;
};

/// θ = ω·dt = 2π·dt/T, what an oscillator of period T turns by in a step [rad].
inline double find_theta(scaling::Time period, scaling::Time dt) { return 2.0 * std::numbers::pi * (dt.value() / period.value()); }

/// `theta` = ω·dt > 0, `damping` ζ ≥ 0, both finite.
OscillatorStep make_oscillator_step(double theta, double damping);

/// How u after the share 0 < s ≤ 1 of a step depends on the state before it and on the loads at both of its ends, in units of the step:
/// u = u_u·u + u_v·u̇ + u_0·a₀ + u_1·a₁. Other coefficients stay zero.
OscillatorStep make_part_of_step(double theta, double damping, double share);

}  // namespace musim::records::detail
