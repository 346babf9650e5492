#pragma once

#include <functional>
#include <optional>

#include "lsdem/motion/simulation.hpp"
#include "lsdem/results/checkpoint.hpp"
#include "lsdem/run/sequence_plan.hpp"
#include "lsdem/run/settle.hpp"

namespace musim::lsdem {

/// Reports in a rest phase, at every check; either may be empty.
struct RestPhaseWatch {
    std::function<void(double, std::uint64_t)> on_progress = {};  ///< a guess of the part that is done, 0 to 1, and the steps taken
    std::function<void(const RestPhaseState&, const Simulation&)> on_state = {};  ///< where it stands
};

/// End of a rest phase.
struct RestPhaseEnd {
    Rest rest;
    Vector3 moved = Vector3::Zero();  ///< displacement of the base since the start of the stage [m]
    double wall_time = 0.0;           ///< [s]
};

/// Brings base and structure to rest after the motion of a stage, or up to the structure's collapse, and looks for falls meanwhile; or
/// carries that on from `from`, with the simulation that was saved there. `run`, of the stage, takes falls, collapse and divergence. The
/// simulation is then ready for the next motion (Simulation::begin_motion); when something is thrown it is gone.
RestPhaseEnd come_to_rest(Simulation& simulation, const SequenceStage& stage, const Settling& settling, RunResult& run,
                          const RestPhaseWatch& watch, const std::optional<RestPhaseState>& from = {});

/// The motion that the base has in a rest phase, for restoring its simulation.
BaseComponents find_motion(const SequenceStage& stage, const RestPhaseState& state);

}  // namespace musim::lsdem
