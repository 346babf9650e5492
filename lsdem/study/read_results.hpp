#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "lsdem/study/history.hpp"
#include "scaling/error.hpp"

namespace musim::lsdem::study {

/// A directory or file that holds no usable results: says where, what, why and what to do, in one line.
class ResultError : public Error {
  public:
    using Error::Error;
};

/// What a result directory holds of a run.
struct StoredRun {
    std::filesystem::path directory;
    RunStatus status = RunStatus::completed;
    std::optional<double> collapse_time;               ///< [s]
    std::string divergence;                            ///< why it diverged, in one sentence; empty when it did not
    Vector3 peak_base_acceleration = Vector3::Zero();  ///< see RunResult; of older results that at the samples [m/s²]
    std::array<SourcePga, 3> source_pga = {};          ///< likewise; unknown in older results
    bool at_rest = true;                               ///< false: it was to settle before t = 0 and did not
    std::vector<std::string> doubts;                   ///< see find_doubts; empty in results of versions before they were kept
    std::string state_hash;                            ///< of the final state
    std::string scene;                                 ///< as JSON text
    BlockTable blocks;
    Spine spine;
    History history;                    ///< energy of all springs as that of normal ones; no energies in results without them
    Frames frames;                      ///< empty when none were kept
    Falls falls;                        ///< empty in results of versions before they were kept
    std::optional<StageOrigin> origin;  ///< of a later stage of a sequence
    std::optional<Losses> losses;       ///< nothing in results of versions before they were kept
    std::vector<std::string> gaps;      ///< what could not be read of it, one sentence each; only with Reading::what_there_is
    bool is_status_known = true;        ///< false: summary.json could not be read; `status` is then what the falls tell
    Kinematics initial;                 ///< poses only
    Kinematics final;                   ///< poses only, at the last sample

    /// Centres of mass where falls are counted from [m].
    const std::vector<Vector3>& standing_position() const { return origin ? origin->position : initial.position; }
};

/// How much of a run must be there.
enum class Reading {
    whole,         ///< everything that is there must be readable
    what_there_is  ///< blocks and histories; of the rest what can be read, the gaps told
};

/// Reads DIR/result.h5 and DIR/summary.json as ResultFolder::add_run writes them. Throws ResultError when one is missing, unreadable, of
/// another layout, or holds no sample; for Reading::what_there_is only when that keeps blocks or histories from being read.
StoredRun read_run(const std::filesystem::path& directory, Reading reading = Reading::whole);

}  // namespace musim::lsdem::study
