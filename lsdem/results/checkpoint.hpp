#pragma once

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>

#include "lsdem/build.hpp"
#include "lsdem/motion/simulation.hpp"
#include "lsdem/results/history.hpp"
#include "lsdem/results/rest.hpp"
#include "lsdem/results/time_plan.hpp"

namespace musim::lsdem {

/// Where and how often a run writes what it needs to go on after it was killed.
struct CheckpointSettings {
    std::filesystem::path file;
    std::string scene;                     ///< as JSON text, for whoever resumes
    std::string program_version;           ///< only the same one may resume
    std::string build = describe_build();  ///< likewise
    double interval = 60.0;                ///< wall time between two checkpoints, see kFirstCheckpoint [s]; 0: one after every sample
    std::uint64_t samples = 0;             ///< when positive: one after so many samples, or checks while it settles, whatever the wall time
    std::optional<PreparedPlaces> places = {};  ///< of a specimen that was prepared, so that it need not be again
    /// Given the reason why a checkpoint could not be written; the run goes on, and the checkpoint before stays.
    std::function<void(const std::string&)> on_failure = {};
};

/// The rest phase after a run, before the next motion of a sequence, as far as it has come.
struct RestPhaseState {
    double clock = 0.0;               ///< from the start of the run to that of the simulation's present motion [s]
    Vector3 moved = Vector3::Zero();  ///< displacement of the base up to there [m]
    Vector3 stop = Vector3::Zero();   ///< velocity from which the base was brought to rest [m/s]; zero: it stood
    double wall_time = 0.0;           ///< [s]
    SettlingState settling;
};

/// A run as far as it had come. Of `run` it holds all but what follows from specimen and plan, and a divergence.
struct Checkpoint {
    std::string program_version;
    std::string build;                            ///< see lsdem::describe_build
    std::string scene;                            ///< as JSON text
    std::optional<PreparedPlaces> places;         ///< of a specimen that has been prepared
    std::optional<PreparationState> preparation;  ///< of one that was being prepared: what follows is then empty
    std::optional<SettlingState> settling;        ///< of one that was placed and came to rest: what follows, but for `state`, is then empty
    TimePlan plan;
    std::uint64_t samples_done = 0;
    RunResult run;
    std::optional<RestPhaseState> rest_phase;  ///< the run had ended, and what came after it
    std::string state;                         ///< Simulation::save
};

/// The first checkpoint of a run, a stage or a preparation comes after this wall time, when the interval is longer [s]: whoever notices a
/// mistake early, or is killed early, has lost little.
inline constexpr double kFirstCheckpoint = 5.0;

/// The name of the checkpoint in a folder of results.
inline constexpr const char* kCheckpointName = "checkpoint";

/// Reads a checkpoint of this program version and build. Throws std::runtime_error `FILE: what; what to do` when there is none, it is
/// damaged, or it was written by another version or build: the run would go on to other bits.
Checkpoint read_checkpoint(const std::filesystem::path& file, const std::string& program_version);

/// Removes a checkpoint, and what a kill left of one that was being written. Nothing happens when there is none.
void remove_checkpoint(const std::filesystem::path& file) noexcept;

/// Writes a checkpoint of a run whose last sample is `done`, or of the rest phase after it; the file changes from the one
/// before in one step. One that cannot be written is given to CheckpointSettings::on_failure. `run` is not changed.
void write_checkpoint(const CheckpointSettings& settings, std::uint64_t done, const TimePlan& plan, RunResult& run,
                      const Simulation& simulation, const std::optional<RestPhaseState>& rest_phase = {});

/// The same of a preparation; and of a specimen that is prepared and comes to rest once more, in `simulation`, before its run.
void write_checkpoint(const CheckpointSettings& settings, PreparationState preparation);
void write_checkpoint(const CheckpointSettings& settings, const SettlingState& settling, const Simulation& simulation);

/// Writes the checkpoints of one run as they fall due, and at once when the program is asked to stop (scaling::is_interrupted); the file
/// changes from one to the next in one step.
class CheckpointWriter {
  public:
    explicit CheckpointWriter(CheckpointSettings settings) : settings_(std::move(settings)) {}

    /// Sample `done` has just been taken.
    void after_sample(std::uint64_t done, const TimePlan& plan, RunResult& run, const Simulation& simulation);

    /// Some steps have been taken since sample `done`, which may last long.
    void between_samples(std::uint64_t done, const TimePlan& plan, RunResult& run, const Simulation& simulation);

    /// Something that settles has just been looked at; `write` is called when a checkpoint is due.
    void after_look(const std::function<void(const CheckpointSettings&)>& write);

  private:
    using Clock = std::chrono::steady_clock;

    bool is_due(std::uint64_t done) const;
    bool is_time() const;
    void note_written();

    CheckpointSettings settings_;
    double wait_ = std::min(settings_.interval, kFirstCheckpoint);  ///< from the last one to the next [s]
    std::uint64_t looks_ = 0;
    Clock::time_point last_ = Clock::now();
};

}  // namespace musim::lsdem
