#pragma once

#include <array>

#include "lsdem/run/simulate.hpp"
#include "scaling/laws/similitude.hpp"

namespace musim::lsdem {

/// The exact image of a specimen in other units: every number multiplied by the factor of its dimension.
///
/// Lengths (shapes, height offsets, places) by λ_l, velocities by √(λ_l λ_g), rates (spin, velocity damping, settling) by √(λ_g/λ_l),
/// masses by λ_ρ λ_l³, stiffnesses per area by λ_ρ λ_g, gravity by λ_g, the motion of the base by its times and velocities; what contacts
/// bear, too: energies by λ_ρ λ_l⁴ λ_g, friction by λ_ρ λ_l³ λ_g, tractions by λ_ρ λ_l λ_g, couples by λ_ρ λ_l⁴ λ_g. Angles, ratios,
/// counts, spine and layers stay.
///
/// A scene that is scaled (scale_scene) and built gives the same model, but a specimen that was laid would be laid anew, and come to
/// rest in another way: an image stands and bears as its prototype does. One multiplication a number: where the factors are powers of two
/// (λ_l/λ_g a power of four, λ_ρ of two) it is exact, and the two models are one to the last bit; else each number is off by its own
/// rounding. Its run takes `plan.scaled(similitude.time())`.
///
/// Any law will do that keeps what decides on rest (Similitude::keeps_statics), as `exact` always does; a vertical shaking goes by its own
/// factor. Throws scaling::SimilitudeError for others: friction or stiffness are another part of the weight then.
Specimen scale_specimen(const Specimen& specimen, const scaling::Similitude& similitude);

/// The image of a motion of the base: times by λ_t, velocities by λ_v, vertical ones by λ_v,vertical.
BaseComponents scale_motion(BaseComponents motion, const scaling::Similitude& similitude);

}  // namespace musim::lsdem
