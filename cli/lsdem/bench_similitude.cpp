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
#include "cli/result_options.hpp"
#include "lsdem/results/write_results.hpp"
#include "scaling/text_table.hpp"
#include "tests/benches/similitude_bench.hpp"
#include "tests/benches/similitude_figure.hpp"

namespace musim::cli {
namespace {

struct BenchSimilitudeOptions : ResultOptions {
    std::string law;
    scaling::ReportStyle style = scaling::ReportStyle::plain;
};

/// "friction x 1.1", or "-".
std::string describe(const lsdem::Break& broken) {
    if (broken.group == lsdem::BrokenGroup::none) return "-";
    return fmt::format("{} x {:.4g}", lsdem::to_string(broken.group), broken.factor);
}

std::string judge(const lsdem::SimilitudeOutcome& outcome) {
    if (outcome.holds()) return "holds";
    return outcome.diverged ? "DIVERGED" : "FAILS";
}

NamedValues list_values(const lsdem::SimilitudeOutcome& outcome) {
    const lsdem::SimilitudeCase& wanted = outcome.wanted;
    const scaling::Similitude& scales = wanted.scales.similitude;
    return {{"law", "law", wanted.law},
            {"scene", "scene", lsdem::to_string(wanted.scene)},
            {"length", "length", scales.length()},
            {"friction", "mu", scales.friction()},
            {"gravity", "g", scales.gravity()},
            {"density", {}, scales.density()},
            {"acceleration", "a", scales.acceleration()},
            {"heights", "heights", wanted.scales.heights},
            {{}, "broken", describe(wanted.broken)},
            {"broken", {}, lsdem::to_string(wanted.broken.group)},
            {"factor", {}, wanted.broken.factor},
            {"measure", "measure", lsdem::to_string(wanted.measure)},
            {{}, "predicted", fmt::format("{:.5g} +/- {:.1g}", wanted.prediction.ratio, wanted.prediction.tolerance)},
            {"predicted", {}, wanted.prediction.ratio},
            {"tolerance", {}, wanted.prediction.tolerance},
            {"measured", "measured", outcome.ratio, ".5g"},
            {"difference", "difference", outcome.difference, ".1e"},
            {"yardstick", "yardstick", outcome.yardstick, ".1e"},
            {"holds", {}, outcome.holds()},
            {{}, "verdict", judge(outcome)}};
}

int run_bench_similitude(const BenchSimilitudeOptions& options) {
    const std::vector<lsdem::SimilitudeCase> cases = lsdem::make_similitude_cases(options.law);
    std::optional<lsdem::ResultFolder> folder = options.make_folder(options.origin_with_options());

    std::vector<lsdem::SimilitudeOutcome> outcomes;
    {
        ProgressLine progress("similitude");
        outcomes = lsdem::run_similitude_cases(cases, options.threads, [&](double fraction) { progress.update(fraction); });
    }
    if (folder) {
        folder->add_text("similitude.csv", lsdem::make_similitude_csv(outcomes));
        for (const std::string& law : lsdem::similitude_law_names()) {
            if (options.law.empty() || options.law == law) {
                folder->add_text("similitude_" + law + ".svg", lsdem::make_similitude_svg(law, outcomes));
            }
        }
        folder->commit();
    }
    std::vector<NamedValues> rows;
    rows.reserve(outcomes.size());
    for (const lsdem::SimilitudeOutcome& outcome : outcomes) rows.push_back(list_values(outcome));
    const bool all_hold = lsdem::all_hold(outcomes);
    if (options.json) {
        print_json({{"cases", to_json(rows)}, {"all_hold", all_hold}});
    } else {
        print("{}", make_table(to_table(rows), options.style));
    }
    return all_hold ? kDone : kCheckFailed;
}

}  // namespace

void add_bench_similitude_command(CLI::App& bench, Action& action) {
    auto options = std::make_shared<BenchSimilitudeOptions>();
    CLI::App* command =
        bench.add_subcommand("similitude", "Laws of similitude against the simulator: groups kept equal, and one broken on purpose");
    options->add_out(*command, "Directory for similitude.csv and a figure per law");
    command->add_option("--law", options->law, "Only this law (default: all)")->check(one_of(lsdem::similitude_law_names()));
    add_format_option(*command, options->style, "Form of the table");
    options->add_to(*command);
    command->footer(
        "Examples:\n"
        "  musim bench similitude -o out/similitude\n"
        "  musim bench similitude --law mu --json\n"
        "  musim bench similitude --format markdown\n"
        "length: of widths; heights: over it. Factors of the model over the prototype; broken: one more factor, set wrong on purpose.\n"
        "With equal groups the difference of the curves stays below the yardstick; with a broken one the measured ratio is the predicted.\n"
        "Exit code 5 when a case does not hold; docs/validation/similitude.md derives the predictions.");
    command->callback([&action, options] { action = [options] { return run_whole([&] { return run_bench_similitude(*options); }); }; });
}

}  // namespace musim::cli
