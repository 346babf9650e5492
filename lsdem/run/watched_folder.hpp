#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "lsdem/run/progress_file.hpp"

namespace musim::lsdem {

/// One that goes on in a folder, or did when it was killed.
struct WatchedRun {
    std::filesystem::path folder;
    bool works = false;   ///< false: killed
    ProgressState state;  ///< as reported last
};

/// State of a folder of results.
enum class FolderState {
    empty,     ///< nothing works there and nothing has
    working,   ///< a musim works there
    killed,    ///< one did, and left no results
    finished,  ///< with results
};

/// View of a folder of results from outside: of a run, a pair, a sequence, or an ensemble and its members.
struct WatchedFolder {
    FolderState state = FolderState::empty;
    std::vector<WatchedRun> runs;  ///< those that reported their state, by name
    std::string
        status;  ///< of results that have one: "completed", "collapsed", "diverged", "consistent", "distorted"; "damaged"; else empty
};

/// Inspects a folder: who holds it (a lock that goes with its process; on file systems without locks, who has reported in the last
/// ten seconds), what they reported, and what results are there. A folder that does not exist is empty.
WatchedFolder look_into(const std::filesystem::path& directory);

}  // namespace musim::lsdem
