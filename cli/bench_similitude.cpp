#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "cli/commands.hpp"
#include "cli/options.hpp"
#include "cli/output.hpp"
#include "cli/progress_line.hpp"
#include "lsdem/study/similitude_bench.hpp"
#include "lsdem/study/similitude_figure.hpp"
#include "lsdem/study/write_results.hpp"

namespace musim::cli {
namespace {

namespace study = lsdem::study;

struct BenchSimilitudeOptions {
    std::string out;
    std::string law;
    bool json = false;
    int threads = 0;
};

nlohmann::json to_json(const std::vector<study::SimilitudeOutcome>& outcomes) {
    nlohmann::json cases = nlohmann::json::array();
    for (const study::SimilitudeOutcome& outcome : outcomes) {
        const study::SimilitudeCase& wanted = outcome.wanted;
        const scaling::ScaleFactors& chosen = wanted.similitude.chosen();
        cases.push_back({{"law", wanted.law},
                         {"scene", study::to_string(wanted.scene)},
                         {"length", chosen.length},
                         {"friction", chosen.friction},
                         {"gravity", chosen.gravity},
                         {"density", chosen.density},
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

void print_outcomes(const std::vector<study::SimilitudeOutcome>& outcomes) {
    print("{:<11}{:<7}{:>8}{:>8}{:>5} {:<10}{:>7} {:<10}{:>10}{:>10}{:>10}{:>12}{:>11}\n", "law", "scene", "length", "mu ratio", "g",
          "broken", "factor", "measure", "predicted", "+-", "measured", "difference", "yardstick");
    for (const study::SimilitudeOutcome& outcome : outcomes) {
        const study::SimilitudeCase& wanted = outcome.wanted;
        const scaling::ScaleFactors& chosen = wanted.similitude.chosen();
        print("{:<11}{:<7}{:>8.4g}{:>8.4g}{:>5.3g} {:<10}{:>7.4g} {:<10}{:>10.5g}{:>10.2g}{:>10.5g}{:>12.2g}{:>11.2g}  {}\n", wanted.law,
              study::to_string(wanted.scene), chosen.length, chosen.friction, chosen.gravity, study::to_string(wanted.broken.group),
              wanted.broken.factor, study::to_string(wanted.measure), wanted.prediction.ratio, wanted.prediction.tolerance, outcome.ratio,
              outcome.difference, outcome.yardstick,
              outcome.holds()    ? "holds"
              : outcome.diverged ? "DIVERGED"
                                 : "FAILS");
    }
}

int run_bench_similitude(const BenchSimilitudeOptions& options) {
    const std::vector<study::SimilitudeCase> cases = study::make_similitude_cases(options.law);
    std::optional<study::ResultFolder> folder;
    if (!options.out.empty()) folder.emplace(options.out);

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
        print_outcomes(outcomes);
    }
    return study::all_hold(outcomes) ? kDone : kCheckFailed;
}

}  // namespace

void add_bench_similitude_command(CLI::App& bench, Action& action) {
    auto options = std::make_shared<BenchSimilitudeOptions>();
    CLI::App* command =
        bench.add_subcommand("similitude", "Laws of similitude against the simulator: groups kept equal, and one broken on purpose");
    command->add_option("-o,--out", options->out, "Directory for similitude.csv and a figure per law")->type_name("DIR");
    command->add_option("--law", options->law, "Only this law (default: all)")->check(CLI::IsMember(study::similitude_law_names()));
    add_threads_option(*command, options->threads);
    add_json_option(*command, options->json);
    command->footer(
        "Examples:\n"
        "  musim bench similitude -o out/similitude\n"
        "  musim bench similitude --law mu --json\n"
        "With equal groups the difference of the curves stays below the yardstick; with a broken one the measured ratio is the predicted.\n"
        "Exit code 5 when a case does not hold; docs/similitude.md derives the predictions.");
    command->callback([&action, options] { action = [options] { return run_bench_similitude(*options); }; });
}

}  // namespace musim::cli
