#include "lsdem/study/step_error.hpp"

#include <fmt/format.h>

#include "lsdem/run/run.hpp"
#include "lsdem/study/pair_text.hpp"
#include "scaling/laws/similitude.hpp"

namespace musim::lsdem {
namespace {

/// Step error of a run, by that at half its step; the yardstick is the run's.
StepError compare_steps(const Yardstick& yardstick, RunStatus status, const RunDifference& difference, const RunTrace& trace) {
    return {.status = status,
            .difference = difference,
            .parting_time = yardstick.parting_time(trace),
            .largest = yardstick.largest_difference(trace),
            .horizon = yardstick.horizon(),
            .quantities = yardstick.check_quantities(trace),
            .has_twins = yardstick.has_twins()};
}

}  // namespace

std::optional<StepError> find_step_error(const PairStudy& study) {
    if (!study.half_step) return std::nullopt;
    return compare_steps(study.yardstick(), study.half_step->run.status, study.half_step->difference, study.half_step->trace);
}

StepError estimate_step_error(const Scene& scene, Specimen specimen, const RunResult& run, const RunSettings& settings) {
    let_settle(scene, specimen, {.threads = settings.threads});
    TimePlan plan = make_time_plan(scene, specimen.model).with_finer_step(2);
    plan.samples_per_frame = 0;
    const RunResult half =
        simulate(specimen, plan, {.threads = settings.threads, .observer = {.on_progress = settings.observer.on_progress}});
    const scaling::Similitude same;
    return compare_steps(Yardstick(run, {}), half.status, compare_runs(run, half, same), trace_run(run, half, same));
}

std::string describe(const StepError& error) {
    if (error.status == RunStatus::diverged) return "At half the time step the run diverged: its step is no measure of its error.";
    std::string text = fmt::format("At half the time step velocities agree to {} ", format_percent(kPartingLevel));
    text += error.parting_time ? fmt::format("up to {:.3g} s", *error.parting_time) : "to the end";
    const bool to_horizon = error.parting_time && error.has_twins && *error.parting_time < error.horizon;
    if (to_horizon) text += fmt::format(", and to {} up to {:.3g} s", format_percent(error.largest), error.horizon);
    const QuantityCheck* const peak = find_top(error.quantities, "peak_velocity");
    if (peak != nullptr) text += fmt::format("; the peak velocity of the top changes by {}", format_percent(peak->difference));
    if (error.has_twins) return text + ": the error of the step, which twins share.";
    return text + (error.parting_time ? ": the error of the step, and late in the run chance (twins of a pair say from when)."
                                      : ": the error of the step.");
}

}  // namespace musim::lsdem
