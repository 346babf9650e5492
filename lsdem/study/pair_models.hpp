#pragma once

#include <optional>
#include <string>
#include <vector>

#include "lsdem/scene/scene.hpp"
#include "lsdem/study/model_law.hpp"
#include "lsdem/study/pair.hpp"
#include "scaling/laws/model_scales.hpp"
#include "scaling/laws/scale_law.hpp"
#include "scaling/laws/similitude.hpp"

/// Models of a pair as scenes: scaled by a law, of their own material, or scenes of their own.
namespace musim::lsdem {

/// A law of similitude and what is given of it besides the length.
struct ChosenLaw {
    std::string name;                            ///< one that comes with musim, or a file (scaling::load_scale_law)
    std::vector<scaling::GivenFactor> set = {};  ///< e.g. g, or F_R
};

/// A model of a scene: its scale, by which law it is made and shaken, and the material it is built of when that is its own.
struct ModelChoice {
    double length = 1.0;  ///< λ_l
    /// For Materials::own: preset or file (find_measured_material); empty: the one measured for a tower of this scale.
    std::string material = {};
    /// Default: `exact`, of own material `mu`, of a scene the law that it names or that the motions of both bases show. What a model is
    /// made of settles the law's μ, ρ and E (by k_n/l) where the law leaves them to be chosen; what the law asks for besides is a
    /// distortion where the model has something else.
    std::optional<ChosenLaw> law = {};
    /// A scene of its own instead: as many blocks in as many layers as the prototype's, see take_as_model.
    std::optional<Scene> scene = {};
};

/// A model's scene with its similitude to the prototype.
struct ScaledScene {
    Scene scene;
    scaling::Similitude similitude = {};            ///< of what the model is: density, friction and gravity are its own
    scaling::ModelScales scales = {};               ///< the same with lengths and shaking as they are, for distortions
    std::string material = {};                      ///< name of its own
    Materials materials = Materials::exact;         ///< how it is judged
    ModelLaw law = {};                              ///< by which it is shaken
    std::optional<scaling::SolvedLaw> solved = {};  ///< that law, where one is known
    std::optional<SecondScene> second = {};         ///< of a scene of its own
};

/// A model with one property of a material of its own.
struct LoneScene {
    std::string property;
    double factor = 1.0;
    Scene scene;
    scaling::Similitude similitude;
};

/// The scene of a model. Without `materials` a scaled one is exact; a scene of its own is when it is the prototype's structure
/// (find_other_structure) and no law is given. That is then compared as it is, in the same units: what differs in it is the error that is
/// looked for. Any other one is a model of its own, see take_as_model. Throws SceneError (also for an unknown material, a scale without
/// one, a law that asks for less density than the material has), scaling::SimilitudeError, and as make_upright_specimen does.
ScaledScene make_scaled(const Scene& prototype, const ModelChoice& choice, std::optional<Materials> materials);

/// The plan of a scene that is the prototype's structure, with the prototype's samples: the prototype's steps, unless the scene asks for
/// others (step, safety), or they are no longer stable; then as long ones as its own that fit between two samples.
TimePlan make_plan_beside(const Scene& prototype, const TimePlan& plan, const Scene& scene, const Model& model);

/// Groups that are off though the law of the model asks for them to be kept (scaling::GroupMeaning), of those that are off; none where no
/// law is known.
std::vector<std::string> find_asked(const ScaledScene& model, const std::vector<scaling::Distortion>& distortions);

/// One scene for every property in which `own` is not what similitude asks for. Stiffnesses and restitution differ in a model that is
/// exact otherwise. Where the law's λ_a is that of friction, λ_μ λ_g, friction comes with that shaking; else alone, and a λ_a other than
/// λ_g is a property of its own, "shaking".
std::vector<LoneScene> find_lone_scenes(const Scene& prototype, const ScaledScene& own);

}  // namespace musim::lsdem
