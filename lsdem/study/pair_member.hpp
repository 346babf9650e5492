#pragma once

#include <optional>
#include <string>
#include <vector>

#include "lsdem/run/run.hpp"
#include "lsdem/run/simulate.hpp"
#include "lsdem/run/staged_run.hpp"
#include "lsdem/scene/scene.hpp"
#include "lsdem/study/model_law.hpp"
#include "lsdem/study/second_scene.hpp"
#include "scaling/laws/similitude.hpp"
#include "scaling/structures/distortion.hpp"

namespace musim::lsdem {

/// Whether a model is to be its prototype in other units, with every group equal, and is judged by twins; or is one of its own: of its own
/// measured material, or other blocks.
enum class Materials { exact, own };

/// "exact" or "own".
std::string to_string(Materials materials);

/// A run to be compared with its prototype's.
struct PairMember {
    std::string label;  ///< "1:107"; also names its folder, ':' written '-'
    Specimen specimen;
    TimePlan plan;                                      ///< with the prototype's sample counts
    scaling::Similitude similitude;                     ///< of this specimen to the prototype
    std::vector<scaling::Distortion> distortions = {};  ///< requirements the specimen does not meet
    std::optional<Rest> rest = {};                      ///< how its specimen came to rest before it was handed over
    std::string material = {};                          ///< of a model of its own material: its name
    bool is_image = false;                              ///< its specimen is the prototype's (make_image), not laid anew
    std::optional<StagedMotion> staged = {};            ///< of a scene with several motions; its plans then hold, not `plan`
    Materials materials = Materials::exact;
    std::optional<SecondScene> scene = {};  ///< of a model that is a scene of its own
    ModelLaw law = {};                      ///< by which it is shaken
    std::vector<std::string> asked = {};    ///< of its distortions, the groups that its law asks to be kept
};

/// The folder of a model's results: its label, ':' written '-'.
std::string name_folder(std::string label);

/// A scene laid (lay_specimen), with its motion or motions, that steps as its own stiffness asks and is sampled as `sampling` says. Throws
/// as lay_specimen and plan_sequence do.
PairMember lay_member(const std::string& label, const Scene& scene, const scaling::Similitude& similitude, const RunSettings& settings = {},
                      Sampling sampling = Sampling::at_rate);

/// The exact image of a member: the same counts in other units.
PairMember make_image(const PairMember& member, const std::string& label, const scaling::Similitude& similitude);

/// For runs that are compared but not stored.
void drop_frames(PairMember& member);

/// Runs a member. With settings.checkpoint the run leaves its checkpoints in that file, and its end, too: what is found there goes on, or
/// is not run again; all but wall times are the bits of a run without interruption. One of several motions is kept at its end only. The
/// file must be of this very run: its name is to say so. One that cannot be read is as good as none. A run that diverged is not kept.
RunResult run_member(const PairMember& member, const RunSettings& settings);

}  // namespace musim::lsdem
