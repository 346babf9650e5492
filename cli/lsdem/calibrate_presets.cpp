#include "cli/lsdem/calibrate_tests.hpp"

#include <memory>
#include <nlohmann/json.hpp>
#include <string>

#include "cli/named_values.hpp"
#include "cli/output.hpp"
#include "lsdem/calibration/wave_speed.hpp"
#include "lsdem/scene/material_presets.hpp"

namespace musim::cli {
namespace {

nlohmann::json make_json(const lsdem::MaterialPreset& preset) {
    const lsdem::BlockSample sample = lsdem::make_sample(preset);
    nlohmann::json object = describe_sample(sample);
    object.erase("ground_friction");
    object["name"] = preset.name;
    object["length_scale"] = or_null(preset.length_scale);
    object["source"] = preset.source;
    object["normal_wave_speed_m_s"] = lsdem::closed_form_speed(sample, lsdem::WaveKind::normal);
    object["shear_wave_speed_m_s"] = lsdem::closed_form_speed(sample, lsdem::WaveKind::shear);
    object["camera_step_s"] = or_null(preset.camera_step ? std::optional(preset.camera_step->value.value()) : std::nullopt);
    object["bar_wave_speed_m_s"] = or_null(in_si(preset.bar_wave_speed));
    return object;
}

int run_presets(bool json) {
    nlohmann::json list = nlohmann::json::array();
    for (const std::string& name : lsdem::material_preset_names()) list.push_back(make_json(lsdem::find_material_preset(name)));
    if (json) {
        print_json({{"presets", list}});
        return kDone;
    }
    for (const std::string& name : lsdem::material_preset_names()) {
        const lsdem::MaterialPreset& preset = lsdem::find_material_preset(name);
        const lsdem::BlockSample s = lsdem::make_sample(preset);
        print("{} ({})\n  block {:.3f} x {:.3f} x {:.3f} mm, {:.5g} kg, {:.5g} kg/m^3\n", name,
              preset.length_scale ? fmt::format("1:{:.4g}", 1.0 / *preset.length_scale) : "stone, as in any block", 1e3 * s.size.x(),
              1e3 * s.size.y(), 1e3 * s.size.z(), s.mass(), s.density);
        print("  k_n {:.5g} MN/m, k_s {:.5g} MN/m (wave speeds {:.1f} and {:.1f} m/s), friction {}, restitution {}\n",
              s.normal_stiffness / kMega, s.shear_stiffness / kMega, lsdem::closed_form_speed(s, lsdem::WaveKind::normal),
              lsdem::closed_form_speed(s, lsdem::WaveKind::shear), s.friction, s.restitution);
        if (preset.bar_wave_speed) print("  bar wave speed of the solid itself: {:.0f} m/s\n", preset.bar_wave_speed->value());
        if (preset.camera_step) {
            print("  camera step {} = {:.6g} us\n", preset.camera_step->fraction, 1e6 * preset.camera_step->value.value());
        }
        print("  source: {}\n", preset.source);
    }
    return kDone;
}

}  // namespace

void add_presets_command(CLI::App& calibrate, Action& action) {
    auto json = std::make_shared<bool>(false);
    CLI::App* command = calibrate.add_subcommand("presets", "The measured materials: numbers, scale, source");
    add_json_option(*command, *json);
    command->footer("Examples:\n  musim calibrate presets\n  musim calibrate presets --json");
    command->callback([&action, json] { action = [json] { return run_presets(*json); }; });
}

}  // namespace musim::cli
