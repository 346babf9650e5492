#pragma once

#include <functional>
#include <string>
#include <vector>

#include "tests/benches/accuracy_setting.hpp"

namespace musim::lsdem {

/// A problem with a known answer, run with any setting.
struct AccuracyCase {
    std::string name;   ///< one word, for tables
    std::string title;  ///< for people
    std::function<AccuracyOutcome(const AccuracySetting&)> run;
};

/// Time in which a rigid body falls from the tilt `start` to upright [s]:  θ̈ = −p² sin(α − θ)  from rest, by quadrature  [Housner63].
/// `alpha`: slenderness angle of the pivot, `p`: frequency parameter [1/s]. 0 < start < alpha.
double compute_quarter_period(double alpha, double p, double start);

/// Velocity of block n of a semi-infinite chain over the velocity V that its base takes on at once, at the time ω0·t = `time`:
///   v_n/V = 2n ∫ J_2n(u)/u du, u = 0 ... 2ω0t   [Schroedinger14], by quadrature.
double compute_front(int n, double time);

/// Greatest displacement of a block relative to its base [m] under a base acceleration `a` [m/s²] that lasts for `duration` [s]: its
/// friction spring of circular frequency `omega` [1/s] holds up to the acceleration `limit` = μg, then it slips [Newmark65 for a rigid
/// spring]. Needs a > 2·limit/π or so, that the slip begins at the first loading and lasts to the end of the pulse.
double compute_pulse_slip(double a, double duration, double limit, double omega);

/// One block of wood at 1:107 unless said:
/// - slide: lying, rotation locked, 1 g for 50 ms; error of the greatest slip against compute_pulse_slip
/// - rock_ground: falls from half its slenderness on the ground; error of the time to upright
/// - rock_own_edge: the same on the face of a larger fixed block, its edge a quarter, a half and three quarters between two nodes of it:
///   the worst of the three
/// - rock_other_edge: rocks about the edge of a fixed block below, 0.3 of its width from its middle
/// - lean: upright under gravity turned by a third of what would lift an edge; error of the tilt against M/k_θ, k_θ = k_n b²/12
/// - wave: column of 60, step of the base velocity; largest error of v/V at the arrival n/ω0 in blocks 5, 10, 20, 30
/// - settle: column of 20 let go; error of the sinking of its top, (m g/k) n(n + 1)/2
/// - bounce: falls flat at 5 cm/s; error of the coefficient of restitution, 0.3
/// Errors are relative. A run that does not get there has an infinite one.
std::vector<AccuracyCase> make_closed_form_cases();

}  // namespace musim::lsdem
