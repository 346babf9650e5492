#include "lsdem/scene/measured_material.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <vector>

#include "lsdem/scene/detail/scene_parts.hpp"
#include "lsdem/scene/reference_block.hpp"
#include "lsdem/scene/scene_error.hpp"
#include "lsdem/scene/scene_json.hpp"
#include "scaling/nearest_name.hpp"

namespace musim::lsdem {
namespace {

constexpr const char* kMaterialSchema = "musim-material/1";

/// A scale within this of a preset's is that scale: 1/25 typed as 0.04 is meant. Only chooses a default material.
constexpr double kSameScale = 1e-6;

MeasuredMaterial parse_material_file(const detail::Json& root, const std::string& file) {
    const detail::SceneRules rules;
    const scaling::JsonReader object = detail::to_object({root, rules, file + ": /"}, "material_file");
    const scaling::JsonReader schema = object["schema"];
    if (schema.text() != kMaterialSchema) {
        schema.fail(fmt::format("\"{}\" is not a known format; write \"{}\", or give a scene file", schema.text(), kMaterialSchema));
    }
    MeasuredMaterial measured;
    measured.name = std::filesystem::path(file).stem().string();
    object.read("name", measured.name);
    measured.reference_block = object.get<Triple<scaling::Length>>("block");
    for (const scaling::Length& edge : measured.reference_block) {
        if (!(edge.value() > 0.0)) object["block"].fail("an edge is not longer than zero; give b, w and H of the block");
    }
    const Triple<scaling::Length>& block = measured.reference_block;
    measured.material =
        detail::parse_material(object["material"], detail::FindStiffnessBase({.area = block[0] * block[1], .height = block[2]}));
    return measured;
}

}  // namespace

MeasuredMaterial find_measured_material(const std::string& preset_or_file) {
    const std::vector<std::string> names = material_preset_names();
    if (std::find(names.begin(), names.end(), preset_or_file) != names.end()) {
        return static_cast<const MeasuredMaterial&>(find_material_preset(preset_or_file));
    }
    if (!std::filesystem::exists(preset_or_file)) {
        throw SceneError(
            fmt::format("\"{}\" is neither a known material nor a file{} (presets are {}); name a preset, a material file or a scene",
                        preset_or_file, scaling::hint_at_name(preset_or_file, names), fmt::join(names, ", ")));
    }
    const detail::Json root = detail::parse_json(detail::read_text(preset_or_file), preset_or_file);
    if (!root.is_object() || !root.contains("structure")) return parse_material_file(root, preset_or_file);
    const Scene scene = read_scene(preset_or_file);
    return {.name = scene.name, .material = scene.material, .reference_block = reference_block(scene)};
}

MeasuredMaterial find_material_at(double length) {
    std::vector<std::string> known;
    for (const std::string& name : material_preset_names()) {
        const MaterialPreset& preset = find_material_preset(name);
        if (!preset.length_scale) continue;
        if (std::abs(*preset.length_scale / length - 1.0) < kSameScale) return static_cast<const MeasuredMaterial&>(preset);
        known.push_back(fmt::format("{} at 1:{:.0f}", name, 1.0 / *preset.length_scale));
    }
    throw SceneError(
        fmt::format("no preset was measured at a length factor of {:.6g} (there are {}); name a material", length, fmt::join(known, ", ")));
}

}  // namespace musim::lsdem
