#include "scaling/structures/structural_speed.hpp"

#include "scaling/laws/groups.hpp"

namespace musim::scaling {

Stress find_effective_modulus(Stiffness face_stiffness, Length block_height, Area face) {
    return Stress(face_stiffness * block_height / face);
}

Velocity find_slip_front_speed(Velocity shear_speed) { return 0.5 * shear_speed; }

StructuralSpeeds find_structural_speeds(const StructureFacts& facts) {
    const Length block_height = facts.block[2];
    StructuralSpeeds speeds;
    if (facts.normal_stiffness) {
        speeds.normal = groups::stack_wave_speed(block_height, *facts.normal_stiffness, facts.block_mass());
        speeds.modulus = find_effective_modulus(*facts.normal_stiffness, block_height, facts.face());
    }
    if (facts.shear_stiffness) {
        speeds.shear = groups::stack_wave_speed(block_height, *facts.shear_stiffness, facts.block_mass());
        speeds.shear_modulus = find_effective_modulus(*facts.shear_stiffness, block_height, facts.face());
        speeds.slip_front = find_slip_front_speed(*speeds.shear);
        speeds.number = groups::structural_speed_number(*facts.shear_stiffness, block_height, facts.layers, facts.friction,
                                                        facts.block_mass(), facts.gravity);
        speeds.climb_stick = facts.height() / *speeds.shear;
        speeds.climb_slip = facts.height() / *speeds.slip_front;
    }
    return speeds;
}

std::optional<RotatingChain> find_rotating_chain(const StructureFacts& facts, Direction direction) {
    if (!facts.normal_stiffness || !facts.shear_stiffness) return std::nullopt;
    return RotatingChain{.slenderness = facts.rocking_block(direction).slenderness(),
                         .stiffness_ratio = *facts.normal_stiffness / *facts.shear_stiffness};
}

}  // namespace musim::scaling
