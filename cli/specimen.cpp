#include <algorithm>
#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <numbers>
#include <string>
#include <vector>

#include "cli/commands.hpp"
#include "cli/options.hpp"
#include "cli/output.hpp"
#include "cli/progress_line.hpp"
#include "cli/report.hpp"
#include "cli/specimen_batch.hpp"
#include "lsdem/scene/scene_json.hpp"

namespace musim::cli {
namespace {

namespace scene = lsdem::scene;

constexpr double kDegrees = 180.0 / std::numbers::pi;

struct SpecimenOptions {
    std::string scene;
    std::string out = ".";
    std::string placing;
    int seeds = 1;
    Number checkpoint_interval{60.0};
    int threads = 0;
    bool json = false;
};

double largest_tilt(const study::PreparedSpecimen& prepared) {
    double largest = 0.0;
    for (const study::LayerState& layer : prepared.layers) largest = std::max(largest, layer.max_tilt);
    return largest;
}

nlohmann::json describe(const study::SpecimenReport& report) {
    nlohmann::json object{{"file", report.file.string()}, {"seed", report.seed},     {"reused", report.reused},
                          {"resumed", report.resumed},    {"blocks", report.blocks}, {"fallen", report.fallen}};
    if (report.reused) return object;
    const study::PreparedSpecimen& prepared = report.prepared;
    nlohmann::json layers = nlohmann::json::array();
    for (const study::LayerState& layer : prepared.layers) {
        layers.push_back({{"mean_tilt_deg", layer.mean_tilt * kDegrees},
                          {"max_tilt_deg", layer.max_tilt * kDegrees},
                          {"mean_force_N", layer.mean_force},
                          {"sd_force_N", layer.sd_force}});
    }
    object.update({{"at_rest", prepared.rest.at_rest},
                   {"base_reaction_over_weight", prepared.rest.reaction_over_weight},
                   {"kinetic_over_weight_height", prepared.rest.kinetic},
                   {"steps", prepared.steps},
                   {"block_steps", prepared.block_steps},
                   {"max_overlap_over_height", prepared.max_overlap},
                   {"wall_s", report.wall_time},
                   {"layers", layers}});
    return object;
}

void print_report(const study::SpecimenReport& report) {
    if (report.reused) {
        print("{}: seed {}, {} blocks, made before from the same inputs\n", report.file.string(), report.seed, report.blocks);
        return;
    }
    const study::PreparedSpecimen& prepared = report.prepared;
    print("{}: seed {}, {} blocks{}\n", report.file.string(), report.seed, report.blocks,
          report.resumed ? ", gone on with from a checkpoint" : "");
    print("  {} after {} steps in {:.2f} s; base reaction {:.6f} of the weight, largest tilt {:.3g} degrees, overlap {:.3g} of a height\n",
          prepared.rest.at_rest ? "at rest" : "NOT at rest", prepared.steps, report.wall_time, prepared.rest.reaction_over_weight,
          largest_tilt(prepared) * kDegrees, prepared.max_overlap);
}

int run_specimen(const SpecimenOptions& options) {
    study::SpecimenBatch batch = begin_batch(options.out, options.threads, options.checkpoint_interval);
    batch.scene = scene::read_scene(options.scene);
    if (!options.placing.empty()) {
        const auto& names = scene::placing_names();
        if (!batch.scene.preparation) batch.scene.preparation.emplace();
        batch.scene.preparation->placing =
            static_cast<scene::Placing>(std::find(names.begin(), names.end(), options.placing) - names.begin());
        scene::check_scene(batch.scene, options.scene);
    }
    for (int i = 0; i < options.seeds; ++i) batch.seeds.push_back(static_cast<std::uint64_t>(i) + study::seed_of(batch.scene));
    std::vector<study::SpecimenReport> reports;
    {
        ProgressLine progress(batch.scene.name);
        batch.on_progress = [&](double fraction) { progress.update(fraction); };
        reports = study::make_specimens(batch);
    }
    nlohmann::json list = nlohmann::json::array();
    bool all_at_rest = true;
    for (const study::SpecimenReport& report : reports) {
        warn_of_fallen(report);
        all_at_rest = all_at_rest && (report.reused || report.prepared.rest.at_rest);
        if (options.json) {
            list.push_back(describe(report));
        } else {
            print_report(report);
        }
    }
    if (options.json) print_json({{"specimens", list}});
    if (all_at_rest) return kDone;
    note(
        "musim: error: {}: a specimen did not come to rest, and no file was written for it (it toppled, or the damping rate is too small); "
        "look at it with musim run, or change preparation.damping_rate\n",
        options.scene);
    return kNumericalFailure;
}

}  // namespace

void add_specimen_command(CLI::App& app, Action& action) {
    auto options = std::make_shared<SpecimenOptions>();
    CLI::App* command = app.add_subcommand("specimen", "Prepare structures of blocks of unequal height, at rest, as files");
    command->add_option("scene", options->scene, "Scene file (JSON, schema musim-scene/1)")->required()->type_name("SCENE.json");
    command->add_option("-o,--out", options->out, "Directory for the files, which are named by content")
        ->type_name("DIR")
        ->capture_default_str();
    command->add_option("--placing", options->placing, "How blocks come to their places, instead of the scene's own way")
        ->type_name("quick_layers|layers|resting|as_drawn")
        ->check(CLI::IsMember(scene::placing_names()));
    command->add_option("--seeds", options->seeds, "Specimens with as many seeds, from the scene's on")
        ->type_name("N")
        ->check(CLI::PositiveNumber)
        ->capture_default_str();
    add_checkpoint_interval_option(*command, options->checkpoint_interval);
    add_threads_option(*command, options->threads);
    add_json_option(*command, options->json);
    command->footer(
        "Examples:\n"
        "  musim specimen examples/uneven_wall.json -o specimens --seeds 10\n"
        "  musim specimen examples/uneven_wall.json -o specimens --placing layers --json\n"
        "A scene uses one with \"preparation\": {\"specimen\": \"specimens/specimen-0123456789abcdef.h5\"}, at any scale.\n"
        "A preparation that was killed goes on from its last checkpoint when the same command is given again.\n"
        "Exit code 4: a specimen did not come to rest.");
    command->callback([&action, options] { action = [options] { return run_specimen(*options); }; });
}

}  // namespace musim::cli
