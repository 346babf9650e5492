#pragma once

namespace musim::lsdem {

/// Response of a rigid block on a base that is pushed once by a(t) = A·sin(πt/T), 0 ≤ t ≤ T, and then keeps its velocity; numbers only.

/// Slip of a block with a/(μg) = `strength` at the peak of the push [Newmark65]. docs/validation/similitude.md has the formulas.
struct PushedSlider {
    double slip = 0.0;  ///< greatest distance behind the base, over A·T² [-]
    double end = 0.0;   ///< when it stops to slip, over T [-]
};

/// Throws std::invalid_argument when the block would stop before the push ends, below a strength of about 1.38.
PushedSlider compute_pushed_slider(double strength);

/// Greatest tilt over the slenderness angle α of a slender block that rocks [Housner63, linearized], strength s = a/(g·tan α) at the
/// peak and rate w = π/(T·p), p² = 3g/(4R). 0 for s ≤ 1, where it never lifts; 1 when it overturns. Throws std::invalid_argument when the
/// block turns back before the push ends.
double compute_pushed_tilt(double strength, double rate);

/// The same of a block on an elastic base [ShentonJones91, for its equation]: it stands on a strip c of its width b, on which pressure
/// grows evenly to the edge, so that its weight acts c/3 inside of it. With φ = θ/α, time in 1/p and e = m g/(k_n b α):
///
///     φ'' = φ + s sin(wt) − r(φ),      r = 1 − (2/3) c/b,  c/b = √(2e/φ)  once it has lifted,  φ > 2e,  and φ/(6e) before
///
/// by Verlet's method in a fiftieth of 1/ω, ω² = 1/(6e). `sinking`: e, above zero.
double compute_soft_tilt(double strength, double rate, double sinking);

}  // namespace musim::lsdem
