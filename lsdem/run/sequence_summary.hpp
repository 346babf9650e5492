#pragma once

#include <cstddef>
#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "lsdem/results/damage.hpp"
#include "lsdem/results/failure.hpp"
#include "lsdem/results/spine_measures.hpp"

/// Effect of a sequence of motions on a structure, stage by stage.
namespace musim::lsdem {

/// A stage of a sequence on disk.
struct StageFolder {
    std::string name;    ///< for people
    std::string folder;  ///< within the directory of the sequence
};

/// Residual of motions at some moment, since some start.
struct Residual {
    Damage damage;
    std::vector<SpineLevel> spine;  ///< the residuals only; rotations in the plane of the stage's own strongest axis
};

struct StageSummary {
    StageFolder where;
    RunStatus status = RunStatus::completed;
    double start_time = 0.0;              ///< of the motion, on the clock of all motions without rest phases [s]
    double duration = 0.0;                ///< [s]
    int axis = 0;                         ///< along which the base moved most
    double peak_velocity = 0.0;           ///< of the base, largest absolute value of its vector at the samples [m/s]
    double peak_acceleration = 0.0;       ///< of its largest component, see RunResult::peak_base_acceleration [m/s²]
    std::string pga;                      ///< of that component against its record or formula, see describe_base; empty without one
    bool at_rest = true;                  ///< false: the structure had not come to rest before it, as it was to
    std::size_t fallen_before = 0;        ///< blocks that had fallen before it, the rest phase included
    std::size_t fallen = 0;               ///< at its end, since the start of the first stage; a rest phase after it included
    std::optional<double> collapse_time;  ///< since its start [s]; after its end: in the rest phase
    bool collapsed_before = false;        ///< while the structure was prepared, so that it was not shaken
    std::string divergence;               ///< why it diverged; empty when it did not
    std::vector<std::string> warnings;    ///< of the run, see find_warnings
    std::optional<Residual> at_start;     ///< of a later stage: what the ones before have left when it starts, without energies
    Residual of_stage;                    ///< at its end, since its own start
    Residual of_sequence;                 ///< at its end, since the start of the first stage
};

struct SequenceSummary {
    std::string name;
    std::size_t planned = 0;  ///< motions in the scene
    std::vector<StageSummary> stages;
    std::optional<Failure> failure;  ///< of a collapse, since the start of the first stage; its time is that of the last stage

    /// Status of the last stage: "collapsed" when the structure has.
    RunStatus status() const { return stages.back().status; }
    /// Duration of all motions that were run [s].
    double duration() const { return stages.back().start_time + stages.back().duration; }
    /// When the structure collapsed, on the clock of all motions [s].
    std::optional<double> collapse_time() const;
};

/// A later stage as if it had begun with the first, up to a moment of it in which its blocks had `pose` and its base had moved by `base`
/// [m] since its own start. Of histories only the two ends, with residuals in them. `losses`: energy dissipated until then.
RunData measure_from_first(const RunData& stage, const Kinematics& pose, const Vector3& base, const std::optional<Losses>& losses);

/// Reads the stages of a sequence back and sums up. Throws ResultError as read_run does.
SequenceSummary summarize_sequence(const std::filesystem::path& directory, const std::string& name, std::size_t planned,
                                   const std::vector<StageFolder>& stages);

/// Everything in one object; angles in degrees, other quantities in SI units that the keys name.
nlohmann::json to_json(const SequenceSummary& summary);

/// stage,name,status,...: one line per stage.
std::string make_sequence_csv(const SequenceSummary& summary);

/// stage,level,...: residual displacements and rotations of the spine, since the start of the stage and of the sequence.
std::string make_sequence_levels_csv(const SequenceSummary& summary);

}  // namespace musim::lsdem
