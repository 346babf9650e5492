#include <algorithm>
#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "cli/commands.hpp"
#include "cli/design_output.hpp"
#include "cli/input_file.hpp"
#include "cli/options.hpp"
#include "cli/output.hpp"
#include "cli/record_source.hpp"
#include "design/parse_design.hpp"
#include "lsdem/scene/material_presets.hpp"
#include "records/error.hpp"

namespace musim::cli {
namespace {

namespace scene = lsdem::scene;

struct DesignOptions {
    std::string file;
    RecordSourceOptions source;
    bool markdown = false;
    bool json = false;
};

/// The measured materials, their face stiffnesses as moduli of the solid.
std::vector<design::Material> make_presets() {
    std::vector<design::Material> materials;
    for (const std::string& name : scene::material_preset_names()) {
        const scene::MaterialPreset& preset = scene::find_material_preset(name);
        const auto& [thin, wide, height] = preset.reference_block;
        materials.push_back({.name = name,
                             .density = preset.material.density,
                             .friction = preset.material.friction,
                             .restitution = preset.material.restitution,
                             .modulus = scaling::Stress(preset.material.normal_stiffness * height / (thin * wide)),
                             .shear_modulus = scaling::Stress(preset.material.shear_stiffness * height / (thin * wide))});
    }
    return materials;
}

/// A file that a design names, as seen from the design's folder.
std::string find_beside(const std::string& design_file, const std::string& named) {
    return (std::filesystem::path(design_file).parent_path() / named).string();
}

std::vector<records::AxisLoad> find_loads(const DesignOptions& options, const design::Design& design) {
    if (design.table_file.empty()) return {};
    const std::string table_file = find_beside(options.file, design.table_file);
    const records::ShakeTable table =
        records::parse_shake_table(read_input_file(table_file, "the limits of a shake table (musim-table/1)"), table_file);
    if (const auto* const peaks = std::get_if<std::vector<design::GivenPeaks>>(&design.motion))
        return make_loads(*peaks, table, options.file);
    const auto& record = std::get<design::RecordFile>(design.motion);
    const std::string source = record.file == "synthetic" ? record.file : find_beside(options.file, record.file);
    return make_loads(options.source.load(source), record, table);
}

int run_design(const DesignOptions& options) {
    const design::Design design =
        design::parse_design(read_input_file(options.file, "a design (musim-design/1)"), options.file, make_presets());
    const std::vector<design::Candidate> candidates = design::find_candidates({design, find_loads(options, design)});
    if (options.json)
        print_json(to_json(design, candidates));
    else
        print("{}", make_design_report(design, candidates, options.markdown ? ReportStyle::markdown : ReportStyle::plain));
    const bool is_feasible = std::any_of(candidates.begin(), candidates.end(), [](const auto& each) { return each.is_feasible(); });
    if (is_feasible) return kDone;
    note("musim: error: {}: nothing is feasible ({}, law {}: {})\n", options.file, candidates.front().material.name,
         to_string(candidates.front().law), candidates.front().problem);
    return kCheckFailed;
}

}  // namespace

void add_design_command(CLI::App& app, Action& action) {
    auto options = std::make_shared<DesignOptions>();
    CLI::App* command = app.add_subcommand("design", "Which length scales, materials and laws a table, a hall and a workshop allow");
    command->add_option("design", options->file, "Prototype, record, table, limits, materials (JSON, musim-design/1; see design/README.md)")
        ->required()
        ->type_name("DESIGN");
    options->source.add_to(*command);
    auto* const markdown = command->add_flag("--markdown", options->markdown, "Write the report in Markdown");
    add_json_option(*command, options->json);
    command->get_option("--json")->excludes(markdown);
    command->footer(
        "Files named in the design are looked for in its folder. Exit code 0: something is feasible; 5: nothing is.\n"
        "Examples:\n"
        "  musim design examples/design/tower.json\n"
        "  musim design examples/design/tower.json --markdown > campaign.md\n"
        "  musim design examples/design/tower.json --json");
    command->callback([&action, options] { action = [options] { return run_design(*options); }; });
}

}  // namespace musim::cli
