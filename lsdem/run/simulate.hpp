#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "lsdem/model.hpp"
#include "lsdem/results/checkpoint.hpp"
#include "lsdem/results/history.hpp"
#include "lsdem/results/time_plan.hpp"
#include "lsdem/run/settle.hpp"
#include "lsdem/scene/placed_sensors.hpp"
#include "lsdem/scene/resting_pose.hpp"

namespace musim::lsdem {

/// A model with the places in it that results speak of.
struct Specimen {
    Model model;
    Spine spine;
    std::vector<int> layer;              ///< of every block, from 1 at the base; 0: in no layer
    std::optional<Settling> settling;    ///< how it comes to rest before t = 0; nothing: it starts as it is
    std::vector<int> level = {};         ///< of every block, from 1 at the base, see StructureInfo; empty: the layers
    std::vector<std::string> name = {};  ///< of listed blocks, see BlockTable::name
    std::vector<std::string> load = {};  ///< names of the loads
    Beginning beginning = Beginning::listed;
    std::vector<BoxPose> drawn = {};  ///< the blocks as the scene has them; empty: not known
    std::vector<PlacedSensor> sensors = {};
    double preparation_work = 0.0;  ///< that it took so far, for the progress of what follows [block steps]
};

/// Who watches a run; none of it changes the results. Parts are from 0 to 1.
struct RunObserver {
    std::function<void(double)> on_progress = {};     ///< receives the part that is done every few steps, from the thread that runs
    std::function<void(double)> on_preparation = {};  ///< likewise before, of the preparation and the runs that follow it: one scale
    /// Receives, before that, the part at the end of all that may not be needed: how long a specimen takes to come to rest is known as a
    /// range.
    std::function<void(double)> on_preparation_spare = {};
    std::function<void(const RunResult&, const TimePlan&)> on_sample = {};  ///< called after every sample with what there is so far
};

/// Settings of carrying out a run; none of them changes the results, but that until_collapse leaves out what follows the collapse.
struct RunSettings {
    int threads = 1;  ///< at most; scaling::count_usable_cores() for all cores
    RunObserver observer = {};
    double preparations_to_follow = 0.0;                ///< how many others that cost as much follow a preparation; for its progress
    double runs_to_follow = 1.0;                        ///< how many runs of its scene, by their work, follow a preparation; likewise
    std::optional<CheckpointSettings> checkpoint = {};  ///< none: a run that is killed is lost
    bool until_collapse = false;                        ///< ends a run at the sample at which its structure has collapsed
};

/// A structure has collapsed when this fraction of its blocks has fallen (has_fallen). One in twenty: a few blocks may
/// leave the free edges of a tower that stands; with fewer than 20 blocks it means any one of them. Changes the label only.
inline constexpr double kCollapsedFraction = 0.05;

/// The blocks of a specimen, as results have them.
BlockTable make_block_table(const Specimen& specimen);

/// Lets a specimen come to rest, when it asks for that, and runs it to the end of its plan, or until it diverges; where it collapsed while
/// it was prepared (note_fallen) it is not run: there is one sample, and the collapse is at its time, zero. Time, energy balance and
/// rotations count from rest. It comes to rest from where `from` was, if that was in it. Throws std::invalid_argument as Simulation does.
RunResult simulate(const Specimen& specimen, const TimePlan& plan, const RunSettings& settings = {}, const Checkpoint* from = nullptr);

/// State that a run starts with besides its specimen, when it is one of several on the same structure.
struct RunStart {
    std::optional<Rest> rest = {};           ///< how the structure came to rest before it; nothing when it was not to
    std::optional<StageOrigin> origin = {};  ///< of a later stage
    Falls falls = {};                        ///< of the stages before; empty: all blocks stand
    double wall_time = 0.0;                  ///< spent on it so far [s]
};

/// Lets a specimen come to rest when it asks for that, and its simulation begin from there; nothing when it does not. One that was
/// prepared is at rest within a few hundred steps; where contacts by nodes bore friction it comes to rest anew, since they cannot be given
/// it (Model::preload). One that has collapsed is not waited for. What has fallen is noted. Progress goes on where that of the preparation
/// ended, before the run of `plan`, and checkpoints are left as they fall due; `from`, if it is of such a settling, is carried on to the
/// same bits. When something is thrown the simulation is gone.
std::optional<Rest> settle_specimen(Simulation& simulation, const Specimen& specimen, const TimePlan& plan,
                                    const RunSettings& settings = {}, const Checkpoint* from = nullptr);

/// Runs a simulation of `specimen` that is at t = 0 to the end of a plan, or until it diverges; the simulation is then at that end. One
/// that collapsed before (begin.rest) is not run. Throws
/// scaling::Interrupted, after a last checkpoint, when the program is asked to stop.
RunResult simulate(Simulation& simulation, const Specimen& specimen, const TimePlan& plan, RunStart begin, const RunSettings& settings);

/// The simulation of a specimen as a checkpoint has it. Throws std::runtime_error as Simulation::restore does.
Simulation restore(const Specimen& specimen, const Checkpoint& checkpoint, int threads);

/// Throws std::runtime_error unless the plan of a checkpoint is the one that its scene has.
void require_plan(const Checkpoint& checkpoint, const TimePlan& plan);

/// Carries a run on from a checkpoint with the simulation that restore() made of it. Throws std::runtime_error when they do not belong
/// together.
RunResult resume(Simulation& simulation, const Specimen& specimen, Checkpoint checkpoint, const RunSettings& settings);

/// The run of a checkpoint of the rest phase after it. Throws std::runtime_error when its histories do not fit its plan.
RunResult recall_finished(const Specimen& specimen, Checkpoint checkpoint);

/// Dates the blocks that have fallen since the last look, seen from the base, and the collapse. `time` [s] and `base` are since the start
/// of the run.
void note_falls(RunResult& run, const Simulation& simulation, double time, const BaseState& base);

/// Status and divergence of a run that has come as far as its simulation.
void update_status(RunResult& run, const Simulation& simulation);

/// Carries a run on from a checkpoint to the end of its plan; all results but the wall time, which adds up, are the bits of a run without
/// interruption, with any number of threads. Throws std::runtime_error when the checkpoint is of another specimen.
RunResult resume(const Specimen& specimen, Checkpoint checkpoint, const RunSettings& settings = {});

/// The specimen for a copy run: of every block, the coordinate of largest magnitude moved up by one unit in its last place. The largest,
/// because at a coordinate of zero that unit would be the smallest double and change nothing.
Specimen make_moved_copy(Specimen specimen);

}  // namespace musim::lsdem
