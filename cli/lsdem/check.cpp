#include <CLI/CLI.hpp>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "cli/commands.hpp"
#include "cli/files.hpp"
#include "cli/options.hpp"
#include "cli/output.hpp"
#include "cli/report.hpp"
#include "lsdem/plot/picture_file.hpp"
#include "lsdem/run/scene_summary.hpp"
#include "lsdem/scene/scene_json.hpp"
#include "lsdem/study/scene_preview.hpp"

namespace musim::cli {
namespace {

struct CheckOptions {
    std::string scene;
    std::string out;
    bool no_timing = false;
    int threads = 0;
    bool json = false;
};

int run_check(const CheckOptions& options) {
    refuse_overwriting({options.scene}, {options.out});
    if (!options.out.empty()) read_option("--out", [&] { lsdem::require_picture_name(options.out); });
    const lsdem::Scene scene = lsdem::read_scene(options.scene);
    note_reading(scene);
    const lsdem::SceneSummary summary = lsdem::summarize_scene(scene);
    std::optional<lsdem::RunTimeEstimate> run_time;
    if (!options.no_timing) run_time = lsdem::measure_run_time(summary, options.threads);
    if (!options.out.empty()) lsdem::write_picture(options.out, lsdem::make_preview_svg(summary));
    for (const std::string& warning : summary.warnings) note("musim: warning: {}\n", warning);
    if (options.json) {
        print_json(lsdem::to_json(summary, run_time));
        return kDone;
    }
    print("{}: {}\n", options.scene, scene.name);
    for (const std::string& line : lsdem::describe(summary, run_time)) print("  {}\n", line);
    if (!options.out.empty()) print("Preview in {}\n", options.out);
    return kDone;
}

}  // namespace

void add_check_command(CLI::App& app, Action& action) {
    auto options = std::make_shared<CheckOptions>();
    CLI::App* command = app.add_subcommand("check", "What a scene means, before it is run: blocks, motion, step, estimates, preview");
    command->add_option("scene", options->scene, "Scene file (JSON, schema musim-scene/1)")->required()->type_name("SCENE.json");
    command->add_option("-o,--out", options->out, "Picture of the structure and of the base motion: .svg, or .png, .pdf with librsvg")
        ->type_name("FILE");
    command->add_flag("--no-timing", options->no_timing, "Do not measure how long a run will take");
    add_threads_option(*command, options->threads);
    add_json_option(*command, options->json);
    command->footer(
        "Examples:\n"
        "  musim check examples/wall.json\n"
        "  musim check tower.json -o preview.svg\n"
        "  musim check examples/aftershocks.json --no-timing --json\n"
        "Estimates are closed forms of rigid blocks, with their formulas; the run time is that of some steps of the very model, taken for "
        "about a\nsecond, and holds for this machine at its present load. Exit code 3: the scene cannot be run; the line says why.");
    command->callback([&action, options] { action = [options] { return run_check(*options); }; });
}

}  // namespace musim::cli
