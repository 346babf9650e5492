#include "lsdem/run/sequence.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <nlohmann/json.hpp>
#include <optional>
#include <stdexcept>
#include <utility>

#include "lsdem/results/result_error.hpp"
#include "lsdem/results/write_results.hpp"
#include "lsdem/run/rest_phase.hpp"
#include "lsdem/run/run.hpp"
#include "lsdem/run/sequence_plan.hpp"
#include "lsdem/run/staged_run.hpp"
#include "lsdem/scene/motions.hpp"
#include "lsdem/scene/scene_json.hpp"
#include "scaling/setting.hpp"

namespace musim::lsdem {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

/// Time that a structure that stands takes to come to rest, over 1/α, until it has been seen: its energy decays by about that rate, from
/// what shaking leaves to Settling::rest, 1e-6 of it [-].
constexpr double kRestLength = 14.0;

/// Part of a decay from which on its length is extrapolated [-].
constexpr double kClearDecay = 0.1;

double steps_of(const SequencePlan& plan) {
    double steps = 0.0;
    for (const SequenceStage& stage : plan.stages) steps += static_cast<double>(stage.plan.steps());
    return steps;
}

/// Settings of a stage's run: the preparation of its specimen, and the place of its checkpoints.
RunSettings find_run_settings(const Scene& scene, const SequencePlan& plan, const SequenceSettings& settings) {
    return {.threads = settings.threads,
            .observer = settings.observer,
            .runs_to_follow = steps_of(plan) / static_cast<double>(plan.stages.front().plan.steps()),
            .checkpoint = CheckpointSettings{.file = settings.directory / kCheckpointName,
                                             .scene = write_scene(scene),
                                             .program_version = settings.version,
                                             .interval = settings.checkpoint_interval,
                                             .on_failure = settings.on_no_checkpoint}};
}

/// One sequence on its way through its stages.
class Sequence {
  public:
    Sequence(const Scene& scene, SequencePlan plan, ResultFolder& folder, const SequenceSettings& settings)
        : name_(scene.name),
          plan_(std::move(plan)),
          checkpoint_(keep_places(find_run_settings(scene, plan_, settings), plan_.specimen).checkpoint),
          folder_(folder),
          settings_(settings) {
        rest_length_ = kRestLength / (plan_.settling.damping_rate * plan_.stages.front().plan.time_step);
    }

    /// From the start, or from where its specimen was coming to rest.
    SequenceSummary run(const RunSettings& settling, const Checkpoint* from = nullptr) {
        const Clock::time_point start = Clock::now();
        Simulation simulation(plan_.specimen.model, plan_.stages.front().plan.time_step, settings_.threads);
        RunStart begin;
        begin.rest = settle_specimen(simulation, plan_.specimen, plan_.stages.front().plan, keep_places(settling, plan_.specimen), from);
        begin.wall_time = std::chrono::duration<double>(Clock::now() - start).count();
        RunResult first = simulate(simulation, plan_.specimen, plan_.stages.front().plan, std::move(begin), settings_of(0));
        return carry_on(simulation, 0, std::move(first));
    }

    SequenceSummary resume(Checkpoint checkpoint) {
        const std::size_t stage = checkpoint.run.origin ? checkpoint.run.origin->stage : 0;
        const std::optional<RestPhaseState> rest_phase = checkpoint.rest_phase;
        auto [simulation, run] = continue_stage(stage, std::move(checkpoint));
        return carry_on(simulation, stage, std::move(run), rest_phase);
    }

  private:
    std::pair<Simulation, RunResult> continue_stage(std::size_t stage, Checkpoint checkpoint) {
        try {
            if (stage >= plan_.stages.size()) throw std::runtime_error("checkpoint: it is of a stage that the scene does not have");
            const SequenceStage& now = plan_.stages[stage];
            require_plan(checkpoint, now.plan);
            plan_.specimen.model.ground.motion = checkpoint.rest_phase ? find_motion(now, *checkpoint.rest_phase) : now.motion;
            Simulation simulation = restore(plan_.specimen, checkpoint, settings_.threads);
            RunResult run = checkpoint.rest_phase ? recall_finished(plan_.specimen, std::move(checkpoint))
                                                  : lsdem::resume(simulation, plan_.specimen, std::move(checkpoint), settings_of(stage));
            return {std::move(simulation), std::move(run)};
        } catch (const std::runtime_error& error) {
            throw ResultError(
                fmt::format("{}: the sequence cannot be continued ({}); has a record of the scene or the program changed since? If "
                            "so, start it anew",
                            (settings_.directory / kCheckpointName).string(), error.what()));
        }
    }

