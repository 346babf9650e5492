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
    /// A scene of its own instead: as many blocks in as many layers as the prototype's. Its scale, density, friction and gravity are those
    /// of its first block over the prototype's; duration and sampling are the prototype's, scaled, its
    /// step is automatic.
    std::optional<Scene> scene = {};
};

/// A model's scene with its similitude to the prototype and what that distorts.
struct ScaledScene {
    Scene scene;
    scaling::Similitude similitude;
    std::vector<scaling::Distortion> distortions;
    std::string material = {};  ///< name of its own
};

/// A model with one property of a material of its own.
struct LoneScene {
    std::string property;
    double factor = 1.0;
    Scene scene;
    scaling::Similitude similitude;
};

/// The scene of a model. Throws SceneError (also for an unknown material, a scale without one), scaling::SimilitudeError.
ScaledScene make_scaled(const Scene& prototype, const ModelChoice& choice, Materials materials);

/// One scene for every property in which `own` is not what its similitude asks for.
std::vector<LoneScene> find_lone_scenes(const Scene& prototype, const ScaledScene& own);

}  // namespace musim::lsdem
