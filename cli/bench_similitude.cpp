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
#include "cli/options.hpp"
#include "cli/output.hpp"
#include "cli/overwriting.hpp"
#include "cli/progress_line.hpp"
#include "lsdem/study/similitude_bench.hpp"
#include "lsdem/study/similitude_figure.hpp"
#include "lsdem/study/write_results.hpp"
#include "scaling/text_table.hpp"

namespace musim::cli {
namespace {

namespace study = lsdem::study;

struct BenchSimilitudeOptions {
    std::string out;
    std::string law;
    scaling::ReportStyle style = scaling::ReportStyle::plain;
    bool json = false;
    OverwritingOption overwriting;
    int threads = 0;
};

nlohmann::json to_json(const std::vector<study::SimilitudeOutcome>& outcomes) {
    nlohmann::json cases = nlohmann::json::array();
    for (const study::SimilitudeOutcome& outcome : outcomes) {
        const study::SimilitudeCase& wanted = outcome.wanted;
        const scaling::Similitude& scales = wanted.scales.similitude;
        cases.push_back({{"law", wanted.law},
                         {"scene", study::to_string(wanted.scene)},
                         {"length", scales.length()},
                         {"friction", scales.friction()},
                         {"gravity", scales.gravity()},
                         {"density", scales.density()},
                         {"acceleration", scales.acceleration()},
                         {"heights", wanted.scales.heights},
                         {"broken", study::to_string(wanted.broken.group)},
                         {"factor", wanted.broken.factor},
                         {"measure", study::to_string(wanted.measure)},
                         {"predicted", wanted.prediction.ratio},
                         {"tolerance", wanted.prediction.tolerance},
                         {"measured", outcome.ratio},
                         {"difference", outcome.difference},
                         {"yardstick", outcome.yardstick},
                         {"holds", outcome.holds()}});
    }
    return {{"cases", cases}, {"all_hold", study::all_hold(outcomes)}};
}

std::string describe(const study::Break& broken) {
    if (broken.group == study::BrokenGroup::none) return "-";
    return fmt::format("{} x {:.4g}", study::to_string(broken.group), broken.factor);
}

std::string judge(const study::SimilitudeOutcome& outcome) {
    if (outcome.holds()) return "holds";
    return outcome.diverged ? "DIVERGED" : "FAILS";
}

scaling::TextTable make_table(const std::vector<study::SimilitudeOutcome>& outcomes) {
    scaling::TextTable table{{"law", "scene", "length", "mu", "g", "a", "heights", "broken", "measure", "predicted", "measured",
                              "difference", "yardstick", "verdict"}};
    for (const study::SimilitudeOutcome& outcome : outcomes) {
        const study::SimilitudeCase& wanted = outcome.wanted;
        const scaling::Similitude& scales = wanted.scales.similitude;
        const auto number = [](double value) { return fmt::format("{:.4g}", value); };
        table.rows.push_back({wanted.law, std::string(study::to_string(wanted.scene)), number(scales.length()), number(scales.friction()),
                              number(scales.gravity()), number(scales.acceleration()), number(wanted.scales.heights),
                              describe(wanted.broken), std::string(study::to_string(wanted.measure)),
                              fmt::format("{:.5g} +/- {:.1g}", wanted.prediction.ratio, wanted.prediction.tolerance),
                              fmt::format("{:.5g}", outcome.ratio), fmt::format("{:.1e}", outcome.difference),
                              fmt::format("{:.1e}", outcome.yardstick), judge(outcome)});
    }
    return table;
}

int run_bench_similitude(const BenchSimilitudeOptions& options) {
    const std::vector<study::SimilitudeCase> cases = study::make_similitude_cases(options.law);
    std::optional<study::ResultFolder> folder;
    if (!options.out.empty()) folder.emplace(options.out, options.overwriting.origin_with_options(), options.overwriting.choice());

    std::vector<study::SimilitudeOutcome> outcomes;
    {
        ProgressLine progress("similitude");
        outcomes = study::run_similitude_cases(cases, options.threads, [&](double fraction) { progress.update(fraction); });
    }
    if (folder) {
        folder->add_text("similitude.csv", study::make_similitude_csv(outcomes));
        for (const std::string& law : study::similitude_law_names()) {
            if (options.law.empty() || options.law == law) {
                folder->add_text("similitude_" + law + ".svg", study::make_similitude_svg(law, outcomes));
            }
        }
        folder->commit();
    }
    if (options.json) {
        print_json(to_json(outcomes));
    } else {
        print("{}", scaling::make_table(make_table(outcomes), options.style));
    }
    return study::all_hold(outcomes) ? kDone : kCheckFailed;
}

}  // namespace

void add_bench_similitude_command(CLI::App& bench, Action& action) {
    auto options = std::make_shared<BenchSimilitudeOptions>();
    CLI::App* command =
        bench.add_subcommand("similitude", "Laws of similitude against the simulator: groups kept equal, and one broken on purpose");
    command->add_option("-o,--out", options->out, "Directory for similitude.csv and a figure per law")->type_name("DIR");
    command->add_option("--law", options->law, "Only this law (default: all)")->check(one_of(study::similitude_law_names()));
    add_format_option(*command, options->style, "Form of the table");
    add_threads_option(*command, options->threads);
    options->overwriting.add_to(*command);
    add_json_option(*command, options->json);
    command->footer(
        "Examples:\n"
        "  musim bench similitude -o out/similitude\n"
        "  musim bench similitude --law mu --json\n"
        "  musim bench similitude --format markdown\n"
        "length: of widths; heights: over it. Factors of the model over the prototype; broken: one more factor, set wrong on purpose.\n"
        "With equal groups the difference of the curves stays below the yardstick; with a broken one the measured ratio is the predicted.\n"
        "Exit code 5 when a case does not hold; docs/similitude.md derives the predictions.");
    command->callback([&action, options] { action = [options] { return run_whole([&] { return run_bench_similitude(*options); }); }; });
}

}  // namespace musim::cli
