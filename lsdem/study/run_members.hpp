#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "lsdem/study/ensemble_members.hpp"

namespace musim::lsdem {

/// How members are run; none of it changes their results.
struct MemberSettings {
    std::filesystem::path directory;               ///< of the ensemble; each member has its own folder in it
    std::string version;                           ///< of the program
    int threads = 0;                               ///< members at a time, one thread each; 0: all cores
    double checkpoint_interval = 60;               ///< wall time between two checkpoints of a member [s]; 0: one after every sample
    std::function<void(double)> on_progress = {};  ///< fraction done of all that is left to do, from any thread
    std::function<void(const std::string&)> on_no_checkpoint = {};  ///< Given the reason why one could not be written; from any thread
};

/// What became of a member.
struct MemberReport {
    bool reused = false;   ///< its results were there before
    bool resumed = false;  ///< continued from a checkpoint
    std::string error;     ///< why it has no results; empty when it has
};

/// Runs members side by side, each as run_scene does on one thread, and stores its results in its folder. One that is finished is not run
/// again, one with a checkpoint is continued. What a member throws becomes its report's error; the others go on.
std::vector<MemberReport> run_members(const std::vector<EnsembleMember>& members, const MemberSettings& settings);

}  // namespace musim::lsdem
