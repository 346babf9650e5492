#include "cli/files.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <map>
#include <optional>
#include <system_error>
#include <utility>

#include "lsdem/scene/material_presets.hpp"
#include "records/error.hpp"
#include "scaling/regular_file.hpp"
#include "scaling/structures/structural_speed.hpp"

namespace musim::cli {
namespace {

namespace fs = std::filesystem;

/// One name for all paths to a file, as write_file_atomically() follows them.
fs::path resolve(const std::string& file) {
    std::error_code error;
    const fs::path path = fs::weakly_canonical(fs::absolute(file, error), error);
    return error ? fs::path(file) : path;
}

}  // namespace

std::string read_input_file(const std::string& file, const std::string& wanted) {
    const std::string obstacle = scaling::find_obstacle(file);
    std::optional<std::string> text = scaling::read_regular_file(file);
    if (!text || text->empty()) {
        throw records::ReadError(file + ": cannot be read (" + (obstacle.empty() ? "empty, or no permission" : obstacle) + "); give " +
                                 wanted);
    }
    return *std::move(text);
}

std::string find_beside(const std::string& naming_file, const std::string& named) {
    return (fs::path(naming_file).parent_path() / named).string();
}

records::ShakeTable read_shake_table(const std::string& file, scaling::UncertainReading* reading) {
    return records::parse_shake_table(read_input_file(file, "the limits of a shake table (musim-table/1)"), file, reading);
}

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

bool can_be_lost(const std::string& file) {
    std::error_code error;
    const fs::file_status status = fs::status(file, error);
    return !file.empty() && (!fs::exists(status) || fs::is_regular_file(status));
}

void refuse_overwriting(const std::vector<std::string>& inputs, const std::vector<std::string>& outputs) {
    std::map<fs::path, std::string> taken;  // what each file is needed for
    for (const std::string& input : inputs) {
        if (can_be_lost(input)) taken.try_emplace(resolve(input), "the input " + input);
    }
    for (const std::string& output : outputs) {
        if (!can_be_lost(output)) continue;
        const auto [place, is_free] = taken.try_emplace(resolve(output), "the output " + output);
        if (!is_free) {
            throw records::WriteError(fmt::format("{}: cannot be written (it is also {}); name another file", output, place->second));
        }
    }
}

}  // namespace musim::cli
