#include <fmt/format.h>
#include <algorithm>
#include <CLI/CLI.hpp>
#include <cstddef>
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
#include "cli/progress_line.hpp"
#include "cli/report.hpp"
#include "cli/result_options.hpp"
#include "cli/version.hpp"
#include "cli/whole_option.hpp"
#include "lsdem/results/write_results.hpp"
#include "lsdem/scene/scene_json.hpp"
#include "scaling/text_table.hpp"
#include "tests/benches/verdict_bench.hpp"

namespace musim::cli {
namespace {

using Models = std::vector<lsdem::JudgedModel>;

struct BenchVerdictOptions : ResultOptions {
    std::vector<std::string> scenes;
    std::optional<Number> duration;
    lsdem::VerdictBenchPlan plan;
    std::vector<std::string> errors;
    std::vector<Number> sizes;
    scaling::ReportStyle style = scaling::ReportStyle::plain;
};

std::vector<std::string> error_names() {
    std::vector<std::string> names{"all"};
    for (const lsdem::ModelError error : lsdem::all_model_errors()) names.push_back(lsdem::to_string(error));
    return names;
}

lsdem::VerdictBenchPlan make_plan(const BenchVerdictOptions& options) {
    lsdem::VerdictBenchPlan plan = options.plan;
    const auto asked = [&](const std::string& name) {
        return std::find(options.errors.begin(), options.errors.end(), name) != options.errors.end();
    };
    for (const lsdem::ModelError error : lsdem::all_model_errors()) {
        if (asked("all") || asked(lsdem::to_string(error))) plan.errors.push_back(error);
    }
    if (!options.sizes.empty()) plan.sizes.assign(options.sizes.begin(), options.sizes.end());
    return plan;
}

lsdem::Scene read_prototype(const std::string& file, const BenchVerdictOptions& options) {
    lsdem::Scene prototype = read_scene(file);
    if (options.duration) prototype.time.duration = options.duration->value * scaling::si::seconds;
    lsdem::check_scene(prototype, file);
    return prototype;
}

lsdem::VerdictBench measure(const std::string& file, const lsdem::Scene& prototype, const lsdem::VerdictBenchPlan& plan,
                            const BenchVerdictOptions& options, ProgressInParts& progress) {
    note_cut_motions(file, prototype);
    lsdem::TwinSettings settings{
        .directory = options.out, .version = kVersion, .threads = options.threads, .observer = progress.observer()};
    settings.on_warning = note_no_checkpoint;
    lsdem::VerdictBench bench = lsdem::run_verdict_bench(prototype, plan, settings);
    bench.scene = std::filesystem::path(file).stem().string();
    return bench;
}

std::string format_tally(const lsdem::Tally& tally) {
    return fmt::format("{} of {} ({:.3g} to {:.3g} %)", tally.count, tally.of, 100.0 * tally.low, 100.0 * tally.high);
}

double largest_lead(const Models& models) {
    double largest = 0.0;
    for (const lsdem::JudgedModel& model : models) largest = std::max(largest, model.lead);
    return largest;
}

double median_lead(const Models& models) {
    std::vector<double> leads;
    for (const lsdem::JudgedModel& model : models) leads.push_back(model.lead);
    if (leads.empty()) return 0.0;
    std::nth_element(leads.begin(), leads.begin() + static_cast<std::ptrdiff_t>(leads.size() / 2), leads.end());
    return leads[leads.size() / 2];
}

double least_probability(const Models& models) {
    double least = 1.0;
    for (const lsdem::JudgedModel& model : models) least = std::min(least, model.probability);
    return least;
}

scaling::TextTable make_exact_table(const std::vector<lsdem::VerdictBench>& benches) {
    scaling::TextTable table{
        {"scene", "twins from", "horizon [s]", "exact models", "differ", "undecided", "largest lead", "least p", "images over copies"}};
    for (const lsdem::VerdictBench& bench : benches) {
        for (const lsdem::JudgedSet& set : bench.sets) {
            table.rows.push_back({bench.scene, fmt::format("{}", set.seed), fmt::format("{:.4g}", set.horizon),
                                  fmt::format("{}", set.models.size()),
                                  fmt::format("{}", lsdem::tally(set.models, lsdem::Agreement::differ).count),
                                  fmt::format("{}", lsdem::tally(set.models, lsdem::Agreement::undecided).count),
                                  fmt::format("{:.2f}", largest_lead(set.models)), fmt::format("{:.2g}", least_probability(set.models)),
                                  set.of_images ? fmt::format("{:.2f}", set.of_images->lead) : "-"});
        }
    }
    return table;
}

std::string format_size(const std::optional<lsdem::FoundSize>& size) {
    return size ? fmt::format("{:.1e} ({:.1e} to {:.1e})", size->size, size->low, size->high) : "-";
}

scaling::TextTable make_error_table(const lsdem::VerdictBench& bench) {
    scaling::TextTable table{{"error", "in", "size", "found", "lead", "found in 95 of 100"}};
    const auto add = [&](const char* where, Models lsdem::JudgedError::*models) {
        std::optional<lsdem::ModelError> before;
        for (const lsdem::JudgedError& judged : bench.errors) {
            const std::string size = before == judged.error ? "" : format_size(lsdem::find_size(bench, judged.error, models));
            table.rows.push_back({lsdem::to_string(judged.error), where, fmt::format("{:g}", judged.size),
                                  format_tally(lsdem::tally(judged.*models, lsdem::Agreement::differ)),
                                  fmt::format("{:.2f}", median_lead(judged.*models)), size});
            before = judged.error;
        }
    };
    add("one model", &lsdem::JudgedError::alone);
    add("models and images", &lsdem::JudgedError::shared);
    return table;
}

nlohmann::json make_json(const lsdem::Tally& tally) {
    return {{"count", tally.count}, {"of", tally.of}, {"low", tally.low}, {"high", tally.high}};
}

nlohmann::json make_json(const Models& models) {
    nlohmann::json list = nlohmann::json::array();
    for (const lsdem::JudgedModel& model : models) {
        list.push_back({{"length", model.length},
                        {"agreement", lsdem::to_string(model.agreement)},
                        {"lead_sd", model.lead},
                        {"lead_time_s", model.lead_time},
                        {"probability", model.probability}});
    }
    return list;
}

nlohmann::json make_json(const std::optional<lsdem::FoundSize>& size) {
    if (!size) return nullptr;
    return {{"size", size->size}, {"low", size->low}, {"high", size->high}};
}

nlohmann::json make_json(const std::vector<lsdem::VerdictBench>& benches) {
    nlohmann::json scenes = nlohmann::json::array();
    for (const lsdem::VerdictBench& bench : benches) {
        nlohmann::json sets = nlohmann::json::array(), errors = nlohmann::json::array();
        for (const lsdem::JudgedSet& set : bench.sets) {
            sets.push_back({{"seed", set.seed},
                            {"horizon_s", set.horizon},
                            {"lead_of_images_sd", set.of_images ? nlohmann::json(set.of_images->lead) : nlohmann::json()},
                            {"models", make_json(set.models)}});
        }
        for (const lsdem::JudgedError& judged : bench.errors) {
            const auto of = [&](Models lsdem::JudgedError::*models) -> nlohmann::json {
                return {{"found", make_json(lsdem::tally(judged.*models, lsdem::Agreement::differ))},
                        {"found_in_95_of_100", make_json(lsdem::find_size(bench, judged.error, models))},
                        {"models", make_json(judged.*models)}};
            };
            errors.push_back({{"error", lsdem::to_string(judged.error)},
                              {"size", judged.size},
                              {"in_one_model", of(&lsdem::JudgedError::alone)},
                              {"in_models_and_images", of(&lsdem::JudgedError::shared)}});
        }
        scenes.push_back({{"scene", bench.scene}, {"sets", sets}, {"errors", errors}});
    }
    return {{"program_version", kVersion},
            {"differ", make_json(lsdem::tally_exact(benches, lsdem::Agreement::differ))},
            {"undecided", make_json(lsdem::tally_exact(benches, lsdem::Agreement::undecided))},
            {"scenes", scenes}};
}

void print_benches(const std::vector<lsdem::VerdictBench>& benches, scaling::ReportStyle style) {
    print("Exact models\n\n{}\n", scaling::make_table(make_exact_table(benches), style));
    print("Called different: {}, undecided: {}; in brackets limits of 95 %\n",
          format_tally(lsdem::tally_exact(benches, lsdem::Agreement::differ)),
          format_tally(lsdem::tally_exact(benches, lsdem::Agreement::undecided)));
    for (const lsdem::VerdictBench& bench : benches) {
        if (bench.errors.empty()) continue;
        print("\nWrong models of {}\n\n{}", bench.scene, scaling::make_table(make_error_table(bench), style));
    }
}

int run_bench_verdict(const BenchVerdictOptions& options) {
    const lsdem::VerdictBenchPlan plan = make_plan(options);
    std::vector<lsdem::Scene> prototypes;
    for (const std::string& file : options.scenes) prototypes.push_back(read_prototype(file, options));
    lsdem::ResultOrigin origin = options.origin_with_options({{"--sets", plan.sets}, {"--models", plan.models}, {"--images", plan.images}});
    for (std::size_t k = 0; k < prototypes.size(); ++k) origin.add(prototypes[k], options.scenes[k] + ": ");
    std::optional<lsdem::ResultFolder> folder = options.make_folder(std::move(origin));
    std::vector<lsdem::VerdictBench> benches;
    {
        const std::vector<double> shares = lsdem::share_work(prototypes);
        ProgressInParts progress(prototypes.front().name);
        for (std::size_t k = 0; k < prototypes.size(); ++k) {
            progress.begin_part(prototypes[k].name, shares[k]);
            benches.push_back(measure(options.scenes[k], prototypes[k], plan, options, progress));
        }
    }
    if (folder) {
        folder->add_text("verdicts.json", make_json(benches).dump(2) + "\n");
        folder->commit();
    }
    if (options.json) {
        print_json(make_json(benches));
    } else {
        print_benches(benches, options.style);
    }
    return kDone;
}

}  // namespace

void add_bench_verdict_command(CLI::App& bench, Action& action) {
    auto options = std::make_shared<BenchVerdictOptions>();
    CLI::App* command = bench.add_subcommand("verdict", "How often `musim pair` calls exact models different, and which errors it finds");
    lsdem::VerdictBenchPlan& plan = options->plan;
    command->add_option("scenes", options->scenes, "Scene files of prototypes")->required()->type_name("SCENE.json...");
    options->add_out(*command, "Directory for verdicts.json and what each run leaves");
    const auto add_count = [&](const char* name, std::size_t& value, const char* text, std::size_t least) {
        add_whole_option(*command, name, value, text, {least, 100000})->capture_default_str();
    };
    add_count("--sets", plan.sets, "Sets of twins of each scene", 1);
    add_count("--twins", plan.twins, "Twins of a set", 2);
    add_count("--models", plan.models, "Exact models judged by each set", 0);
    add_whole_option(*command, "--seed", plan.seed, "Of the first set; the next ones follow")->capture_default_str();
    command->add_option("--errors", options->errors, "Errors put into models on purpose, e.g. friction,gravity, or all (default: none)")
        ->type_name("LIST")
        ->delimiter(',')
        ->check(one_of(error_names()));
    command->add_option("--sizes", options->sizes, "Their sizes [-] (default 1e-8,1e-7,1e-6)")
        ->type_name("LIST")
        ->delimiter(',')
        ->check(above_zero());
    add_count("--images", plan.images, "Wrong models of each error and size", 1);
    add_positive_option(*command, "--duration", options->duration, "Simulated time [s] of the prototypes, instead of the scenes'");
    add_format_option(*command, options->style, "Form of the tables");
    options->add_to(*command);
    command->footer(
        "Examples:\n"
        "  musim bench verdict examples/uneven_wall.json -o out/verdict --sets 12 --seed 1001\n"
        "  musim bench verdict examples/uneven_wall.json --errors all -o out/verdict\n"
        "  musim bench verdict examples/tower_prototype.json --duration 3 --errors friction --sizes 1e-6 --images 100 -o out/verdict\n"
        "An error is in one model, judged by right twins; or in models and in those twins that are images, not in copies. Errors are "
        "factors\n"
        "1 + size of a property; absolute_tolerance rounds places to size x 1 mm at every scale; lost_friction drops what one contact "
        "bore.\n"
        "The same command again, killed or not, runs what is missing in DIR; another build should have another DIR.");
    command->callback(
        [&action, options] { action = [options] { return run_again([&] { return run_bench_verdict(*options); }, options->out); }; });
}

}  // namespace musim::cli
