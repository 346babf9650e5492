#include "lsdem/run/lay_specimen.hpp"

#include <filesystem>

#include "lsdem/run/run.hpp"

namespace musim::lsdem {

LaidSpecimen lay_specimen(const Scene& scene, RunSettings settings) {
    std::optional<Checkpoint> from;
    if (settings.checkpoint && std::filesystem::exists(settings.checkpoint->file)) {
        from = read_checkpoint(settings.checkpoint->file, settings.checkpoint->program_version);
    }
    LaidSpecimen laid{make_specimen(scene, settings, from ? &*from : nullptr)};
    Specimen& specimen = laid.specimen;
    if (!specimen.settling) return laid;
    const TimePlan plan = make_time_plan(scene, specimen.model);
    Simulation simulation(specimen.model, plan.time_step, settings.threads);
    if (settings.checkpoint && !(from && from->places)) {
        RunResult none;
        write_checkpoint(*keep_places(settings, specimen).checkpoint, 0, plan, none, simulation);
    }
    laid.rest = settle_specimen(simulation, specimen);
    put_in_place(find_places(simulation), specimen);
    specimen.settling.reset();
    return laid;
}

}  // namespace musim::lsdem
