#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "lsdem/run/prepare.hpp"
#include "lsdem/scene/scene.hpp"
#include "lsdem/scene/specimen_seed.hpp"

namespace musim::lsdem {

/// Specimens of one scene with several seeds of their blocks' heights and scatter.
struct SpecimenBatch {
    Scene scene;
    std::vector<std::uint64_t> seeds;   ///< at least one
    std::filesystem::path folder;       ///< where the files go; they are named by content
    std::string version;                ///< of the program, for the files
    int threads = 0;                    ///< specimens at a time; those left over are shared by the specimens; 0: all cores
    double checkpoint_interval = 60.0;  ///< wall time between two checkpoints of a specimen [s]
    double runs_to_follow = 0.0;        ///< how many runs of each missing specimen's scene, by their work, follow; for the progress
    std::function<void(double)> on_progress = {};  ///< given the part that is done of what is missing and of the runs that follow it
    std::function<void(const std::string&)> on_warning =
        {};  ///< Given the reason why a checkpoint could not be written or used, from any thread
};

/// A specimen that was made, or was there before.
struct SpecimenReport {
    std::uint64_t seed = 0;
    std::filesystem::path file;
    bool reused = false;   ///< made from the same inputs before; of what follows, `blocks` and `fallen` are then known
    bool resumed = false;  ///< gone on with from a checkpoint that was left in the folder
    std::size_t blocks = 0;
    std::size_t fallen = 0;  ///< of them, while they were prepared, see find_fallen
    std::string what_fell;   ///< see describe_fallen; empty when none did
    PreparedSpecimen prepared;
    double wall_time = 0.0;  ///< [s]

    /// Is there a file: did it come to rest, without a collapse?
    bool stands() const { return reused || (prepared.rest.at_rest && !prepared.rest.collapsed); }
};

/// Prepares the specimens of a batch, as the scene's `preparation` says (default: layer by layer), side by side. A file that is there is
/// not made again. A preparation that is killed leaves its checkpoint beside where the file would be, and the next call goes on from there,
/// to the same file. Specimens that are not there are locked first, so that no two processes make one. Throws SceneError for a scene
/// without layers or seeds to vary, or with "preparation": "none", records::WriteError, and ResultError for a file where the folder should
/// be.
std::vector<SpecimenReport> make_specimens(const SpecimenBatch& batch);

/// Name of the file that holds the specimen of a scene, once it has been made.
std::string specimen_file_of(const Scene& scene);

}  // namespace musim::lsdem
