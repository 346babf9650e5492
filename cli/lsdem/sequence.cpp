#include "lsdem/run/sequence.hpp"

#include <CLI/CLI.hpp>
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
#include "cli/report.hpp"
#include "cli/result_options.hpp"
#include "cli/version.hpp"
#include "lsdem/run/progress_file.hpp"
#include "lsdem/scene/scene_json.hpp"
#include "scaling/units.hpp"

namespace musim::cli {
namespace {

struct SequenceOptions : ResultOptions {
    std::string scene;
    std::string resume;

    const std::string& directory() const { return resume.empty() ? out : resume; }
};

lsdem::SequenceSummary carry_out(const SequenceOptions& options) {
    const bool resumes = !options.resume.empty();
    ProgressInParts progress(resumes ? options.resume : options.scene, resumes);
    lsdem::SequenceSettings settings{.directory = options.directory(),
                                     .version = kVersion,
                                     .threads = options.threads,
                                     .force = options.force,
                                     .checkpoint_interval = options.checkpoint_interval,
                                     .observer = progress.observer(),
                                     .on_no_checkpoint = note_no_checkpoint};
    std::optional<lsdem::Scene> scene;
    if (!resumes) {
        scene = read_scene(options.scene);
        note_cut_motions(options.scene, *scene);
    }
    lsdem::ProgressFile progress_file(options.directory(), scene ? scene->name : options.resume);
    progress_file.listen_to(settings.observer);
    return scene ? lsdem::run_sequence(*scene, settings) : lsdem::resume_sequence(settings);
}

void print_sequence(const lsdem::SequenceSummary& summary) {
    print("{}: {} of {} motions, {:.6g} s of shaking, {}\n", summary.name, summary.stages.size(), summary.planned, summary.duration(),
          lsdem::to_string(summary.status()));
    print("  {:>5} {:<20} {:>10} {:>10} {:>10} {:>10} {:>8}  {}\n", "stage", "name", "base v", "base a", "damage", "damage", "fallen",
          "status");
    print("  {:>5} {:<20} {:>10} {:>10} {:>10} {:>10} {:>10} {:>8}\n", "", "", "[m/s]", "[g]", "at start", "of stage", "total", "blocks");
    for (std::size_t k = 0; k < summary.stages.size(); ++k) {
        const lsdem::StageSummary& stage = summary.stages[k];
        print("  {:>5} {:<20.20} {:>10.4g} {:>10.4g} {:>10.4g} {:>10.4g} {:>10.4g} {:>8}  {}\n", k + 1, stage.where.name,
              stage.peak_velocity, stage.peak_acceleration / scaling::kStandardGravity.value(),
              stage.at_start ? stage.at_start->damage.index : 0.0, stage.of_stage.damage.index, stage.of_sequence.damage.index,
              stage.fallen, lsdem::to_string(stage.status));
    }
    for (const lsdem::StageSummary& stage : summary.stages) {
        if (!stage.pga.empty()) print("  {} {}\n", stage.where.folder, stage.pga);
    }
    if (summary.stages.front().collapsed_before) {
        print("  collapsed while it was prepared; no motion was run\n");
    } else if (const auto time = summary.collapse_time()) {
        const lsdem::StageSummary& last = summary.stages.back();
        print("  collapsed {:.4g} s after the start of {}{}, {:.4g} s of shaking in all\n", *last.collapse_time, last.where.folder,
              *last.collapse_time > last.duration ? " (while it came to rest after the motion)" : "", *time);
    }
    if (summary.failure) print("  {}\n", lsdem::describe(*summary.failure));
}

/// One line on stderr for what is wrong or doubtful; the exit code.
int report_stages(const std::string& where, const lsdem::SequenceSummary& summary) {
    for (const lsdem::StageSummary& stage : summary.stages) {
        for (const std::string& warning : stage.warnings) note("musim: warning: {}: {}: {}\n", where, stage.where.folder, warning);
    }
    const lsdem::StageSummary& last = summary.stages.back();
    if (last.divergence.empty()) return kDone;
    note("musim: error: {}: {}: {}\n", where, last.where.folder, last.divergence);
    return kNumericalFailure;
}

int run_sequence(const SequenceOptions& options) {
    const lsdem::SequenceSummary summary = carry_out(options);
    if (options.json) {
        print_json(lsdem::to_json(summary));
    } else {
        print_sequence(summary);
        print("Results in {}\n", options.directory());
    }
    return report_stages(options.resume.empty() ? options.scene : options.resume, summary);
}

}  // namespace

void add_sequence_command(CLI::App& app, Action& action) {
    auto options = std::make_shared<SequenceOptions>();
    CLI::App* command = app.add_subcommand("sequence", "Several motions one after another on the same structure, until it has collapsed");
    CLI::Option* scene_file = command->add_option("scene", options->scene, "Scene file with a list of \"motions\"");
    scene_file->type_name("SCENE.json");
    CLI::Option* out = options->add_out(*command, "Directory for a folder per stage, sequence.json and two CSV files");
    command->add_option("--resume", options->resume, "Continue the sequence that was killed while it worked on DIR")
        ->type_name("DIR")
        ->excludes(scene_file)
        ->excludes(out);
    options->add_with_checkpoints_to(*command);
    command->footer(
        "Examples:\n"
        "  musim sequence examples/aftershocks.json -o out/aftershocks\n"
        "  musim sequence --resume out/aftershocks\n"
        "  musim response out/aftershocks/stage-02-shock --json\n"
        "In the scene, \"motions\": [{ \"base_motion\": { ... }, \"name\": ..., \"duration\": ..., \"repeat\": 4, \"settle\": false }, "
        "...] stands\n"
        "instead of \"base_motion\"; \"factors\": { \"velocity\": 1.5 } in a base_motion makes it 1.5 times as strong. The structure keeps "
        "its\n"
        "positions, damage and contacts; between motions it comes to rest unless \"settle\" is false. Every stage is stored as a run.\n"
        "Results of another scene or version in DIR are not overwritten without --force (exit code 3).\n"
        "Exit code 4: a stage diverged; what was done is stored all the same.");
    command->callback([&action, options] {
        if (options->scene.empty() && options->resume.empty()) throw CLI::RequiredError("scene (or --resume)");
        if (options->resume.empty() && options->out.empty()) throw CLI::RequiredError("--out");
        action = [options] { return run_resumable([&] { return run_sequence(*options); }, "musim sequence", options->directory()); };
    });
}

}  // namespace musim::cli
