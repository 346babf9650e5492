#include "cli/lsdem/calibrate_tests.hpp"

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "cli/options.hpp"
#include "cli/usage.hpp"
#include "lsdem/scene/material_presets.hpp"
#include "scaling/unlikely.hpp"

namespace musim::cli {

void SampleOptions::add_to(CLI::App& command) {
    command.add_option("--material", material, "Preset for block and contacts (`musim calibrate presets` lists them)")
        ->required()
        ->type_name("PRESET")
        ->check(one_of(lsdem::material_preset_names()));
    add_positive_option(command, "--block", block, "Edge lengths b w H [m], instead of the preset's; its stiffnesses are fitted to them")
        ->expected(3);
    add_positive_option(command, "--density", density, "Density [kg/m^3], instead of the preset's");
    add_positive_option(command, "--normal-stiffness", normal_stiffness, "k_n of a whole face [N/m], instead of the preset's");
    add_number_option(command, "--shear-stiffness", shear_stiffness, "k_s of a whole face [N/m], instead of the preset's")
        ->check(not_negative());
    add_number_option(command, "--friction", friction, "Friction coefficient, instead of the preset's")->check(not_negative());
    add_number_option(command, "--ground-friction", ground_friction,
                      "Friction coefficient of block on ground (default: that of block on block)")
        ->check(not_negative());
    add_positive_option(command, "--restitution", restitution, "Coefficient of restitution, instead of the preset's")
        ->check(between(0.0, 1.0));
}

lsdem::BlockSample SampleOptions::sample() const {
    lsdem::MaterialPreset preset = lsdem::find_material_preset(material);
    if (!block.empty()) {
        const lsdem::Triple<scaling::Length> size{block[0] * scaling::si::meter, block[1] * scaling::si::meter,
                                                  block[2] * scaling::si::meter};
        preset.material = lsdem::fit_to_block(preset, size);
        preset.reference_block = size;
    }
    lsdem::BlockSample sample = lsdem::make_sample(preset);
    if (density) sample.density = *density;
    if (normal_stiffness) sample.normal_stiffness = *normal_stiffness;
    if (shear_stiffness) sample.shear_stiffness = *shear_stiffness;
    if (friction) sample.friction = sample.ground_friction = *friction;
    if (ground_friction) sample.ground_friction = *ground_friction;
    if (restitution) sample.restitution = *restitution;
    note_unlikely("--density", scaling::describe_unlikely_density(scaling::Density::from_value(sample.density)));
    note_unlikely("--friction", scaling::describe_unlikely_friction(sample.friction));
    if (ground_friction) note_unlikely("--ground-friction", scaling::describe_unlikely_friction(sample.ground_friction));
    lsdem::make_model(sample);  // refuses what cannot be
    return sample;
}

void TestOptions::add_to(CLI::App& app, const char* files) {
    sample.add_to(app);
    add_out(app, std::string("Directory for ") + files);
    ResultOptions::add_to(app);
}

nlohmann::json describe_sample(const lsdem::BlockSample& sample) {
    return {{"block_m", {sample.size.x(), sample.size.y(), sample.size.z()}},
            {"mass_kg", sample.mass()},
            {"density_kg_m3", sample.density},
            {"normal_stiffness_n_m", sample.normal_stiffness},
            {"shear_stiffness_n_m", sample.shear_stiffness},
            {"friction", sample.friction},
            {"ground_friction", sample.ground_friction},
            {"restitution", sample.restitution}};
}

void add_calibrate_command(CLI::App& app, Action& action) {
    CLI::App* calibrate = app.add_subcommand("calibrate", "Contact parameters from tests on single blocks");
    calibrate->require_subcommand(1);
    add_stiffness_command(*calibrate, action);
    add_friction_command(*calibrate, action);
    add_restitution_command(*calibrate, action);
    add_presets_command(*calibrate, action);
    group_commands(*calibrate, "Test a block", {"stiffness", "friction", "restitution"});
    group_commands(*calibrate, "Look up a measured material", {"presets"});
}

}  // namespace musim::cli
