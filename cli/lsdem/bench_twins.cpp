#include <fmt/format.h>
#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "cli/commands.hpp"
#include "cli/interruption.hpp"
#include "cli/named_values.hpp"
#include "cli/options.hpp"
#include "cli/output.hpp"
#include "cli/progress_line.hpp"
#include "cli/report.hpp"
#include "cli/result_options.hpp"
#include "cli/version.hpp"
#include "cli/whole_option.hpp"
#include "lsdem/results/write_results.hpp"
#include "lsdem/scene/scene_json.hpp"
#include "lsdem/study/compare_runs.hpp"
#include "lsdem/study/twin_files.hpp"
#include "lsdem/study/twin_runs.hpp"
#include "scaling/text_table.hpp"

namespace musim::cli {
namespace {

struct BenchTwinsOptions : ResultOptions {
    std::vector<std::string> scenes;
    std::optional<Number> duration;
    std::vector<Number> shifts;
    std::size_t models = 20;
    std::uint64_t seed = 1;
    scaling::ReportStyle style = scaling::ReportStyle::plain;
};

/// A study and what it comes to.
struct Measured {
    lsdem::TwinStudy study;
    lsdem::TwinSummary summary;
};

std::vector<lsdem::TwinChoice> choose_twins(const BenchTwinsOptions& options) {
    std::vector<lsdem::TwinChoice> choices = lsdem::choose_models(options.models, options.seed);
    const std::vector<lsdem::TwinChoice> moved =
        lsdem::choose_shifted({options.shifts.begin(), options.shifts.end()}, options.models, options.seed);
    choices.insert(choices.end(), moved.begin(), moved.end());
    return choices;
}

lsdem::Scene read_prototype(const std::string& file, const BenchTwinsOptions& options) {
    lsdem::Scene prototype = read_scene(file);
    if (options.duration) prototype.time.duration = options.duration->value * scaling::si::seconds;
    lsdem::check_scene(prototype, file);
    note_cut_motions(file, prototype);
    return prototype;
}

Measured measure_twins(const lsdem::Scene& prototype, const BenchTwinsOptions& options, ProgressInParts& progress) {
    lsdem::TwinSettings settings{
        .directory = options.out, .version = kVersion, .threads = options.threads, .observer = progress.observer()};
    settings.on_warning = note_no_checkpoint;
    lsdem::TwinStudy twins = lsdem::run_twins(prototype, choose_twins(options), settings);
    lsdem::TwinSummary summary = lsdem::summarize(twins);
    return {std::move(twins), std::move(summary)};
}

scaling::TextTable make_table(const Measured& measured) {
    scaling::TextTable table{{"length", "moved by", "directions", "parts at [s]", "largest growth", "at [s]", "from", "at the end"}};
    for (std::size_t i = 0; i < measured.study.twins.size(); ++i) {
        const lsdem::TwinRun& twin = measured.study.twins[i];
        const lsdem::TwinGrowth& growth = measured.summary.twins[i];
        const bool moved = twin.choice.shift > 0.0;
        table.rows.push_back({fmt::format("{:.6g}", twin.choice.length), moved ? fmt::format("{:g}", twin.choice.shift) : "-",
                              moved ? fmt::format("{}", twin.choice.directions) : "-", or_dash(growth.parting_time, 4),
                              fmt::format("{:.3g}", growth.growth.factor), fmt::format("{:.4g}", growth.growth.time),
                              fmt::format("{:.1e}", growth.growth.from),
                              twin.diverged ? "DIVERGED" : fmt::format("{:.1e}", growth.running.empty() ? 0.0 : growth.running.back())});
    }
    return table;
}

void print_study(const Measured& measured, scaling::ReportStyle style) {
    const lsdem::TwinStudy& twins = measured.study;
    const lsdem::TwinSummary& summary = measured.summary;
    const lsdem::TwinPrototype& prototype = twins.prototype;
    const lsdem::Growth& fastest = summary.twins[summary.fastest].growth;
    print("{}: {} moving blocks, largest velocity {:.4g} m/s\n\n{}\n", twins.name, prototype.moving_blocks, prototype.peak,
          scaling::make_table(make_table(measured), style));
    print(
        "Differences are over that velocity; below {:.1e} they are rounding. Largest growth within {:.3g} ms: {:.3g} at {:.4g} s, from "
        "{:.1e}\n",
        prototype.rounding / prototype.peak, 1e3 * static_cast<double>(prototype.window()) * prototype.interval, fastest.factor,
        fastest.time, fastest.from);
    print("Horizon {:.4g} s", summary.horizon);
    if (const lsdem::LogSpread& spread = summary.at_horizon; spread.count > 0) {
        print("; at {:.4g} s log10 of the difference is {:.3f}, standard deviation {}, of {} models", spread.time, spread.mean,
              or_dash(spread.count > 1 ? std::optional(spread.sd) : std::nullopt, 3), spread.count);
    }
    print("\n");
    for (const lsdem::Proportionality& set : lsdem::find_proportionality(twins, summary.twins)) {
        print("Directions {}: {}\n", set.directions,
              set.departure ? fmt::format("difference over shift differs by at most a factor {:.4g}, at {:.4g} s where it is {:.1e}",
                                          *set.departure, set.time, set.level)
                            : "no two differences that are small enough and ten times what rounding makes");
    }
    print("\n");
}

nlohmann::json make_json(const std::vector<Measured>& all) {
    nlohmann::json scenes = nlohmann::json::array();
    for (const Measured& measured : all) scenes.push_back(lsdem::to_json(measured.study, measured.summary));
    return {{"parting_level", lsdem::kPartingLevel}, {"program_version", kVersion}, {"scenes", scenes}};
}

void write_results(lsdem::ResultFolder& folder, const std::vector<Measured>& all) {
    std::vector<lsdem::TwinStudy> studies;
    studies.reserve(all.size());
    for (const Measured& measured : all) studies.push_back(measured.study);
    folder.add_text("twins.csv", lsdem::make_twins_csv(studies));
    folder.add_text("spread.csv", lsdem::make_spread_csv(studies));
    folder.add_text("summary.json", make_json(all).dump(2) + "\n");
    folder.commit();
}

int run_bench_twins(const BenchTwinsOptions& options) {
    std::vector<lsdem::Scene> prototypes;
    for (const std::string& file : options.scenes) prototypes.push_back(read_prototype(file, options));
    lsdem::ResultOrigin origin = options.origin_with_options({{"--models", options.models}});
    for (const lsdem::Scene& prototype : prototypes) origin.add(prototype, prototype.name + ": ");
    std::optional<lsdem::ResultFolder> folder = options.make_folder(std::move(origin));

    std::vector<Measured> all;
    bool diverged = false;
    const std::vector<double> shares = lsdem::share_work(prototypes);
    ProgressInParts progress(prototypes.front().name);
    for (std::size_t k = 0; k < prototypes.size(); ++k) {
        progress.begin_part(prototypes[k].name, shares[k]);
        const Measured& measured = all.emplace_back(measure_twins(prototypes[k], options, progress));
        diverged |= measured.study.prototype.diverged;
        for (const lsdem::TwinRun& twin : measured.study.twins) diverged |= twin.diverged;
        if (!options.json) print_study(measured, options.style);
    }
    if (folder) write_results(*folder, all);
    if (options.json) print_json(make_json(all));
    if (folder && !options.json) print("Histories in {}\n", (std::filesystem::path(options.out) / "twins.csv").string());
    if (diverged) note("musim: error: a prototype or a twin diverged; its comparison ends there\n");
    return diverged ? kNumericalFailure : kDone;
}

}  // namespace

void add_bench_twins_command(CLI::App& bench, Action& action) {
    auto options = std::make_shared<BenchTwinsOptions>();
    CLI::App* command = bench.add_subcommand("twins", "How exact models, or copies moved a little, part from their prototype");
    command->add_option("scenes", options->scenes, "Scene files of prototypes")->required()->type_name("SCENE.json...");
    options->add_out(*command, "Directory for twins.csv, spread.csv, summary.json and what each run leaves");
    add_whole_option(*command, "--models", options->models, "Exact models of each scene; with --perturb also sets of directions",
                     {1, 100000})
        ->capture_default_str();
    add_whole_option(*command, "--seed", options->seed,
                     "Of the lengths, 4^u with u in (-2, 2); with --perturb also of the first set of directions")
        ->capture_default_str();
    add_positive_option(*command, "--duration", options->duration, "Simulated time [s] of the prototypes, instead of the scenes'");
    command
        ->add_option("--perturb", options->shifts,
                     "Beside the models, copies whose blocks are moved by these parts of their height, e.g. 1e-13,1e-12,1e-11")
        ->type_name("LIST")
        ->delimiter(',')
        ->check(above_zero());
    add_format_option(*command, options->style, "Form of the tables");
    options->add_to(*command);
    command->footer(
        "Examples:\n"
        "  musim bench twins examples/tower_prototype.json -o out/twins --duration 2\n"
        "  musim bench twins examples/uneven_wall.json examples/wall.json --models 40 --json\n"
        "  musim bench twins examples/uneven_wall.json --perturb 1e-13,1e-12,1e-11 --models 10\n"
        "Difference: the largest |v_M/lambda_v - v_P| of a block over the largest velocity that one has relative to the base; its running\n"
        "maximum counts. A twin parts where that exceeds 1e-3; growth below is over 0.015 sqrt(H/g). Specimens are laid once.\n"
        "Runs go side by side, one thread each. The same command again, killed or not, runs what is missing in DIR; another build should\n"
        "have another DIR. Exit code 4: a run diverged.");
    command->callback(
        [&action, options] { action = [options] { return run_again([&] { return run_bench_twins(*options); }, options->out); }; });
}

}  // namespace musim::cli
