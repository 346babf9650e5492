#include "lsdem/scene/material_presets.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "lsdem/scene/scene_error.hpp"
#include "scaling/nearest_name.hpp"

namespace musim::lsdem {

namespace {

constexpr double kMega = 1e6;
constexpr std::string_view kTable3 = "Harmon et al. 2023, Table 3";

/// Block of the prototype tower [Harmon23]: 1.36 x 2.82 x 4.25 m, divided by the scale.
Triple<scaling::Length> reference_block(double divisor) {
    return {1.36 / divisor * scaling::si::meter, 2.82 / divisor * scaling::si::meter, 4.25 / divisor * scaling::si::meter};
}

/// `density` [kg/m³], stiffnesses [MN/m].
BlockMaterial make_material(double density, double normal, double shear, double friction, double restitution) {
    return {.density = scaling::Density::from_value(density),
            .normal_stiffness = scaling::Stiffness::from_value(normal * kMega),
            .shear_stiffness = scaling::Stiffness::from_value(shear * kMega),
            .friction = friction,
            .restitution = restitution};
}

/// Elasticity and contact of a sound stone.
struct Stone {
    const char* name;
    double density;         ///< [kg/m³]
    double youngs_modulus;  ///< E [Pa]
    double poissons_ratio;  ///< ν [-]
    double friction;        ///< tangent of the basic friction angle [-]
    std::string_view source;
};

/// Restitution of stones: that of the papers' concrete. For faces of stone that meet flat none was found [-].
constexpr double kStoneRestitution = 0.5;

/// Stone as a preset, for the prototype's block:  k_n = E·A/H,  k_s = G·A/H,  G = E/(2(1 + ν)).
MaterialPreset make_stone(const Stone& stone) {
    const auto block = reference_block(1.0);
    const double to_face = (block[0] * block[1] / block[2]).value();  // A/H [m]
    const double normal = stone.youngs_modulus * to_face, shear = normal / (2.0 * (1.0 + stone.poissons_ratio));
    return {{stone.name, make_material(stone.density, normal / kMega, shear / kMega, stone.friction, kStoneRestitution), block},
            {},
            stone.source,
            {},
            scaling::Velocity::from_value(std::sqrt(stone.youngs_modulus / stone.density))};
}

const std::vector<MaterialPreset>& presets() {
    static const std::vector<MaterialPreset> kPresets = [] {
        const BlockMaterial wave = make_material(2632.0, 510.0, 480.0, 0.18, 0.5);
        const std::string_view wave_source =
            "Harmon et al. 2023, Table 3, with ten times the printed stiffness, which the measured bar wave speed and the printed time "
            "step ask for";
        // periods of the cameras over the printed numbers of steps per picture
        const CameraStep wood_step{1.0 / (4800.0 * 20.0) * scaling::si::seconds, "1/96000 s"};
        const CameraStep aluminium_step{1.0 / (4800.0 * 80.0) * scaling::si::seconds, "1/384000 s"};
        const CameraStep concrete_step{1.0 / (2000.0 * 34.0) * scaling::si::seconds, "1/68000 s"};
        // E = 69 GPa of aluminium alloys, with the density of Table 3
        const scaling::Velocity aluminium_bar = scaling::Velocity::from_value(std::sqrt(69e9 / 2632.0));
        const auto small = reference_block(107.0);
        return std::vector<MaterialPreset>{
            {{"wood", make_material(800.0, 30.0, 26.0, 0.63, 0.3), small}, 1.0 / 107.0, kTable3, wood_step, {}},
            {{"concrete", make_material(2320.0, 1050.0, 1000.0, 0.59, 0.5), reference_block(25.0)}, 1.0 / 25.0, kTable3, concrete_step, {}},
            {{"aluminium", wave, small}, 1.0 / 107.0, wave_source, aluminium_step, aluminium_bar},
            {{"al_wave", wave, small}, 1.0 / 107.0, wave_source, aluminium_step, aluminium_bar},
            {{"al_printed", make_material(2632.0, 51.0, 48.0, 0.18, 0.5), small}, 1.0 / 107.0, kTable3, aluminium_step, aluminium_bar},
            // tan 33° and tan 34°, in the middle of 31 to 35° and of 31 to 37°; for marble no angle is in that table
            make_stone({"granite", 2650.0, 58.6e9, 0.26, 0.65,
                        "density Goodman 1989, elasticity Wyllie 1999, friction Barton and Choubey 1977, restitution assumed"}),
            make_stone({"limestone", 2700.0, 53.9e9, 0.32, 0.67,
                        "density Goodman 1989, elasticity Wyllie 1999, friction Barton and Choubey 1977, restitution assumed"}),
            make_stone({"marble", 2750.0, 55.8e9, 0.25, 0.67,
                        "density and elasticity Goodman 1989, friction that of limestone, restitution assumed"}),
        };
    }();
    return kPresets;
}

}  // namespace

const MaterialPreset& find_material_preset(std::string_view name) {
    const auto found = std::find_if(presets().begin(), presets().end(), [&](const MaterialPreset& preset) { return preset.name == name; });
    if (found == presets().end()) {
        throw SceneError(fmt::format("\"{}\" is not a known material{} (presets are {}); use one of them or give the properties", name,
                                     scaling::hint_at_name(name, material_preset_names()), fmt::join(material_preset_names(), ", ")));
    }
    return *found;
}

std::vector<std::string> material_preset_names() {
    std::vector<std::string> names;
    for (const MaterialPreset& preset : presets()) names.emplace_back(preset.name);
    return names;
}

BlockMaterial fit_to_block(const MeasuredMaterial& measured, const Triple<scaling::Length>& block) {
    const auto area_over_height = [](const Triple<scaling::Length>& size) { return size[0] * size[1] / size[2]; };
    const double ratio = area_over_height(block) / area_over_height(measured.reference_block);
    BlockMaterial material = measured.material;
    material.normal_stiffness *= ratio;
    material.shear_stiffness *= ratio;
    return material;
}

}  // namespace musim::lsdem
