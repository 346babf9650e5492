#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "lsdem/scene/scene.hpp"

/// Ensembles: one scene with several seeds of its blocks' heights.
namespace musim::lsdem {

/// One member: an independent job whose name says what it computes.
struct EnsembleMember {
    std::string name;  ///< "member-" and 16 hexadecimal digits
    std::uint64_t seed = 0;
    Scene scene;
    std::string scene_text;  ///< the scene as JSON
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

/// How far a member has come.
enum class MemberState { waiting, unfinished, finished };

/// "waiting", "unfinished" (there is a checkpoint to go on from) or "finished".
std::string to_string(MemberState state);

/// What the member's folder says.
MemberState find_state(const std::filesystem::path& directory, const EnsembleMember& member);

/// Are the results' scene and the member's the same but for the paths of files they name?
bool is_scene_of(const std::string& scene_text, const EnsembleMember& member);

}  // namespace musim::lsdem
