#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "lsdem/scene/scene.hpp"
#include "lsdem/study/pair.hpp"
#include "lsdem/study/pair_models.hpp"
#include "lsdem/study/pair_plots.hpp"

namespace musim::lsdem {

/// Specimen that a model starts from.
enum class PairSpecimen {
    one,  ///< the prototype's, laid once: its exact image, where the model's law has one (scale_specimen)
    each  ///< one laid anew at its scale
};

/// Settings by which a pair is run and judged.
struct PairSceneSettings {
    PairSpecimen specimen = PairSpecimen::one;
    PairSettings judging = {};
    bool one_at_a_time = false;  ///< see pair_scene
    /// Other specimens of the prototype that own models are held against; nothing: kOtherSpecimens when block heights are drawn, else none.
    std::optional<std::size_t> specimens = {};
    std::optional<double> accept = {};  ///< by how much an own model may differ [-], see judge_own
};
inline constexpr std::size_t kOtherSpecimens = 4;

/// A scene at its own scale and at others.
struct ScenePair {
    Scene prototype;
    std::vector<Scene> models = {};             ///< in the order of PairStudy::models
    std::vector<scaling::SolvedLaw> laws = {};  ///< of the models whose law was chosen
    SpeedScales scales = {};                    ///< of the prototype
    PairStudy study = {};
    /// With settings.checkpoint: the folder in which specimens and runs were kept, for whoever stores the results to remove then.
    std::filesystem::path unfinished = {};
    bool resumed = false;  ///< it was there already
};

/// Name of a scale: "1:107", or "x0.3" when it is no whole fraction, in as many digits as read back the same.
std::string make_scale_label(double length);

/// Runs a scene as prototype and models, and judges the models by twins.
///
/// The prototype's specimen is laid, and comes to rest, once; exact models start from its images. With Materials::exact every model is
/// scaled so that all groups are equal (law `exact`), or by the law of its choice. With Materials::own it has the density, stiffness,
/// friction and restitution of what was measured, fitted to its block size, and gets the base motion of the mu law, or of the law of its
/// choice; what that distorts is listed, and it is held against other specimens of the prototype, too. What scenes of their own are follows
/// from their blocks unless `materials` says it (make_scaled); they lay their own specimens. With `one_at_a_time` every
/// model has runs beside it that say what each property of its material that differs does alone (PairedRun::alone, find_lone_scenes):
/// stiffnesses and restitution in a model that is exact otherwise, friction with the base motion of the mu law if that is the model's.
/// Throws SceneError (also for an unknown material, a scale without one, a model of another structure), scaling::SimilitudeError,
/// records::ReadError.
///
/// With settings.checkpoint its file is the folder of the results: specimens and runs are kept in a folder there that is named by all that
/// decides on them, so that the same pair, begun again after it was killed, goes on.
ScenePair pair_scene(const Scene& prototype, const std::vector<ModelChoice>& models, std::optional<Materials> materials = {},
                     const RunSettings& settings = {}, const PairSceneSettings& how = {});

}  // namespace musim::lsdem
