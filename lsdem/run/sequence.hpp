#pragma once

#include <filesystem>
#include <functional>
#include <string>

#include "lsdem/run/sequence_summary.hpp"
#include "lsdem/run/simulate.hpp"
#include "lsdem/scene/scene.hpp"

/// Several motions one after another on the same structure, until it has collapsed.
namespace musim::lsdem {

/// Settings of carrying out a sequence; none of them changes the results.
struct SequenceSettings {
    std::filesystem::path directory;                                ///< of all results
    std::string version;                                            ///< of the program
    int threads = 1;                                                ///< at most
    bool force = false;                                             ///< older results of another scene are replaced
    double checkpoint_interval = 60.0;                              ///< wall time between two checkpoints [s]; 0: one after every sample
    RunObserver observer = {};                                      ///< progress is that of the whole sequence
    std::function<void(const std::string&)> on_stage = {};          ///< receives the folder of every stage once it is stored
    std::function<void(const std::string&)> on_no_checkpoint = {};  ///< receives why a checkpoint could not be written; the run goes on
};

/// Shakes the structure of a scene with its motions, one after another, and stores every stage as a run of its own in DIR/stage-01-NAME,
/// then sequence.json. Positions, velocities, contacts and their histories go from stage to stage; time and energies begin anew.
///
/// Between two motions the base comes to rest (make_stop), then the structure (settle), unless the later one says "settle": false. The
/// sequence ends with the stage in which the structure collapses or the run diverges. Falls count from the start of the first stage
/// (StageOrigin) and are looked for while the structure comes to rest, too: such a fall belongs to the stage before, at a time after its
/// end.
///
/// Throws as plan_sequence does; records::WriteError when the directory cannot be used; ResultError when it holds an unfinished
/// sequence, or results of another origin and `force` is not set.
SequenceSummary run_sequence(const Scene& scene, const SequenceSettings& settings);

/// Continues a sequence that was killed, from its checkpoint, to the same results as without the interruption but for the wall times.
/// Stages that were stored are not run again. Throws std::runtime_error, in one line, when there is no checkpoint or it cannot be
/// continued.
SequenceSummary resume_sequence(const SequenceSettings& settings);

}  // namespace musim::lsdem
