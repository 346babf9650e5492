#pragma once

#include <string_view>

#include "scaling/units.hpp"

namespace musim::scaling {

/// A rigid rectangular block that rocks about the edges of its base in one vertical plane [Housner63]. Sizes are above zero.
struct RockingBlock {
    Length width{};   ///< along the shaking: b or w
    Length height{};  ///< H

    /// tan α = width/height [-].
    double slenderness() const;

    /// α between diagonal and height [rad].
    double angle() const;

    /// R = √(width² + height²)/2.
    Length half_diagonal() const;

    /// p = √(3 g/(4 R)) [1/s]: θ'' = −p² [sin(α sgn θ − θ) + (a/g) cos(α sgn θ − θ)].
    Frequency frequency_parameter(Acceleration gravity) const;

    /// e_r = 1 − 1.5 sin²α: angular velocity after over before an impact without bounce [-]; below 0 for blocks too stocky to go on
    /// rocking.
    double angular_restitution() const;

    /// r = e_r²: the same of the kinetic energy [-].
    double energy_restitution() const;
};

/// Response of a rigid block at rest to a base acceleration a [Shenton96].
enum class FirstMotion { rest, slide, rock, slide_rock };

/// "rests", "slides", "rocks" or "slides and rocks".
std::string_view to_string(FirstMotion motion);

/// Friction that a block needs at the start of rocking under a base acceleration a ≥ g tan α, lest it slide as well [-].
///
/// About its edge, I θ'' = m a H/2 − m g width/2 with I = (4/3) m R². Base force over weight then gives, with A = a/g,
///
///   μ = (A − q)/(1 + q tan α),   q = (3/4) cos²α (A − tan α),
///
/// which is tan α at A = tan α and rises with A. Source: derived; the criterion is that of [Shenton96].
double find_friction_to_rock(double acceleration_over_gravity, double slenderness);

/// First motion of a block under a = A g, without vertical shaking, of friction coefficient μ (static and kinetic alike) [Shenton96]:
///
///   rests up to min(μ, tan α);   slides when μ ≤ tan α;   else rocks, and slides as well where μ is below find_friction_to_rock().
FirstMotion find_first_motion(double acceleration_over_gravity, double friction, double slenderness);

}  // namespace musim::scaling
