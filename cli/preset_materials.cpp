#include "cli/preset_materials.hpp"

#include <string>

#include "lsdem/scene/material_presets.hpp"
#include "scaling/structures/structural_speed.hpp"

namespace musim::cli {

std::vector<records::Material> make_preset_materials() {
    std::vector<records::Material> materials;
    for (const std::string& name : lsdem::material_preset_names()) {
        const lsdem::MaterialPreset& preset = lsdem::find_material_preset(name);
        const auto& [thin, wide, height] = preset.reference_block;
        const scaling::Area face = thin * wide;
        materials.push_back({.name = name,
                             .density = preset.material.density,
                             .friction = preset.material.friction,
                             .restitution = preset.material.restitution,
                             .modulus = scaling::find_effective_modulus(preset.material.normal_stiffness, height, face),
                             .shear_modulus = scaling::find_effective_modulus(preset.material.shear_stiffness, height, face)});
    }
    return materials;
}

}  // namespace musim::cli
