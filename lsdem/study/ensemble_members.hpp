#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "lsdem/run/specimen_batch.hpp"
#include "lsdem/scene/scene.hpp"

/// Ensembles: one scene with several seeds of its blocks' heights.
namespace musim::lsdem {

/// One member: an independent job whose name says what it computes.
struct EnsembleMember {
    std::string name;  ///< "member-" and 16 hexadecimal digits
    std::uint64_t seed = 0;
    Scene scene;
};

/// The members of a scene with the seeds s, s + 1, ... from the scene's own on.
///
/// A name is the hash of the complete scene as JSON, the program's version, and the contents (not the paths) of the record, tiling and
/// specimen that the scene names: equal names mean equal results, to the last bit, wherever a member runs.
/// Throws SceneError for a scene whose members would be equal (no height deviation, or one specimen file for all) or would have no
/// common sampling times ("step": "auto" without a spine rate); records::ReadError when a file it names cannot be read.
std::vector<EnsembleMember> plan_ensemble(const Scene& scene, int members, const std::string& version);

/// The member that a scene is.
EnsembleMember make_member(Scene scene, const std::string& version);

/// Where a member's results go: DIR/members/NAME.
std::filesystem::path member_folder(const std::filesystem::path& directory, const EnsembleMember& member);

/// Progress of a member.
enum class MemberState { waiting, unfinished, finished };

/// "waiting", "unfinished" (there is a checkpoint to go on from) or "finished".
std::string to_string(MemberState state);

/// State of a member by its folder.
MemberState find_state(const std::filesystem::path& directory, const EnsembleMember& member);

/// Are the results' scene and the member's the same but for the paths of files they name?
bool is_scene_of(const std::string& scene_text, const EnsembleMember& member);

/// Has every member use its specimen from batch.folder, which other ensembles may use too: the same blocks under another motion need not be
/// laid again. It is prepared where it is missing: the seeds of `batch` are those of `members`, its scene is not looked at. A member is
/// then another job, named by the content of its specimen too. One whose specimen does not come to rest stays as it is, and would lay it
/// again; its report says so. Throws as make_specimens does.
std::vector<SpecimenReport> use_specimens(std::vector<EnsembleMember>& members, SpecimenBatch batch);

/// The same when all specimens are there. Throws ResultError for the first that is not.
void use_prepared_specimens(std::vector<EnsembleMember>& members, const std::filesystem::path& folder, const std::string& version);

/// Settings of running members; none of them changes their results.
struct MemberSettings {
    std::filesystem::path directory;               ///< of the ensemble; each member has its own folder in it
    std::string version;                           ///< of the program
    int threads = 0;                               ///< members at a time, one thread each; 0: all cores
    double checkpoint_interval = 60;               ///< wall time between two checkpoints of a member [s]; 0: one after every sample
    std::function<void(double)> on_progress = {};  ///< fraction done of all that is left to do, from any thread
    std::function<void(const std::string&)> on_no_checkpoint = {};  ///< Given the reason why one could not be written; from any thread
};

/// Report of a member.
struct MemberReport {
    bool reused = false;   ///< its results were there before
    bool resumed = false;  ///< continued from a checkpoint
    std::string error;     ///< why it has no results; empty when it has
};

/// Runs members side by side, each as run_scene does on one thread, and stores its results in its folder. One that is finished is not run
/// again, one with a checkpoint is continued. What a member throws becomes its report's error; the others go on.
std::vector<MemberReport> run_members(const std::vector<EnsembleMember>& members, const MemberSettings& settings);

}  // namespace musim::lsdem
