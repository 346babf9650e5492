#pragma once

#include <array>
#include <compare>
#include <cstddef>
#include <numbers>
#include <span>

#include "scaling/units.hpp"

/// Responses of an oscillator between the samples of its base's motion, which is linear there.
///
/// A step is parted into substeps so short that the slowest and fastest part of the free motion turns by at most 1/4 rad in one. There the
/// response is the cubic with its values and slopes at both ends, to (1/4)⁴/384 = 1e-5 of the free motion; forced motion under a linear
/// load is linear, which a cubic meets exactly.
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

/// Dependence of u after the share 0 < s ≤ 1 of a step on the state before it and on the loads at both of its ends, in units of the step:
/// u = u_u·u + u_v·u̇ + u_0·a₀ + u_1·a₁. Other coefficients stay zero.
OscillatorStep make_part_of_step(double theta, double damping, double share);

/// Parts of an oscillator's steps.
struct Substeps {
    std::size_t count = 1;  ///< in a step, a power of two
    bool fine = true;       ///< short enough for the cubic; false only for periods below 1/40 of the step, see kMostSubsteps

    auto operator<=>(const Substeps&) const = default;
};

/// So many substeps at most. An oscillator that would need more (2π·dt/T > 64) stays within 2/64 of its static response between the
/// samples.
inline constexpr std::size_t kMostSubsteps = 256;

/// `theta` = ω·dt > 0, `damping` ζ ≥ 0, both finite.
Substeps find_substeps(double theta, double damping);

/// f on a substep: its values and slopes, per substep, at both ends.
struct Cubic {
    double value0 = 0.0, slope0 = 0.0, value1 = 0.0, slope1 = 0.0;

    double at(double share) const;

    /// Where it has its extremes, as shares of the substep above 0 up to 1; −1 stands for none.
    std::array<double, 2> find_extremes() const;

    /// Largest |f| at its extremes, 0 without one.
    double find_peak() const;
};

/// Goes through a motion substep by substep, from rest at its first sample.
class OscillatorWalk {
  public:
    OscillatorWalk(std::span<const double> samples, double theta, double damping);

    const Substeps& substeps() const { return substeps_; }

    /// Goes on by one substep; false at the end of the motion.
    bool next();

    /// The step that the current substep lies in, from 0, and the substep in it.
    std::size_t step() const { return step_; }
    std::size_t substep() const { return substep_; }

    /// u during the current substep, in units of the step, u/dt².
    Cubic displacement() const;

  private:
    std::span<const double> samples_;
    Substeps substeps_;
    OscillatorStep part_;
    double unit_ = 1.0;  ///< dt_substep²/dt²
    std::size_t step_ = 0, substep_ = 0, next_ = 0;
    double u_ = 0.0, v_ = 0.0, before_u_ = 0.0, before_v_ = 0.0;
};

}  // namespace musim::records::detail
