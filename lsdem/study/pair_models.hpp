#pragma once

#include <optional>
#include <string>
#include <vector>

#include "lsdem/scene/scene.hpp"
#include "lsdem/study/pair.hpp"
#include "scaling/laws/similitude.hpp"
#include "scaling/structures/distortion.hpp"

/// Models of a pair as scenes: scaled by a law, of their own material, or scenes of their own.
namespace musim::lsdem {

/// A model of a scene: its scale, and the material it is built of when that is its own.
struct ModelChoice {
    double length = 1.0;  ///< λ_l
    /// For Materials::own: preset or file (find_measured_material); empty: the one measured for a tower of this scale.
    std::string material = {};
    std::optional<scaling::Similitude> similitude = {};  ///< for Materials::exact: scaled by this, not by law `exact`
    /// A scene of its own instead: as many blocks in as many layers as the prototype's, see take_as_model.
    std::optional<Scene> scene = {};
};

/// A model's scene with its similitude to the prototype and what that distorts.
struct ScaledScene {
    Scene scene;
    scaling::Similitude similitude;
    std::vector<scaling::Distortion> distortions;
    std::string material = {};  ///< name of its own
    Materials materials = Materials::exact;
    std::optional<SecondScene> second = {};  ///< of a scene of its own
};

/// A model with one property of a material of its own.
struct LoneScene {
    std::string property;
    double factor = 1.0;
    Scene scene;
    scaling::Similitude similitude;
};

/// The scene of a model. Without `materials` a scaled one is exact; a scene of its own is when it is the prototype's structure
/// (find_other_structure). That is then compared as it is, in the same units: what differs in it is the error that is looked for. Any other
/// one is a model of its own: its scale, density, friction and gravity are those of its first block over the prototype's, and its step is
/// automatic. Duration and sampling are the prototype's, scaled. Throws SceneError (also for an unknown material, a scale without one),
/// scaling::SimilitudeError, and as make_upright_specimen does.
ScaledScene make_scaled(const Scene& prototype, const ModelChoice& choice, std::optional<Materials> materials);

/// The plan of a scene that is the prototype's structure, with the prototype's samples: the prototype's steps, unless the scene asks for
/// others (step, safety), or they are no longer stable; then as long ones as its own that fit between two samples.
TimePlan make_plan_beside(const Scene& prototype, const TimePlan& plan, const Scene& scene, const Model& model);

/// One scene for every property in which `own` is not what its similitude asks for.
std::vector<LoneScene> find_lone_scenes(const Scene& prototype, const ScaledScene& own);

}  // namespace musim::lsdem
