#include "lsdem/study/step_error.hpp"

#include <fmt/format.h>

#include "lsdem/run/run.hpp"
#include "lsdem/study/pair_text.hpp"
#include "scaling/laws/similitude.hpp"

namespace musim::lsdem {
namespace {

/// Of a run by that at half its step; the yardstick is the run's.
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
    let_settle(scene, specimen, settings.threads);
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
    if (error.parting_time) {
        text += fmt::format("up to {:.3g} s, and to {} up to {}", *error.parting_time, format_percent(error.largest),
                            error.has_twins ? fmt::format("the horizon ({:.3g} s)", error.horizon) : "the end");
    } else {
        text += "to the end";
    }
    const QuantityCheck* const peak = find_top(error.quantities, "peak_velocity");
    if (peak != nullptr) text += fmt::format("; the peak velocity of the top changes by {}", format_percent(peak->difference));
    return text + (error.has_twins ? ": the error of the step, which twins share." : ": the error of the step.");
}

}  // namespace musim::lsdem
