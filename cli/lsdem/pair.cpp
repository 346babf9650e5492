#include <algorithm>
#include <CLI/CLI.hpp>
#include <cstddef>
#include <cstdint>
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
#include "cli/record_source.hpp"
#include "cli/report.hpp"
#include "cli/result_options.hpp"
#include "cli/version.hpp"
#include "cli/whole_option.hpp"
#include "lsdem/results/write_results.hpp"
#include "lsdem/run/progress_file.hpp"
#include "lsdem/scene/scene_error.hpp"
#include "lsdem/scene/scene_json.hpp"
#include "lsdem/study/own_models.hpp"
#include "lsdem/study/pair_plots.hpp"
#include "lsdem/study/pair_scene.hpp"
#include "lsdem/study/pair_text.hpp"

namespace musim::cli {
namespace {

namespace fs = std::filesystem;

struct PairOptions : ResultOptions {
    std::string scene;
    std::vector<std::string> models;
    std::vector<Number> lengths{{1.0 / 25.0}, {1.0 / 107.0}};
    std::string materials;
    std::string law;
    std::vector<std::string> factors;
    std::vector<std::string> own;  ///< presets and files
    RecordMotionOptions record;
    std::optional<Number> duration;
    std::string specimen = "one";
    std::optional<std::size_t> twins;
    std::uint64_t seed = 1;
    std::optional<std::size_t> specimens;
    std::optional<Share> accept;
    bool no_half_step = false;
    bool one_at_a_time = false;
};

/// Materials that are asked for; nothing: scaled models are exact, and what scenes of their own are follows from their blocks.
std::optional<lsdem::Materials> find_materials(const PairOptions& options) {
    if (options.materials.empty()) return std::nullopt;
    return options.materials == "own" ? lsdem::Materials::own : lsdem::Materials::exact;
}

void check_options(const PairOptions& options) {
    const bool own = find_materials(options) == lsdem::Materials::own;
    if (!options.models.empty() && !options.record.record.empty()) {
        throw CLI::ValidationError("--record", "scene files of models have motions of their own; put the record into all scenes");
    }
    if (options.one_at_a_time && (!own || !options.models.empty())) {
        throw CLI::ValidationError("--one-at-a-time", "exact materials distort nothing; add --materials own");
    }
    if (!options.own.empty() && options.own.size() != options.lengths.size()) {
        throw CLI::ValidationError("--material", "give one per --length, in the same order, or none");
    }
    if (!options.own.empty() && !own) {
        throw CLI::ValidationError("--material", "exact models have no material of their own; add --materials own");
    }
    if ((options.accept || options.specimens) && !own && options.models.empty()) {
        throw CLI::ValidationError(options.accept ? "--accept" : "--specimens",
                                   "exact models are held against twins alone; add --materials own");
    }
    if (options.accept && !(options.accept->value > 0.0)) throw CLI::ValidationError("--accept", "must be above zero, such as 5% or 0.05");
}

std::optional<lsdem::ChosenLaw> find_law(const PairOptions& options) {
    if (options.law.empty()) return std::nullopt;
    const std::vector<scaling::UncertainFactor> factors = parse_factors(options.factors);
    note_values_used(factors);
    return lsdem::ChosenLaw{options.law, scaling::values_of(factors)};
}

std::vector<lsdem::ModelChoice> make_choices(const PairOptions& options) {
    const std::optional<lsdem::ChosenLaw> law = find_law(options);
    std::vector<lsdem::ModelChoice> choices;
    for (const std::string& file : options.models) {
        choices.push_back({.law = law, .scene = read_scene(file)});
        lsdem::check_scene(*choices.back().scene, file);
    }
    if (!options.models.empty()) return choices;
    for (std::size_t i = 0; i < options.lengths.size(); ++i) {
        note_larger_model(options.lengths[i]);
        choices.push_back({.length = options.lengths[i], .material = options.own.empty() ? std::string() : options.own[i], .law = law});
    }
    return choices;
}

lsdem::Scene make_prototype(const PairOptions& options) {
    lsdem::Scene prototype = read_scene(options.scene);
    if (!prototype.motions.empty() && (options.duration || !options.record.record.empty())) {
        throw lsdem::SceneError(fmt::format("{}: it has a list of motions, each with its own duration; leave {} out", options.scene,
                                            options.duration ? "--duration" : "--record"));
    }
    if (!options.record.record.empty()) options.record.apply(prototype);
    if (options.duration) prototype.time.duration = options.duration->value * scaling::si::seconds;
    lsdem::check_scene(prototype, options.scene);
    return prototype;
}

std::string format_losses(const lsdem::RunDifference& difference) {
    return difference.losses ? fmt::format("{:.3g}", *difference.losses) : "-";
}

/// `parting`: nothing of the prototype.
void print_row(const std::string& label, double length, lsdem::RunStatus status, const lsdem::RunDifference* difference,
               const std::optional<double>& parting, const std::string& verdict) {
    std::string numbers = fmt::format("{:>11} {:>11} {:>11} {:>11} {:>8}", "-", "-", "-", "-", "-");
    if (difference != nullptr) {
        numbers = fmt::format("{:>11.3g} {:>11.3g} {:>11} {:>11} {:>8}", difference->rms_velocity, difference->max_velocity,
                              format_losses(*difference), parting ? fmt::format("{:.4g}", *parting) : "never",
                              difference->bitwise_identical ? "yes" : "no");
    }
    print("{:<12} {:>12.7g} {}  {}{}\n", label, length, numbers,
          status == lsdem::RunStatus::completed ? "" : lsdem::to_string(status) + ", ", verdict);
}

/// Effect of each property of a model's own material alone, the largest effect first.
void print_alone(const lsdem::PairedRun& model) {
    if (model.alone.empty()) return;
    std::vector<lsdem::LoneDistortion> alone = model.alone;
    std::sort(alone.begin(), alone.end(),
              [](const auto& a, const auto& b) { return a.difference.rms_velocity > b.difference.rms_velocity; });
    print("\nEach property of {} alone, in a model that is exact otherwise\n", model.label);
    print("{:<18} {:>10} {:>11} {:>11} {:>11}\n", "property", "factor", "rms diff.", "max diff.", "loss diff.");
    for (const lsdem::LoneDistortion& lone : alone) {
        print("{:<18} {:>10.4g} {:>11.3g} {:>11.3g} {:>11}{}\n", lone.property, lone.factor, lone.difference.rms_velocity,
              lone.difference.max_velocity, format_losses(lone.difference),
              lone.status == lsdem::RunStatus::completed ? "" : "  " + lsdem::to_string(lone.status));
    }
}

std::string describe_agreement(const lsdem::PairedRun& model) {
    if (model.materials == lsdem::Materials::own) return model.material;
    if (model.judgement.within_rounding) return "agrees to rounding";
    if (model.judgement.agreement == lsdem::Agreement::not_judged) return "not judged";
    // asked beyond the horizon only
    const double least = model.judgement.least_probability;
    const std::string probability = least < 1.0 ? fmt::format(", p {:.2g}", least) : "";
    return fmt::format("{} ({:+.1f} sd{})", lsdem::to_string(model.judgement.agreement), model.judgement.lead, probability);
}

void print_table(const lsdem::PairStudy& study) {
    print("{:<12} {:>12} {:>11} {:>11} {:>11} {:>11} {:>8}  {}\n", "run", "length", "rms diff.", "max diff.", "loss diff.", "parting [s]",
          "bitwise", "judgement");
    const lsdem::Yardstick yardstick = study.yardstick();
    print_row("prototype", 1.0, study.prototype.status, nullptr, {}, "reference");
    for (const lsdem::PairedRun& model : study.models) {
        print_row(model.label, model.run.similitude.length(), model.run.status, &model.difference, model.judgement.parting_time,
                  describe_agreement(model));
    }
    for (std::size_t i = 0; i < study.twins.size(); ++i) {
        const lsdem::PairedTwin& twin = study.twins[i];
        print_row("twin", twin.choice.length, twin.status, &twin.difference, yardstick.parting_time(study.twin_traces[i]),
                  twin.choice.last_place ? "last places moved" : "exact image");
    }
    if (study.half_step) {
        print_row("half step", 1.0, study.half_step->run.status, &study.half_step->difference,
                  yardstick.parting_time(study.half_step->trace), "error of the time step");
    }
}

/// Those that its law asks to be kept first: what it asks for, and what the model has.
void print_model_distortions(const lsdem::PairedRun& model) {
    const std::string who = model.label + (model.material.empty() ? "" : ", " + model.material);
    const std::string& law = model.run.similitude.law_name();
    std::vector<scaling::Distortion> asked, others;
    for (const scaling::Distortion& distortion : model.distortions) {
        const bool is_asked = std::find(model.asked.begin(), model.asked.end(), distortion.group) != model.asked.end();
        (is_asked ? asked : others).push_back(distortion);
    }
    if (!asked.empty()) {
        print("\nDistortions of {} that law {} does not allow\n", who, law);
        print_distortions(asked);
    }
    if (!others.empty()) {
        print("\n{} of {}{}\n", asked.empty() ? "Distortions" : "Other distortions", who,
              law == lsdem::kNoLaw ? "" : fmt::format(" that law {} allows", law));
        print_distortions(others);
    }
}

void print_study(const lsdem::ScenePair& pair) {
    const lsdem::PairStudy& study = pair.study;
    for (const std::string& line : lsdem::describe_verdict(study)) print("{}\n", line);
    const char* const materials = !study.has(lsdem::Materials::own)    ? "exact"
                                  : study.has(lsdem::Materials::exact) ? "exact and own"
                                                                       : "own";
    print("\n{}, {} materials: spine velocities v/λ_v at t/λ_t against the prototype\n", pair.prototype.name, materials);
    print_table(study);
    print(
        "`rms diff.`, `max diff.`: over the prototype's rms and largest velocity, of the spine block where they are largest;\n"
        "`parting`: prototype time at which a velocity first differs by {:g} of the largest; `loss diff.`: of the energy dissipated,\n"
        "level by level, as a part of all that the prototype dissipated; `sd`: standard deviations farther off than the twins, `p`:\n"
        "probability that a twin is as far off; `exact image`, `last places moved`: the two kinds of twins. Percentages above are of the\n"
        "largest value of the prototype on any level.\n",
        lsdem::kPartingLevel);
    for (const lsdem::PairedRun& model : study.models) {
        print_model_distortions(model);
    }
    for (const lsdem::PairedRun& model : study.models) print_alone(model);
}

void write_study(lsdem::ResultFolder& folder, const lsdem::ScenePair& pair) {
    const lsdem::PairStudy& study = pair.study;
    folder.add_run("prototype", study.prototype, {lsdem::write_scene(pair.prototype), kVersion});
    for (std::size_t m = 0; m < study.models.size(); ++m) {
        const lsdem::PairedRun& model = study.models[m];
        folder.add_run(lsdem::name_folder(model.label), model.run, {lsdem::write_scene(pair.models[m]), kVersion});
    }
    folder.add_text("spine.svg", lsdem::make_svg(lsdem::make_spine_plot(study, pair.scales, pair.prototype.name)));
    folder.add_text("departure.svg", lsdem::make_svg(lsdem::make_departure_plot(lsdem::find_departure(study), pair.prototype.name)));
    folder.add_json("pair.json", lsdem::to_json(study));
    folder.commit();
}

/// Says which runs diverged; the exit code that follows.
int judge(const std::string& scene, const lsdem::PairStudy& study) {
    bool diverged = report_divergence(scene + ", prototype", study.prototype);
    const auto place_of = [&](const lsdem::PairedRun& model) { return model.scene ? model.scene->file : scene + ", " + model.label; };
    for (const lsdem::PairedRun& model : study.models) diverged |= report_divergence(place_of(model), model.run);
    const auto twin = std::find_if(study.twins.begin(), study.twins.end(),
                                   [](const lsdem::PairedTwin& t) { return t.status == lsdem::RunStatus::diverged; });
    if (!diverged && twin != study.twins.end()) {
        note("musim: error: {}: a twin of length {:.6g} diverged where the prototype did not; take a smaller \"safety\"\n", scene,
             twin->choice.length);
    }
    if (study.diverged()) return kNumericalFailure;
    report_warnings(scene + ", prototype", study.prototype);
    for (const lsdem::PairedRun& model : study.models) report_warnings(place_of(model), model.run);
    const auto refused = [&](const lsdem::PairedRun& model) { return !lsdem::judge_own(study, model).accepted.value_or(true); };
    if (std::any_of(study.models.begin(), study.models.end(), refused)) return kNotAccepted;
    if (study.tolerance && study.scaling() == lsdem::Agreement::agree) return kDone;
    const bool judged = study.agreement() != lsdem::Agreement::not_judged;
    return study.consistent() || !judged ? kDone : kCheckFailed;
}

int run_pair(const PairOptions& options) {
    check_options(options);
    const lsdem::Scene prototype = make_prototype(options);
    const std::vector<lsdem::ModelChoice> choices = make_choices(options);
    lsdem::ResultOrigin origin = options.origin_with_options();
    origin.add(prototype);
    for (const lsdem::ModelChoice& choice : choices) {
        if (choice.scene) origin.add(*choice.scene, choice.scene->name + ": ");
    }
    std::optional<lsdem::ResultFolder> folder = options.make_folder(std::move(origin));
    note_cut_motions(options.scene, prototype);

    std::optional<lsdem::ScenePair> pair;
    {
        ProgressInParts progress(prototype.name);
        lsdem::RunSettings settings{.threads = options.threads, .observer = progress.observer()};
        if (folder) {
            settings.checkpoint = lsdem::CheckpointSettings{
                .file = options.out,
                .scene = lsdem::write_scene(prototype),
                .program_version = kVersion,
                .interval = options.checkpoint_interval,
                .on_failure = [](const std::string& why) { note_at_end("musim: warning: no checkpoint: " + why); }};
        }
        std::optional<lsdem::ProgressFile> progress_file;
        if (folder) progress_file.emplace(options.out, prototype.name).listen_to(settings.observer);
        lsdem::PairSceneSettings how{.specimen = options.specimen == "each" ? lsdem::PairSpecimen::each : lsdem::PairSpecimen::one,
                                     .judging = {.twins = options.twins, .seed = options.seed, .half_step = !options.no_half_step},
                                     .one_at_a_time = options.one_at_a_time,
                                     .specimens = options.specimens,
                                     .accept = options.accept ? std::optional(options.accept->value) : std::nullopt};
        how.judging.on_spare = [&, report = progress.of_spare()](double part) {
            report(part);
            if (progress_file) progress_file->report_spare(part);
        };
        pair = lsdem::pair_scene(prototype, choices, find_materials(options), settings, how);
    }
    for (const scaling::SolvedLaw& law : pair->laws) note_overruled(law);
    if (folder) {
        if (pair->resumed) note("{}: went on from what a pair that was killed had left in {}\n", options.scene, pair->unfinished.string());
        write_study(*folder, *pair);
        std::error_code ignored;
        fs::remove_all(pair->unfinished, ignored);
    }

    if (options.json) {
        print_json(lsdem::to_json(pair->study));
    } else {
        print_study(*pair);
        if (folder) print("Results in {}, pictures spine.svg and departure.svg there\n", options.out);
    }
    return judge(options.scene, pair->study);
}

/// Which models, of what and by which law; whether they are accepted.
void add_model_options(CLI::App& command, PairOptions& options) {
    CLI::Option* models =
        command.add_option("models", options.models, "Scene files of models of the same blocks, instead of scaling the prototype")
            ->type_name("MODEL.json...");
    add_positive_option(command, "--length", options.lengths, "Length factor of a model; repeat for several (default 1/25 and 1/107)")
        ->excludes(models);
    command
        .add_option("--materials", options.materials,
                    "exact: scaled so that every group is equal; own: measured for each scale (default: exact; scene files are judged "
                    "like exact models when they have the prototype's blocks at their places)")
        ->check(one_of({"exact", "own"}));
    CLI::Option* law =
        command
            .add_option("--law", options.law,
                        "Scale and shake by this law of `musim scale --laws` or law file (default: exact; of own materials mu; of "
                        "scenes what their base motions show)")
            ->type_name("LAW");
    command.add_option("--set", options.factors, "Factor of another quantity of the law, e.g. mu=0.63/0.59; repeat for several")
        ->type_name("NAME=NUMBER")
        ->expected(1)
        ->take_all()
        ->needs(law);
    command
        .add_option(
            "--material", options.own,
            "Own material of each model: a preset, a material file, or a scene whose it is (default: the one measured at that scale)")
        ->type_name("PRESET|FILE")
        ->excludes(models);
    add_whole_option(command, "--specimens", options.specimens,
                     "Other specimens of the prototype to hold own models against (default: 4 when block heights are drawn)", {0, 1000});
    add_number_option(command, "--accept", options.accept,
                      "Accept own models, and scene files, whose peak velocity and residual displacement of the top and losses differ by "
                      "no more, e.g. 5%; else exit code 6");
    command.add_flag("--one-at-a-time", options.one_at_a_time,
                     "With own materials: also run a model for each property that differs, exact otherwise, and say what it does alone");
}

/// Options of the measures that models are judged by.
void add_judging_options(CLI::App& command, PairOptions& options) {
    add_whole_option(command, "--twins", options.twins,
                     "Twins to judge by; 0: none (default: none when models agree to rounding, else 2 or 8)", {0, 1000});
    add_whole_option(command, "--seed", options.seed, "Of the twins")->capture_default_str();
    command
        .add_option("--specimen", options.specimen, "one: exact models start from the prototype's specimen; each: every scale lays its own")
        ->check(one_of({"one", "each"}))
        ->capture_default_str();
    command.add_flag("--no-half-step", options.no_half_step, "Leave out the prototype's run at half its time step");
}

}  // namespace

void add_pair_command(CLI::App& app, Action& action) {
    auto options = std::make_shared<PairOptions>();
    CLI::App* command = app.add_subcommand("pair", "A scene as prototype and as models at other scales, compared in dimensionless form");
    command->add_option("scene", options->scene, "Scene file of the prototype")->required()->type_name("SCENE.json");
    add_model_options(*command, *options);
    add_judging_options(*command, *options);
    options->record.add_to(*command, "Shake with the strong motion of this record instead of the scene's");
    options->add_out(*command, "Directory: a folder per run, spine.svg, departure.svg, pair.json");
    add_positive_option(*command, "--duration", options->duration, "Simulated time of the prototype [s], instead of the scene's");
    options->add_with_checkpoints_to(*command);
    command->footer(
        "Examples:\n"
        "  musim pair examples/tower_prototype.json -o out/pair\n"
        "  musim pair examples/tower_prototype.json --length 1/16 --length 1/64 --json\n"
        "  musim pair examples/tower_prototype.json --length 1/25 --law centrifuge\n"
        "  musim pair examples/tower_prototype.json --length 1/107 --record CICLC.v1 --component x=360 -o out/ridgecrest\n"
        "  musim pair examples/tower_prototype.json --length 1/107 --materials own --material aluminium --accept 5%\n"
        "  musim pair examples/tower_prototype.json --length 1/107 --materials own --law froude\n"
        "  musim pair examples/tower_prototype.json my_model.json\n"
        "  musim pair examples/tower_prototype.json --length 1/107 --materials own --one-at-a-time\n"
        "  musim pair examples/uneven_wall.json --twins 8 --seed 2\n"
        "Twins are the prototype in other units, or with coordinates moved by one unit in the last place: what rounding alone may do. A\n"
        "model differs when it parts from the prototype earlier than they do, or its peaks, residuals or losses lie outside their "
        "scatter.\n"
        "With -o, specimens and runs are kept in DIR until the results are written: the same command resumes an interrupted pair.\n"
        "Results of another scene, version or options in DIR are not overwritten without --force (exit code 3).\n"
        "Models of their own material are distorted, and their specimen is one of many: their differences are held against twins and "
        "other\n"
        "specimens of the prototype. A scene file with the prototype's blocks at their places, in the same units, is judged like an exact\n"
        "model, and the keys in which it differs are listed; other ones (heights drawn anew, another scale) are models of their own, "
        "unless\n"
        "--materials says how to judge them. Exit code 5: a model that is judged like an exact one differs, or nothing could be decided;\n"
        "6: a model is not accepted (--accept), which decides where it is given.");
    command->callback([&action, options] { action = [options] { return run_again([&] { return run_pair(*options); }, options->out); }; });
}

}  // namespace musim::cli
