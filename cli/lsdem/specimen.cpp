#include <algorithm>
#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "cli/commands.hpp"
#include "cli/interruption.hpp"
#include "cli/lsdem/specimen_batch.hpp"
#include "cli/options.hpp"
#include "cli/output.hpp"
#include "cli/progress_line.hpp"
#include "cli/report.hpp"
#include "cli/whole_option.hpp"
#include "lsdem/results/run_warnings.hpp"
#include "lsdem/scene/scene_json.hpp"
#include "lsdem/study/compare_specimens.hpp"
#include "scaling/angle.hpp"

namespace musim::cli {
namespace {

struct SpecimenOptions {
    std::string scene;
    std::vector<std::string> compare;
    std::string out = ".";
    std::string placing;
    int seeds = 1;
    Number checkpoint_interval{60.0};
    int threads = 0;
    bool json = false;
};

double largest_tilt(const lsdem::PreparedSpecimen& prepared) {
    double largest = 0.0;
    for (const lsdem::LayerState& layer : prepared.layers) largest = std::max(largest, layer.max_tilt);
    return largest;
}

nlohmann::json describe(const lsdem::SpecimenReport& report) {
    nlohmann::json object{{"file", report.file.string()}, {"seed", report.seed},     {"reused", report.reused},
                          {"resumed", report.resumed},    {"blocks", report.blocks}, {"fallen", report.fallen}};
    if (report.reused) return object;
    const lsdem::PreparedSpecimen& prepared = report.prepared;
    nlohmann::json layers = nlohmann::json::array();
    for (const lsdem::LayerState& layer : prepared.layers) {
        layers.push_back({{"mean_tilt_deg", layer.mean_tilt * scaling::kDegrees},
                          {"max_tilt_deg", layer.max_tilt * scaling::kDegrees},
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

void print_report(const lsdem::SpecimenReport& report) {
    if (report.reused) {
        print("{}: seed {}, {} blocks, made before from the same inputs\n", report.file.string(), report.seed, report.blocks);
        return;
    }
    const lsdem::PreparedSpecimen& prepared = report.prepared;
    print("{}: seed {}, {} blocks{}\n", report.file.string(), report.seed, report.blocks,
          report.resumed ? ", gone on with from a checkpoint" : "");
    print("  {} after {} steps in {:.2f} s; base reaction {:.6f} of the weight, largest tilt {:.3g} degrees, overlap {:.3g} of a height\n",
          prepared.rest.at_rest ? "at rest" : "NOT at rest", prepared.steps, report.wall_time, prepared.rest.reaction_over_weight,
          largest_tilt(prepared) * scaling::kDegrees, prepared.max_overlap);
}

void print_quantity(const char* name, const std::vector<lsdem::LayerComparison>& layers,
                    lsdem::QuantityComparison lsdem::LayerComparison::*quantity, double unit) {
    print("\n  {:<24} {:>18} {:>18} {:>20} {:>8} {:>8}\n", name, "first (sd)", "second (sd)", "same seeds differ by", "p mean", "p sd");
    for (const lsdem::LayerComparison& layer : layers) {
        const lsdem::QuantityComparison& compared = layer.*quantity;
        const lsdem::TwoSamples& samples = compared.samples;
        const std::string pairs =
            compared.pairs > 1 ? fmt::format("{:+.3f} +- {:.3f}", compared.pair_difference * unit, compared.pair_error * unit) : "-";
        print("  {:<24} {:>18} {:>18} {:>20} {:>8.2f} {:>8.2f}\n", fmt::format("layers {}-{}", layer.first, layer.last),
              fmt::format("{:.3f} ({:.3f})", samples.first_mean * unit, samples.first_sd * unit),
              fmt::format("{:.3f} ({:.3f})", samples.second_mean * unit, samples.second_sd * unit), pairs, samples.mean_probability,
              samples.scatter_probability);
    }
}

nlohmann::json describe(const lsdem::SpecimenSet& set) {
    return {{"file", set.name}, {"specimens", set.specimens.size()}, {"fallen", set.fallen()}, {"block_steps", set.block_steps()}};
}

/// Comparison of what was printed of two ways of preparing.
int compare_specimens(const SpecimenOptions& options) {
    const lsdem::SpecimenSet first = lsdem::read_specimen_set(options.compare[0]), second = lsdem::read_specimen_set(options.compare[1]);
    const std::vector<lsdem::LayerComparison> layers = lsdem::compare_specimens(first, second);
    if (options.json) {
        nlohmann::json list = nlohmann::json::array();
        for (const lsdem::LayerComparison& layer : layers) list.push_back(lsdem::to_json(layer));
        print_json({{"first", describe(first)}, {"second", describe(second)}, {"compared", list}});
        return kDone;
    }
    for (const lsdem::SpecimenSet* set : {&first, &second}) {
        print("{}: {} specimens, {:.3g} block steps each, {} blocks fell\n", set->name, set->specimens.size(), set->block_steps(),
              set->fallen());
    }
    print_quantity("mean tilt [deg]", layers, &lsdem::LayerComparison::tilt, scaling::kDegrees);
    print_quantity("largest of a layer [deg]", layers, &lsdem::LayerComparison::largest_tilt, scaling::kDegrees);
    print_quantity("scatter of forces [N]", layers, &lsdem::LayerComparison::force_scatter, 1.0);
    print("\n  p: how probable so large a difference is between samples of one population; of twenty, one is below 0.05 by chance\n");
    return kDone;
}

/// Why there is no file of a specimen.
void report_missing(const std::string& scene, const lsdem::SpecimenReport& report) {
    const lsdem::Rest& rest = report.prepared.rest;
    note("musim: error: {}: seed {}: no specimen was written: {}\n", scene, report.seed,
         rest.collapsed ? "it does not stand as drawn (see the warning)" : lsdem::describe_unrest(rest));
}

int run_specimen(const SpecimenOptions& options) {
    if (!options.compare.empty()) return compare_specimens(options);
    lsdem::SpecimenBatch batch = begin_batch(options.out, options.threads, options.checkpoint_interval);
    batch.scene = read_scene(options.scene);
    if (!options.placing.empty()) {
        const auto& names = lsdem::placing_names();
        if (!batch.scene.preparation) batch.scene.preparation.emplace();
        batch.scene.preparation->placing =
            static_cast<lsdem::BlockPlacing>(std::find(names.begin(), names.end(), options.placing) - names.begin());
        lsdem::check_scene(batch.scene, options.scene);
    }
    for (int i = 0; i < options.seeds; ++i) batch.seeds.push_back(static_cast<std::uint64_t>(i) + lsdem::seed_of(batch.scene));
    std::vector<lsdem::SpecimenReport> reports;
    {
        ProgressLine progress(batch.scene.name);
        batch.on_progress = [&](double fraction) { progress.update(fraction); };
        reports = lsdem::make_specimens(batch);
    }
    nlohmann::json list = nlohmann::json::array();
    bool all_stand = true;
    for (const lsdem::SpecimenReport& report : reports) {
        warn_of_fallen(report);
        all_stand = all_stand && report.stands();
        if (!report.stands()) report_missing(options.scene, report);
        if (options.json) {
            list.push_back(describe(report));
        } else {
            print_report(report);
        }
    }
    if (options.json) print_json({{"specimens", list}});
    return all_stand ? kDone : kNumericalFailure;
}

}  // namespace

void add_specimen_command(CLI::App& app, Action& action) {
    auto options = std::make_shared<SpecimenOptions>();
    CLI::App* command = app.add_subcommand("specimen", "Prepare structures of blocks of unequal height, at rest, as files");
    CLI::Option* scene_file = command->add_option("scene", options->scene, "Scene file (JSON, schema musim-scene/1)");
    scene_file->type_name("SCENE.json");
    CLI::Option* out = command->add_option("-o,--out", options->out, "Directory for the files, which are named by content");
    out->type_name("DIR")->capture_default_str();
    command->add_option("--compare", options->compare, "Compare what --json printed of two ways of preparing; prepare nothing")
        ->type_name("FIRST.json SECOND.json")
        ->expected(2)
        ->excludes(scene_file)
        ->excludes(out);
    command->add_option("--placing", options->placing, "How blocks come to their places, instead of the scene's own way")
        ->type_name("layers_mass_scaled|layers|resting|as_drawn")
        ->check(one_of(lsdem::placing_names()));
    add_whole_option(*command, "--seeds", options->seeds, "Specimens with as many seeds, from the scene's on", {1, 100000})
        ->capture_default_str();
    add_checkpoint_interval_option(*command, options->checkpoint_interval);
    add_threads_option(*command, options->threads);
    add_json_option(*command, options->json);
    command->footer(
        "Examples:\n"
        "  musim specimen examples/uneven_wall.json -o specimens --seeds 10\n"
        "  musim specimen examples/uneven_wall.json -o laid --seeds 10 --placing layers --json > layers.json\n"
        "  musim specimen --compare layers.json quick.json\n"
        "A scene uses one with \"preparation\": {\"specimen\": \"specimens/specimen-0123456789abcdef.h5\"}, at any scale.\n"
        "A preparation that was killed goes on from its last checkpoint when the same command is given again.\n"
        "Exit code 4: a specimen did not come to rest, or fell while it was prepared.");
    command->callback([&action, options] {
        if (options->compare.empty() && options->scene.empty()) throw CLI::RequiredError("scene (or --compare)");
        action = [options] { return run_again([&] { return run_specimen(*options); }, options->out); };
    });
}

}  // namespace musim::cli
