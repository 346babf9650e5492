#include "lsdem/study/pair_member.hpp"

#include <algorithm>
#include <filesystem>
#include <stdexcept>
#include <utility>

#include "lsdem/run/run.hpp"
#include "lsdem/run/scale_specimen.hpp"

namespace musim::lsdem {
namespace {

std::optional<Checkpoint> find_kept(const std::optional<CheckpointSettings>& settings) {
    if (!settings || !std::filesystem::exists(settings->file)) return std::nullopt;
    try {
        return read_checkpoint(settings->file, settings->program_version);
    } catch (const std::runtime_error&) {
        return std::nullopt;
    }
}

/// Lengths times `length`; the rest are pure numbers.
Rest scale_rest(Rest rest, double length) {
    for (MovedBlock& moved : rest.fallen) moved.drawn *= length, moved.now *= length;
    return rest;
}

/// Counts of the whole run, as it is kept.
TimePlan find_whole_plan(const PairMember& member) {
    TimePlan plan = member.staged ? member.staged->stages.front().plan : member.plan;
    if (member.staged) plan.samples = member.staged->samples();
    return plan;
}

RunResult run_anew(Simulation& simulation, const PairMember& member, const RunSettings& settings) {
    RunStart begin{.rest = member.rest};
    if (member.specimen.settling) {
        begin.rest =
            settle_specimen(simulation, member.specimen, member.plan, {.threads = settings.threads, .observer = settings.observer});
    }
    if (member.staged) return run_stages(simulation, member.specimen, *member.staged, std::move(begin), settings);
    return simulate(simulation, member.specimen, member.plan, std::move(begin), settings);
}

}  // namespace

std::string to_string(Materials materials) { return materials == Materials::exact ? "exact" : "own"; }

std::string name_folder(std::string label) {
    std::replace(label.begin(), label.end(), ':', '-');
    return label;
}

PairMember lay_member(const std::string& label, const Scene& scene, const scaling::Similitude& similitude, const RunSettings& settings,
                      Sampling sampling) {
    std::optional<StagedMotion> staged;
    if (!scene.motions.empty()) {
        SequencePlan plan = plan_sequence(scene, sampling);
        staged = StagedMotion{std::move(plan.stages), plan.settling};
    }
    const Scene& first = staged ? staged->stages.front().scene : scene;
    LaidSpecimen laid = lay_specimen(first, settings);
    const TimePlan plan = make_time_plan(first, laid.specimen.model, sampling);
    return {label, std::move(laid.specimen), plan, similitude, {}, laid.rest, {}, false, std::move(staged)};
}

PairMember make_image(const PairMember& member, const std::string& label, const scaling::Similitude& similitude) {
    PairMember image{label,      scale_specimen(member.specimen, similitude), member.plan.scaled(similitude.time()), similitude, {},
                     member.rest};
    image.is_image = true;
    if (image.rest) *image.rest = scale_rest(*std::move(image.rest), similitude.length());
    if (member.staged) image.staged = member.staged->scaled(similitude);
    return image;
}

void drop_frames(PairMember& member) {
    member.plan.samples_per_frame = 0;
    if (!member.staged) return;
    for (SequenceStage& stage : member.staged->stages) stage.plan.samples_per_frame = 0;
}

RunResult run_member(const PairMember& member, const RunSettings& settings) {
    const TimePlan whole = find_whole_plan(member);
    std::optional<Checkpoint> kept = find_kept(settings.checkpoint);
    if (kept && kept->samples_done == whole.samples) {
        try {
            require_plan(*kept, whole);
            return recall_finished(member.specimen, std::move(*kept));
        } catch (const std::runtime_error&) {
            kept.reset();
        }
    }
    const bool goes_on = kept && !member.staged;
    if (goes_on) require_plan(*kept, whole);
    Simulation simulation =
        goes_on ? restore(member.specimen, *kept, settings.threads) : Simulation(member.specimen.model, whole.time_step, settings.threads);
    RunResult run = goes_on ? resume(simulation, member.specimen, std::move(*kept), settings) : run_anew(simulation, member, settings);
    const bool ended = run.history.samples() == whole.samples + 1;
    if (settings.checkpoint && ended) write_checkpoint(*settings.checkpoint, whole.samples, whole, run, simulation);
    return run;
}

}  // namespace musim::lsdem
