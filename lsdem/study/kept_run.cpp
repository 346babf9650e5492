#include "lsdem/study/kept_run.hpp"

#include <optional>
#include <stdexcept>
#include <utility>

namespace musim::lsdem::study {
namespace {

std::optional<Checkpoint> find_kept(const std::optional<CheckpointSettings>& settings) {
    if (!settings || !std::filesystem::exists(settings->file)) return std::nullopt;
    try {
        return read_checkpoint(settings->file, settings->program_version);
    } catch (const std::runtime_error&) {
        return std::nullopt;
    }
}

}  // namespace

RunResult run_kept(const Specimen& specimen, const TimePlan& plan, RunStart begin, const RunSettings& settings) {
    std::optional<Checkpoint> kept = find_kept(settings.checkpoint);
    if (kept && kept->samples_done == plan.samples) return recall_finished(specimen, std::move(*kept));
    std::optional<Simulation> simulation;
    RunResult run;
    if (kept) {
        simulation.emplace(restore(specimen, *kept, settings.threads));
        run = resume(*simulation, specimen, std::move(*kept), settings);
    } else {
        simulation.emplace(specimen.model, plan.time_step, settings.threads);
        if (specimen.settling) begin.rest = settle_specimen(*simulation, specimen);
        run = simulate(*simulation, specimen, plan, std::move(begin), settings);
    }
    const bool ended = run.status != RunStatus::diverged;
    if (settings.checkpoint && ended) write_checkpoint(*settings.checkpoint, plan.samples, plan, run, *simulation);
    return run;
}

}  // namespace musim::lsdem::study