    /// From the end of the motion of `stage`, or from within the rest phase after it.
    SequenceSummary carry_on(Simulation& simulation, std::size_t stage, RunResult run, std::optional<RestPhaseState> rest_phase = {}) {
        while (true) {
            std::optional<RunStart> next;
            if (run.status == RunStatus::completed && stage + 1 < plan_.stages.size()) {
                std::optional<RestPhaseEnd> end;
                if (plan_.stages[stage + 1].settle) end = come_to_rest_after(simulation, stage, run, rest_phase);
                next = pass_on(simulation, plan_.stages[stage].plan, stage, run, end);
            }
            rest_phase.reset();
            store(stage, run);
            if (run.status != RunStatus::completed || !next) return summarize(stage + 1);
            ++stage;
            simulation.begin_motion(plan_.stages[stage].motion);
            run = simulate(simulation, plan_.specimen, plan_.stages[stage].plan, std::move(*next), settings_of(stage));
        }
    }

    RestPhaseEnd come_to_rest_after(Simulation& simulation, std::size_t stage, RunResult& run, const std::optional<RestPhaseState>& from) {
        const TimePlan& plan = plan_.stages[stage].plan;
        const CheckpointSettings checkpoint = *settings_of(stage).checkpoint;
        if (!from) write_checkpoint(checkpoint, plan.samples, plan, run, simulation);
        CheckpointWriter checkpoints(checkpoint);
        const double before = work_before(stage) + motion_work(stage);
        RestPhaseWatch watch;
        watch.on_progress = [this, stage, before](double part, std::uint64_t steps) {
            const auto taken = static_cast<double>(steps);
            if (part > kClearDecay) rest_length_ = taken / part;
            report(before + taken, rest_work(stage) - taken + work_after(stage));
        };
        watch.on_state = [&](const RestPhaseState& state, const Simulation& now) {
            checkpoints.after_look([&](const CheckpointSettings& to) { write_checkpoint(to, plan.samples, plan, run, now, state); });
        };
        return come_to_rest(simulation, plan_.stages[stage], plan_.settling, run, watch, from);
    }

    /// Work in steps: of the motion of a stage, of coming to rest after it, of all before it, and of all after it.
    double motion_work(std::size_t stage) const { return static_cast<double>(plan_.stages[stage].plan.steps()); }
    double rest_work(std::size_t stage) const {
        const bool comes_to_rest = stage + 1 < plan_.stages.size() && plan_.stages[stage + 1].settle;
        return comes_to_rest ? rest_length_ : 0.0;
    }
    double work_of(std::size_t first, std::size_t last) const {
        double work = 0.0;
        for (std::size_t k = first; k < last; ++k) work += motion_work(k) + rest_work(k);
        return work;
    }
    double work_before(std::size_t stage) const { return work_of(0, stage); }
    double work_after(std::size_t stage) const { return work_of(stage + 1, plan_.stages.size()); }
    /// Progress of all; what is left is known better and better, and the part that is reported never falls for that.
    void report(double done, double left) {
        done_ = std::max(done_, done / (done + std::max(left, 0.0)));
        if (settings_.observer.on_progress) settings_.observer.on_progress(done_);
    }

    RunSettings settings_of(std::size_t stage) {
        const double before = work_before(stage), own = motion_work(stage), after = rest_work(stage) + work_after(stage);
        return {.threads = settings_.threads,
                .observer = {.on_progress = [this, before, own,
                                             after](double part) { report(before + own * part, own * (1.0 - part) + after); },
                             .on_sample = settings_.observer.on_sample},
                .checkpoint = checkpoint_};
    }

    void store(std::size_t stage, const RunResult& run) {
        const SequenceStage& now = plan_.stages[stage];
        folder_.add_run(now.folder, run, {.scene = write_scene(now.scene), .program_version = settings_.version});
        folder_.commit();
        if (settings_.on_stage) settings_.on_stage(now.folder);
    }

