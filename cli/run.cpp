#include "lsdem/study/run.hpp"

#include <CLI/CLI.hpp>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "cli/commands.hpp"
#include "cli/options.hpp"
#include "cli/output.hpp"
#include "cli/progress_line.hpp"
#include "cli/report.hpp"
#include "cli/version.hpp"
#include "lsdem/scene/scene_json.hpp"
#include "lsdem/study/write_results.hpp"

namespace musim::cli {
namespace {

namespace scene = lsdem::scene;

struct RunOptions {
    std::string scene;
    std::string out;
    std::optional<Number> duration;
    int threads = 0;
    bool json = false;
};

void print_run(const scene::Scene& scene, const study::RunResult& run) {
    print("{}: {}\n", scene.name, study::to_string(run.status));
    print("  {} blocks, {} steps of {:.6g} s, {:.6g} s simulated in {:.2f} s\n", run.blocks.mass.size(), run.steps, run.time_step,
          run.final.time, run.wall_time);
    print("  {} contact nodes, largest overlap {:.3g} of a block height\n", run.statistics.contact_nodes,
          run.statistics.max_overlap_over_height);
    print("  energy balance closes to {:.3g}", run.energy_closure);
    if (run.base_reaction_over_weight) print(", base reaction {:.6f} of the weight at the end", *run.base_reaction_over_weight);
    print("\n  state hash {}\n", run.state_hash);
    if (run.collapse_time) print("  collapsed at {:.4g} s\n", *run.collapse_time);
}

int run_run(const RunOptions& options) {
    scene::Scene scene = scene::read_scene(options.scene);
    if (options.duration) scene.time.duration = options.duration->value * scaling::si::seconds;
    scene::check_scene(scene, options.scene);

    // the folder first: better no run than one without a place for its results
    std::optional<study::ResultFolder> folder;
    if (!options.out.empty()) folder.emplace(options.out);
    study::RunResult run;
    {
        ProgressLine progress(scene.name);
        run = study::run_scene(scene, {.threads = options.threads, .on_progress = [&](double fraction) { progress.update(fraction); }});
    }
    if (folder) {
        folder->add_run("", run, {.scene = scene::write_scene(scene), .similitude = {}, .program_version = kVersion});
        folder->commit();
    }

    if (options.json) {
        print_json(study::make_summary(run));
    } else {
        print_run(scene, run);
        if (folder) print("Results in {}\n", options.out);
    }
    report_doubts(options.scene, run);
    return report_divergence(options.scene, run) ? kNumericalFailure : kDone;
}

}  // namespace

void add_run_command(CLI::App& app, Action& action) {
    auto options = std::make_shared<RunOptions>();
    CLI::App* command = app.add_subcommand("run", "One simulation of a scene");
    command->add_option("scene", options->scene, "Scene file (JSON, schema musim-scene/1)")->required()->type_name("SCENE.json");
    command->add_option("-o,--out", options->out, "Directory for result.h5, result.xdmf, spine.csv and summary.json")->type_name("DIR");
    command->add_option("--duration", options->duration, "Simulated time [s], instead of the scene's")->type_name("NUMBER");
    add_threads_option(*command, options->threads);
    add_json_option(*command, options->json);
    command->footer(
        "Examples:\n"
        "  musim run examples/tower_prototype.json -o out/tower\n"
        "  musim run examples/tower_prototype.json --duration 1/2 --threads 1 --json\n"
        "Exit code 4: the run diverged; results up to then are written all the same. A doubtful run (step above the critical one, blocks "
        "deep\n"
        "in each other, open energy balance) is a warning on stderr.");
    command->callback([&action, options] { action = [options] { return run_run(*options); }; });
}

}  // namespace musim::cli
