#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "lsdem/run/simulate.hpp"
#include "lsdem/scene/scene.hpp"
#include "lsdem/study/compare_runs.hpp"
#include "lsdem/study/pair.hpp"
#include "lsdem/study/verdict.hpp"

/// The error of a run's time step, as far as a run of the same specimen at half of it shows it. See docs/theory/comparison.md, "Error of
/// the step".
namespace musim::lsdem {

/// Difference of a run at half the step.
struct StepError {
    RunStatus status = RunStatus::completed;  ///< of that run
    RunDifference difference = {};
    std::optional<double> parting_time = {};  ///< when a velocity first differs by kPartingLevel [s]; nothing: never
    double largest = 0.0;                     ///< largest difference of a velocity (RunTrace::running) up to the horizon [-]
    double horizon = 0.0;                     ///< of twins; without them the end [s]
    std::vector<QuantityCheck> quantities = {};
    bool has_twins = false;
};

/// Step error of the prototype of a pair; nothing where it did not run at half its step.
std::optional<StepError> find_step_error(const PairStudy& study);

/// Runs the specimen of a scene (make_specimen) at half the step of its run. One that settles comes to rest at the step of the run, so that
/// both start from the same places. Throws what Simulation throws.
StepError estimate_step_error(const Scene& scene, Specimen specimen, const RunResult& run, const RunSettings& settings = {});

/// In a sentence: up to when velocities agree, how far they are apart at the horizon, and how the peak velocity of the top changes.
std::string describe(const StepError& error);

/// status, rms_relative_velocity_difference, parting_time_s (null: never), largest_relative_velocity_difference up to until_s (the horizon
/// of twins, or the end), quantities as in pairs.
nlohmann::json to_json(const StepError& error);

}  // namespace musim::lsdem
