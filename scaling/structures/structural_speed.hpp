#pragma once

#include <optional>

#include "scaling/structures/rotating_chain.hpp"
#include "scaling/structures/structure_properties.hpp"

namespace musim::scaling {

/// Effective modulus of the solid behind a face spring, E_eff = k_n H/A and G_eff = k_s H/A (derived).
Stress find_effective_modulus(Stiffness face_stiffness, Length block_height, Area face);

/// Speed at which curves of equal velocity climb a tower whose interfaces slip: c_e/2 (derived).
///
/// Strength falls linearly to the top, τ_y = μ ρ g (l − z), and the base outruns it, v_b > μ g (t + l/c_e). Behind the front z = c_e t
/// the long-wave solution is v(z, t) = μ g (t + (l − 2z)/c_e).
Velocity find_slip_front_speed(Velocity shear_speed);

/// Speeds at which motion climbs a structure, as far as its stiffnesses are known; docs/theory/structural_response.md.
struct StructuralSpeeds {
    std::optional<Velocity> normal = {};       ///< c_n = H √(k_n/m), vertical waves
    std::optional<Velocity> shear = {};        ///< c_e = H √(k_s/m), interfaces stick: the elastic structural speed
    std::optional<Velocity> slip_front = {};   ///< c_e/2, interfaces slip
    std::optional<Stress> modulus = {};        ///< E_eff
    std::optional<Stress> shear_modulus = {};  ///< G_eff
    std::optional<double> number = {};         ///< S_e^N = c_e/√(μ g l)
    std::optional<Time> climb_stick = {};      ///< l/c_e, base to top
    std::optional<Time> climb_slip = {};       ///< 2 l/c_e
};

/// Speeds of one structure.
StructuralSpeeds find_structural_speeds(const StructureProperties& properties);

/// A single column of the structure's blocks that turn as they sway in one direction; nothing unless both stiffnesses are known.
std::optional<RotatingChain> find_rotating_chain(const StructureProperties& properties, Direction direction);

}  // namespace musim::scaling
