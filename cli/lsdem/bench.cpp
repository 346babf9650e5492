#include <CLI/CLI.hpp>
#include <cmath>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "cli/commands.hpp"
#include "cli/interruption.hpp"
#include "cli/options.hpp"
#include "cli/output.hpp"
#include "cli/progress_line.hpp"
#include "cli/result_options.hpp"
#include "cli/usage.hpp"
#include "lsdem/results/write_results.hpp"
#include "tests/benches/accuracy_plot.hpp"
#include "tests/benches/accuracy_sweep.hpp"

namespace musim::cli {
namespace {

struct BenchAccuracyOptions : ResultOptions {
    std::string record;
    std::string component;
    bool quick = false;
};

/// An error that is no finite number is null.
nlohmann::json make_json(const lsdem::AccuracySweep& sweep) {
    nlohmann::json panels = nlohmann::json::array();
    for (const lsdem::AccuracyPanel& panel : sweep.panels) {
        nlohmann::json rows = nlohmann::json::array();
        for (const lsdem::AccuracyRow& row : panel.rows) {
            rows.push_back({{"family", row.family},
                            {"label", row.label},
                            {"error", row.outcome.error},
                            {"seconds", row.outcome.seconds},
                            {"steps", row.outcome.steps},
                            {"block_steps", row.outcome.block_steps},
                            {"pareto", row.pareto}});
        }
        panels.push_back({{"case", panel.name}, {"title", panel.title}, {"rows", rows}});
    }
    return {{"earthquake", sweep.earthquake}, {"cases", panels}};
}

/// The Pareto front of every problem, cheapest first as the table goes, and the presets.
void print_sweep(const lsdem::AccuracySweep& sweep) {
    print("Earthquake of the mini-tower: {}\n", sweep.earthquake);
    for (const lsdem::AccuracyPanel& panel : sweep.panels) {
        print("\n{} ({})\n  {:<10} {:>9} {:>11} {:>12} {:>10}\n", panel.title, panel.name, "family", "setting", "error", "us/block/step",
              "time [s]");
        for (const lsdem::AccuracyRow& row : panel.rows) {
            if (!row.pareto && row.family != "preset" && row.family != "copy") continue;
            const lsdem::AccuracyOutcome& o = row.outcome;
            print("  {:<10} {:>9} {:>11.3g} {:>12.3g} {:>10.3g}{}\n", row.family, row.label, o.error,
                  o.block_steps > 0 ? 1e6 * o.seconds / static_cast<double>(o.block_steps) : 0.0, o.seconds, row.pareto ? "  Pareto" : "");
        }
    }
}

int run_bench_accuracy(const BenchAccuracyOptions& options) {
    std::optional<lsdem::ResultFolder> folder = options.make_folder(options.origin_with_options());

    lsdem::SweepOptions wanted{.record = options.record, .components = {}, .quick = options.quick, .threads = options.threads};
    if (!options.component.empty()) wanted.components[0] = options.component;
    lsdem::AccuracySweep sweep;
    {
        ProgressLine progress("accuracy");
        wanted.on_progress = [&](double fraction) { progress.update(fraction); };
        sweep = lsdem::sweep_accuracy(wanted);
    }
    if (folder) {
        folder->add_text("accuracy.csv", lsdem::make_accuracy_csv(sweep));
        folder->add_text("accuracy.svg", lsdem::make_accuracy_svg(sweep));
        folder->commit();
    }
    if (options.json) {
        print_json(make_json(sweep));
    } else {
        print_sweep(sweep);
        if (folder) print("\nAll settings in {}\n", (std::filesystem::path(options.out) / "accuracy.csv").string());
    }
    return kDone;
}

}  // namespace

void add_bench_command(CLI::App& app, Action& action) {
    auto options = std::make_shared<BenchAccuracyOptions>();
    CLI::App* bench = app.add_subcommand("bench", "Measurements of musim itself");
    bench->require_subcommand(1);
    add_bench_similitude_command(*bench, action);
    add_bench_twins_command(*bench, action);
    add_bench_verdict_command(*bench, action);
    CLI::App* command =
        bench->add_subcommand("accuracy", "Error against run time, over time steps, overlap and nodes as contact, and grids");
    options->add_out(*command, "Directory for accuracy.csv and accuracy.svg");
    CLI::Option* record =
        command->add_option("--record", options->record, "Earthquake of the mini-tower, at prototype scale (default: a synthetic one)")
            ->type_name("FILE");
    command->add_option("--component", options->component, "Its component along the wall (default: the strongest horizontal)")
        ->type_name("NAME")
        ->needs(record);
    command->add_flag("--quick", options->quick, "Few settings and a low tower: seconds instead of minutes");
    options->add_to(*command);
    command->footer(
        "Examples:\n"
        "  musim bench accuracy --record CICLC.v1 --component 360 -o out/accuracy\n"
        "  musim bench accuracy --quick --json\n"
        "Run times are processor time of the stepping thread; docs/validation/accuracy.md explains the problems.");
    command->callback([&action, options] { action = [options] { return run_whole([&] { return run_bench_accuracy(*options); }); }; });
    group_commands(*bench, "Test laws and verdicts", {"similitude", "twins", "verdict"});
    group_commands(*bench, "Measure errors and run times", {"accuracy"});
}

}  // namespace musim::cli
