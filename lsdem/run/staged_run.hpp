#pragma once

#include <optional>
#include <vector>

#include "lsdem/run/rest_phase.hpp"
#include "lsdem/run/sequence_plan.hpp"
#include "lsdem/run/simulate.hpp"
#include "scaling/laws/similitude.hpp"

namespace musim::lsdem {

/// Several motions that shake a specimen one after another.
struct StagedMotion {
    std::vector<SequenceStage> stages;  ///< motions, plans and pauses; the first motion is the specimen's
    Settling settling;                  ///< how it comes to rest between motions

    /// For an exact image of the specimen (scale_specimen).
    StagedMotion scaled(const scaling::Similitude& similitude) const;
    /// At another time step: the stages' over `times`, with as many more steps to a sample.
    StagedMotion with_finer_step(std::uint64_t times) const;
    std::uint64_t samples() const;  ///< of all stages, after the one at t = 0
};

/// Start of the next stage, taken over from one that has reached its end. `rest_phase`: how it came to rest between them; nothing when it
/// did not.
RunStart pass_on(const Simulation& simulation, const TimePlan& plan, std::size_t stage, const RunResult& run,
                 const std::optional<RestPhaseEnd>& rest_phase);

/// Shakes a specimen with the motions, one after another, until it has collapsed, in memory, and joins the stages as one run: run_sequence
/// does the same and stores them one by one. The simulation is then at the end of the last.
///
/// In the run that comes of it pauses are cut out of the times, but not out of displacements; energies add up; rotations are from the first
/// start; energy_closure is the worst of the stages; of several stages there are no readings of sensors.
RunResult run_stages(Simulation& simulation, const Specimen& specimen, const StagedMotion& motion, RunStart begin,
                     const RunSettings& settings);

}  // namespace musim::lsdem
