#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "lsdem/run/simulate.hpp"
#include "lsdem/scene/scene.hpp"
#include "lsdem/study/twin_growth.hpp"

namespace musim::lsdem {

/// Settings of running twins; but for the folder, none of them changes results.
struct TwinSettings {
    std::filesystem::path directory = {};  ///< where results are kept run by run, so that a killed command goes on; empty: nowhere
    std::string version = {};              ///< of the program; results of another are not used
    int threads = 0;                       ///< runs side by side, each on one thread; 0: all cores
    double checkpoint_interval = 60.0;     ///< wall time between two checkpoints of the specimen's preparation [s]
    RunObserver observer = {};             ///< of laying the specimen, and of all runs, from any thread; no samples
    std::function<void(const std::string&)> on_warning = {};  ///< Given the reason why a checkpoint could not be written
};

/// Samples per second of a scene that does not say at what rate its spine is sampled [1/s].
inline constexpr double kTwinRate = 100.0;

/// Where the twins of a scene are kept: DIR/twins-HASH, the hash being of the scene, the contents of the files it names and the version.
std::filesystem::path twin_folder(const std::filesystem::path& directory, const Scene& scene, const std::string& version);

/// The specimen of a scene, laid now or taken from the folder of its twins, where it is left; nothing is left when `folder` is empty. See
/// lay_specimen. `runs_to_follow`: for the progress, see RunSettings.
Specimen lay_twin_specimen(const Scene& scene, const std::filesystem::path& folder, const TwinSettings& settings, double runs_to_follow);

/// Runs a scene as prototype, and twins of the same specimen, and compares the velocities of all blocks that move at every sample of the
/// spine (kTwinRate when the scene has no rate).
///
/// The specimen is laid once, when the scene asks for it, and starts as it then stands: to let every twin come to rest again would be a
/// choice on rounding. Twins are its images (scale_specimen), or copies whose blocks are moved. Twins follow the prototype while it runs.
/// With a directory the laid specimen, the velocities of the prototype (24 bytes a block and sample) and every twin that has finished are
/// found again: only what is missing is run. Another build of one version may give other bits; it should have another directory.
///
/// Throws as make_specimen and Simulation do, SceneError for a scene with a list of motions, records::WriteError.
TwinStudy run_twins(const Scene& scene, const std::vector<TwinChoice>& choices, const TwinSettings& settings = {});

/// The share of each scene in the work of one run of all, in block steps: for one progress over several studies. Throws as
/// make_upright_specimen does.
std::vector<double> share_work(const std::vector<Scene>& scenes);

}  // namespace musim::lsdem
