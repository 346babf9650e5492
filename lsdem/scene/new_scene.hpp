#pragma once

#include <optional>
#include <string>
#include <vector>

#include "lsdem/scene/material_presets.hpp"
#include "lsdem/scene/readable_scene.hpp"
#include "lsdem/scene/scene.hpp"

/// Scenes to start from, at the scale of a model, with comments.
namespace musim::lsdem {

/// "tower", "wall", "column", "blocks", "arch", "drums", "mesh", "tilt" (a column on a tilting table): structures that a scene may start
/// from.
const std::vector<std::string>& new_scene_kinds();

/// Wishes for a new scene.
struct NewScene {
    std::string kind = "tower";  ///< one of new_scene_kinds()
    MeasuredMaterial material = find_material_preset("wood");
    /// λ_l of the model; default: H of `block` over the prototype's, else that of the block on which the material was measured; of a stone
    /// 1 [-]
    std::optional<double> length = {};
    std::optional<Triple<scaling::Length>> block = {};  ///< thin, wide edge and height; default: the prototype's at the
                                                        ///< length, of a material that is no preset its own unless a length is given
    std::optional<int> layers = {};                     ///< default: tower 8, wall 6, column 6, blocks (of each pillar) 2; of an arch its
                                                        ///< voussoirs, 7, of a column of drums these, 4
    std::optional<MeshForm> mesh = {};                  ///< file of "mesh", and its unit
};

/// The mu law between the papers' prototype, of concrete with μ = 0.59 [Harmon23], and the model.
RecordScale find_scale(const NewScene& wanted);

/// A scene of the prototype's blocks (1.36 x 2.82 x 4.25 m) at the model's length, or of other ones, of a measured material fitted to them
/// (fit_to_block). A
/// synthetic earthquake shakes it along x whose prototype has the peaks of the papers' record, 0.511 g and 42.4 cm/s, and lasts 10 s.
/// Samples and pictures are as dense as 100 and 25 Hz in the prototype. Throws SceneError, also for layers below 1, and
/// scaling::SimilitudeError for a length that is not positive.
Scene make_new_scene(const NewScene& wanted);

/// Comments that help to change such a scene, whose motion may be a record by now.
ReadableText comment_new_scene(const NewScene& wanted, const Scene& scene);

}  // namespace musim::lsdem