    /// Summary of the stages that were run, read back, so that it does not depend on how often the work was interrupted.
    SequenceSummary summarize(std::size_t stages) {
        std::vector<StageFolder> folders;
        for (std::size_t k = 0; k < stages; ++k) folders.push_back({plan_.stages[k].name, plan_.stages[k].folder});
        SequenceSummary summary = summarize_sequence(settings_.directory, name_, plan_.stages.size(), folders);
        folder_.add_json("sequence.json", to_json(summary));
        folder_.add_text("sequence.csv", make_sequence_csv(summary));
        folder_.add_text("sequence_levels.csv", make_sequence_levels_csv(summary));
        folder_.commit();
        remove_checkpoint(settings_.directory / kCheckpointName);
        return summary;
    }

    std::string name_;
    SequencePlan plan_;
    std::optional<CheckpointSettings> checkpoint_;
    ResultFolder& folder_;
    const SequenceSettings& settings_;
    double rest_length_ = 0.0;  ///< steps in which the structure comes to rest, as far as is known
    double done_ = 0.0;         ///< part of the whole
};

/// Refuses to write over an unfinished sequence.
void refuse_old_checkpoint(const fs::path& directory) {
    if (fs::exists(directory / kCheckpointName)) {
        throw ResultError(fmt::format("{}: an unfinished run left its checkpoint here", directory.string()),
                          Remedy{"continue it with ", Setting::sequence_resumption, " ", directory.string(), ", or remove ",
                                 (directory / kCheckpointName).string(), " and the stages to start anew"});
    }
}

ResultOrigin find_origin(const Scene& scene, const SequenceSettings& settings) {
    ResultOrigin origin{.command = "sequence", .program_version = settings.version, .parts = {}};
    origin.add(scene);
    return origin;
}

void require_checkpoint(const fs::path& directory) {
    if (fs::exists(directory / kCheckpointName)) return;
    const bool finished = fs::exists(directory / "sequence.json");
    throw ResultError(fmt::format("{}: {}", directory.string(),
                                  finished ? "the sequence here has finished; there is nothing to resume"
                                           : "there is no checkpoint to resume from (a sequence leaves its first after 5 "
                                             "seconds, or when its first stage ends); start it anew"));
}

}  // namespace

SequenceSummary run_sequence(const Scene& scene, const SequenceSettings& settings) {
    SequencePlan plan = plan_sequence(scene);
    ResultFolder folder(settings.directory, find_origin(scene, settings), settings.force ? Overwriting::force : Overwriting::refuse);
    refuse_old_checkpoint(settings.directory);
    const RunSettings run_settings = find_run_settings(scene, plan, settings);
    plan.specimen = make_specimen(plan.stages.front().scene, run_settings);
    return Sequence(scene, std::move(plan), folder, settings).run(run_settings);
}

SequenceSummary resume_sequence(const SequenceSettings& settings) {
    if (!fs::is_directory(settings.directory)) require_checkpoint(settings.directory);
    // a checkpoint is read once nobody else writes there
    ResultFolder folder(settings.directory);
    require_checkpoint(settings.directory);
    const fs::path file = settings.directory / kCheckpointName;
    Checkpoint checkpoint = read_checkpoint(file, settings.version);
    const Scene scene = parse_scene(checkpoint.scene, file);
    if (scene.motions.empty()) {
        throw ResultError(fmt::format("{}: the checkpoint is of a single run", file.string()),
                          Remedy{"continue it with ", Setting::run_resumption, " ", settings.directory.string()});
    }
    folder.set_origin(find_origin(scene, settings), Overwriting::resume);
    SequencePlan plan = plan_sequence(scene);
    const RunSettings run_settings = find_run_settings(scene, plan, settings);
    plan.specimen = make_specimen(plan.stages.front().scene, run_settings, &checkpoint);
    Sequence sequence(scene, std::move(plan), folder, settings);
    const bool is_shaken = !checkpoint.preparation && !checkpoint.settling;
    return is_shaken ? sequence.resume(std::move(checkpoint)) : sequence.run(run_settings, &checkpoint);
}

}  // namespace musim::lsdem
