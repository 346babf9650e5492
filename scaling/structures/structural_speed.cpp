#include "scaling/structures/structural_speed.hpp"

#include "scaling/laws/groups.hpp"

namespace musim::scaling {

Stress find_effective_modulus(Stiffness face_stiffness, Length block_height, Area face) {
    return Stress(face_stiffness * block_height / face);
}

Velocity find_slip_front_speed(Velocity shear_speed) { return 0.5 * shear_speed; }

StructuralSpeeds find_structural_speeds(const StructureProperties& properties) {
    const Length block_height = properties.block[2];
    StructuralSpeeds speeds;
    if (properties.normal_stiffness) {
        speeds.normal = groups::stack_wave_speed(block_height, *properties.normal_stiffness, properties.block_mass());
        speeds.modulus = find_effective_modulus(*properties.normal_stiffness, block_height, properties.face());
    }
    if (properties.shear_stiffness) {
        speeds.shear = groups::stack_wave_speed(block_height, *properties.shear_stiffness, properties.block_mass());
        speeds.shear_modulus = find_effective_modulus(*properties.shear_stiffness, block_height, properties.face());
        speeds.slip_front = find_slip_front_speed(*speeds.shear);
        speeds.number = groups::structural_speed_number(*properties.shear_stiffness, block_height, properties.layers, properties.friction,
                                                        properties.block_mass(), properties.gravity);
        speeds.climb_stick = properties.height() / *speeds.shear;
        speeds.climb_slip = properties.height() / *speeds.slip_front;
    }
    return speeds;
}

std::optional<RotatingChain> find_rotating_chain(const StructureProperties& properties, Direction direction) {
    if (!properties.normal_stiffness || !properties.shear_stiffness) return std::nullopt;
    return RotatingChain{.slenderness = properties.rocking_block(direction).slenderness(),
                         .stiffness_ratio = *properties.normal_stiffness / *properties.shear_stiffness};
}

}  // namespace musim::scaling
