#include <algorithm>
#include <CLI/CLI.hpp>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "cli/commands.hpp"
#include "cli/design_output.hpp"
#include "cli/input_file.hpp"
#include "cli/options.hpp"
#include "cli/output.hpp"
#include "cli/preset_materials.hpp"
#include "cli/record_source.hpp"
#include "design/parse_design.hpp"
#include "records/error.hpp"

namespace musim::cli {
namespace {

struct DesignOptions {
    std::string file;
    RecordSourceOptions source;
    scaling::ReportStyle style = scaling::ReportStyle::plain;
    bool json = false;
};

std::vector<records::AxisLoad> find_loads(const DesignOptions& options, const design::Design& design) {
    if (design.table_file.empty()) return {};
    const records::ShakeTable table = read_shake_table(find_beside(options.file, design.table_file));
    if (const auto* const peaks = std::get_if<std::vector<design::GivenPeaks>>(&design.motion))
        return make_loads(*peaks, table, options.file);
    const auto& record = std::get<design::RecordFile>(design.motion);
    return make_loads(options.source.load_beside(options.file, record.file), record, table);
}

int run_design(const DesignOptions& options) {
    const design::Design design =
        design::parse_design(read_input_file(options.file, "a design (musim-design/1)"), options.file, make_preset_materials());
    const std::vector<design::Candidate> candidates = design::find_candidates({design, find_loads(options, design)});
    if (options.json)
        print_json(to_json(design, candidates));
    else
        print("{}", make_design_report(design, candidates, options.style));
    const bool is_feasible = std::any_of(candidates.begin(), candidates.end(), [](const auto& each) { return each.is_feasible(); });
    if (is_feasible) return kDone;
    note("musim: error: {}: nothing is feasible ({}, law {}: {})\n", options.file, candidates.front().material.name,
         candidates.front().law.name(), candidates.front().problem);
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
    CLI::Option* const format = add_format_option(*command, options->style, "Form of the report");
    add_json_option(*command, options->json);
    command->get_option("--json")->excludes(format);
    command->footer(
        "Files named in the design are looked for in its folder. Exit code 0: something is feasible; 5: nothing is.\n"
        "Examples:\n"
        "  musim design examples/design/tower.json\n"
        "  musim design examples/design/laws.json\n"
        "  musim design examples/design/tower.json --format markdown > campaign.md\n"
        "  musim design examples/design/tower.json --json");
    command->callback([&action, options] { action = [options] { return run_design(*options); }; });
}

}  // namespace musim::cli
