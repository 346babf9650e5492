#include "lsdem/run/run.hpp"
#include "lsdem/results/result_error.hpp"

#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>

#include "cli/commands.hpp"
#include "cli/interruption.hpp"
#include "cli/options.hpp"
#include "cli/output.hpp"
#include "cli/progress_line.hpp"
#include "cli/report.hpp"
#include "cli/result_options.hpp"
#include "cli/version.hpp"
#include "lsdem/results/failure.hpp"
#include "lsdem/results/outcome.hpp"
#include "lsdem/results/write_results.hpp"
#include "lsdem/run/progress_file.hpp"
#include "lsdem/scene/motions.hpp"
#include "lsdem/scene/scene_error.hpp"
#include "lsdem/scene/scene_json.hpp"
#include "lsdem/study/step_error.hpp"

namespace musim::cli {
namespace {

namespace fs = std::filesystem;

struct RunOptions : ResultOptions {
    std::string scene;
    std::string resume;
    std::optional<Number> duration;
    bool half_step = false;
    bool until_collapse = false;
};

/// A run, and the error of its step where that is asked for.
struct CarriedOut {
    lsdem::RunResult run;
    std::optional<lsdem::StepError> step_error;
};

/// The similitude by which the scene's record was made that of a model; nothing for other scenes.
std::optional<scaling::Similitude> find_similitude(const lsdem::Scene& scene) {
    const auto* record = std::get_if<lsdem::RecordMotion>(&scene.base_motion.source);
    if (record == nullptr || !record->scale) return std::nullopt;
    return lsdem::make_similitude(*record->scale);
}

void print_run(const lsdem::Scene& scene, const CarriedOut& done) {
    const lsdem::RunResult& run = done.run;
    print("{}: {}\n", scene.name, lsdem::to_string(run.status));
    const lsdem::Outcome outcome = lsdem::find_outcome(run);
    for (const std::string& line : lsdem::describe(outcome)) print("  {}\n", line);
    if (const auto similitude = find_similitude(scene); similitude && outcome.shaken) {
        print("  as in the prototype, of which this is a model at 1:{:.6g} by law {}:\n", 1.0 / similitude->length(),
              similitude->law_name());
        for (const std::string& line : lsdem::describe(lsdem::scale_back(outcome, *similitude))) print("    {}\n", line);
    }
    if (run.collapse_time && outcome.shaken) print("  collapsed at {:.4g} s\n", *run.collapse_time);
    if (const auto failure = lsdem::find_failure(run)) print("  {}\n", lsdem::describe(*failure));
    print("  {:.6g} s simulated in {:.2f} s, {} steps of {:.3g} s; energy balance closes to {:.2g}; state {}\n", run.final.time,
          run.wall_time, run.steps, run.time_step, run.energy_closure, run.state_hash);
    if (const auto& left = run.statistics.leaving; left && left->substeps > 1) {
        print("  block {} left its place at {:.4g} s; from then on each step was taken in {} substeps\n", left->block, left->time,
              left->substeps);
    }
    print("  {}\n",
          done.step_error ? lsdem::describe(*done.step_error) : "The error of the time step was not estimated (--half-step does).");
}

fs::path checkpoint_in(const std::string& directory) { return fs::path(directory) / lsdem::kCheckpointName; }

/// Scene and checkpoint that a run starts or continues with.
struct Begin {
    lsdem::Scene scene;
    std::string scene_text;
    std::optional<lsdem::Checkpoint> checkpoint;  ///< of a run to resume
};

Begin begin_anew(const RunOptions& options) {
    if (fs::is_directory(options.scene)) {
        throw lsdem::SceneError(
            fmt::format("{0}: is a folder, not a scene; name a scene's file, or continue the interrupted run in the folder with `musim run "
                        "--resume {0}`",
                        options.scene));
    }
    Begin begin{.scene = read_scene(options.scene), .scene_text = {}, .checkpoint = {}};
    if (options.duration) begin.scene.time.duration = options.duration->value * scaling::si::seconds;
    lsdem::check_scene(begin.scene, options.scene);
    lsdem::require_single_motion(begin.scene, "a run");
    begin.scene_text = lsdem::write_scene(begin.scene);
    return begin;
}

/// Refuses to write over the only trace of an unfinished run.
void refuse_old_checkpoint(const std::string& directory) {
    if (!fs::exists(checkpoint_in(directory))) return;
    throw lsdem::ResultError(
        fmt::format("{0}: an unfinished run left its checkpoint here; continue it with `musim run --resume {0}`, or remove "
                    "{1} to start anew",
                    directory, checkpoint_in(directory).string()));
}

void require_checkpoint(const std::string& directory) {
    if (fs::exists(checkpoint_in(directory))) return;
    const bool finished = fs::exists(fs::path(directory) / "summary.json");
    throw lsdem::ResultError(fmt::format("{}: {}", directory,
                                         finished
                                             ? "the run here has finished; there is nothing to resume"
                                             : "there is no checkpoint to resume from (a run leaves its first after 5 seconds); start the "
                                               "run anew"));
}

Begin begin_from(const std::string& directory) {
    const fs::path file = checkpoint_in(directory);
    Begin begin{.scene = {}, .scene_text = {}, .checkpoint = lsdem::read_checkpoint(file, kVersion)};
    begin.scene_text = begin.checkpoint->scene;
    begin.scene = lsdem::parse_scene(begin.scene_text, file);
    if (!begin.scene.motions.empty()) {
        throw lsdem::ResultError(fmt::format(
            "{}: the checkpoint is of a sequence of motions; continue it with `musim sequence --resume {}`", file.string(), directory));
    }
    return begin;
}

/// The work of a run, and of one at half its step.
double count_runs(const RunOptions& options) { return options.half_step ? 1.0 + lsdem::kHalfStepWork : 1.0; }

/// The settings of runs that are so much of all, from `from` to `to`.
lsdem::RunSettings part_of(lsdem::RunSettings settings, double from, double to) {
    settings.observer.on_progress = [=, report = settings.observer.on_progress](double part) { report(from + (to - from) * part); };
    return settings;
}

CarriedOut run_or_resume(Begin begin, const RunOptions& options, const lsdem::RunSettings& settings) {
    std::optional<lsdem::Checkpoint>& from = begin.checkpoint;
    const lsdem::Specimen specimen = lsdem::make_specimen(begin.scene, settings, from ? &*from : nullptr);
    const double share = 1.0 / count_runs(options);
    CarriedOut done{lsdem::run_specimen(begin.scene, specimen, std::move(from), part_of(settings, 0.0, share)), std::nullopt};
    if (options.half_step && done.run.status != lsdem::RunStatus::diverged && !done.run.collapsed_before()) {
        done.step_error = lsdem::estimate_step_error(begin.scene, specimen, done.run, part_of(settings, share, 1.0));
    }
    return done;
}

CarriedOut carry_out(Begin begin, const RunOptions& options, const std::string& directory) {
    lsdem::RunSettings settings{.threads = options.threads,
                                .runs_to_follow = count_runs(options),
                                .until_collapse = options.until_collapse || lsdem::tilts(begin.scene)};
    if (!directory.empty()) {
        settings.checkpoint = lsdem::CheckpointSettings{.file = checkpoint_in(directory),
                                                        .scene = begin.scene_text,
                                                        .program_version = kVersion,
                                                        .interval = options.checkpoint_interval,
                                                        .on_failure = note_no_checkpoint};
    }
    ProgressInParts progress(begin.scene.name, begin.checkpoint.has_value());
    settings.observer = progress.observer();
    std::optional<lsdem::ProgressFile> progress_file;
    if (!directory.empty()) progress_file.emplace(directory, begin.scene.name).listen_to(settings.observer);
    if (!begin.checkpoint) return run_or_resume(std::move(begin), options, settings);
    try {
        return run_or_resume(std::move(begin), options, settings);
    } catch (const std::runtime_error& error) {
        throw lsdem::ResultError(
            fmt::format("{}: the run cannot be continued ({}); has the scene's record or the program changed since? If so, start it anew",
                        checkpoint_in(directory).string(), error.what()));
    }
}

int run_run(const RunOptions& options) {
    const bool resumes = !options.resume.empty();
    const std::string& directory = resumes ? options.resume : options.out;
    std::optional<Begin> begin;
    if (!resumes) begin = begin_anew(options);
    // the folder first: better no run than one without a place for its results, and no checkpoint that another musim still writes
    std::optional<lsdem::ResultFolder> folder;
    if (resumes && !fs::is_directory(directory)) require_checkpoint(directory);
    if (!directory.empty()) folder.emplace(directory);
    if (resumes) {
        require_checkpoint(directory);
        begin = begin_from(directory);
    }
    if (folder) {
        lsdem::ResultOrigin origin = options.origin();
        origin.add(begin->scene);
        folder->set_origin(std::move(origin), resumes ? lsdem::Overwriting::resume : options.choice());
        if (!resumes) refuse_old_checkpoint(directory);
    }
    const lsdem::Scene scene = begin->scene;
    if (!resumes) note_cut_motions(options.scene, scene);
    const std::string scene_text = begin->scene_text;
    const CarriedOut done = carry_out(std::move(*begin), options, directory);
    const lsdem::RunResult& run = done.run;
    if (folder) {
        folder->add_run("", run, {.scene = scene_text, .program_version = kVersion});
        if (done.step_error) folder->add_json("half_step.json", lsdem::to_json(*done.step_error));
        folder->commit();
        lsdem::remove_checkpoint(checkpoint_in(directory));
    }

    if (options.json) {
        nlohmann::json summary = lsdem::make_summary(run);
        summary["half_step"] = done.step_error ? lsdem::to_json(*done.step_error) : nlohmann::json();
        print_json(summary);
    } else {
        print_run(scene, done);
        print("{}\n", folder ? "Results in " + directory : "No file of it is kept; -o DIR keeps results");
    }
    const std::string& where = resumes ? directory : options.scene;
    report_warnings(where, run);
    return report_divergence(where, run) ? kNumericalFailure : kDone;
}

}  // namespace

void add_run_command(CLI::App& app, Action& action) {
    auto options = std::make_shared<RunOptions>();
    CLI::App* command = app.add_subcommand("run", "One simulation of a scene");
    CLI::Option* scene_file = command->add_option("scene", options->scene, "Scene file (JSON, schema musim-scene/1)");
    scene_file->type_name("SCENE.json");
    CLI::Option* out = options->add_out(*command, "Directory for result.h5, result.xdmf, spine.csv and summary.json");
    CLI::Option* duration = add_positive_option(*command, "--duration", options->duration, "Simulated time [s], instead of the scene's");
    command->add_flag("--half-step", options->half_step,
                      "Run it at half its time step, too, and say up to when velocities agree: the error of the step (twice the work)");
    command->add_flag("--until-collapse", options->until_collapse, "End when the structure has collapsed; no files are kept of such a run")
        ->excludes(out)
        ->excludes("--half-step");
    command->add_option("--resume", options->resume, "Continue the run that was killed while it worked on DIR")
        ->type_name("DIR")
        ->excludes(scene_file)
        ->excludes(out)
        ->excludes(duration)
        ->excludes("--until-collapse");
    options->add_with_checkpoints_to(*command);
    command->footer(
        "Examples:\n"
        "  musim run examples/tower_prototype.json -o out/tower\n"
        "  musim run examples/tower_prototype.json --duration 1/2 --threads 1 --json\n"
        "  musim run examples/uneven_wall.json --half-step\n"
        "  musim run --resume out/tower\n"
        "A run with -o writes checkpoints into DIR, a last one on SIGINT (Ctrl-C) and SIGTERM. --resume continues from it; the results "
        "are\n"
        "the same to the last bit. The scene is the checkpoint's; a record it names must be unchanged. A finished run leaves no "
        "checkpoint.\n"
        "Results of another scene or version in DIR are not overwritten without --force (exit code 3).\n"
        "Exit code 130, 143: stopped by SIGINT, SIGTERM; 4: the run diverged; results up to then are written all the same. A doubtful run "
        "(step above the critical one, blocks "
        "deep\n"
        "in each other, open energy balance) is a warning on stderr.");
    command->callback([&action, options] {
        if (options->scene.empty() && options->resume.empty()) throw CLI::RequiredError("scene (or --resume)");
        const std::string& directory = options->resume.empty() ? options->out : options->resume;
        action = [options, directory] {
            return run_resumable([&] { return run_run(*options); }, options->half_step ? "musim run --half-step" : "musim run", directory);
        };
    });
}

}  // namespace musim::cli
