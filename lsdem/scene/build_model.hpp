#pragma once

#include <string>
#include <vector>

#include "lsdem/model.hpp"
#include "lsdem/scene/scene.hpp"
#include "lsdem/scene/spine.hpp"

namespace musim::lsdem {

/// Places in a model that results speak of.
struct StructureInfo {
    std::vector<int> layer;         ///< of every block, from 1 at the base; 0: in no layer
    std::vector<int> level;         ///< of every block, from 1 at the base: its layer, or what find_levels says of blocks in none
    std::vector<std::string> name;  ///< of every listed block, empty for those without; no entries for other structures
    Spine spine;
    std::vector<std::string> load;  ///< names of the loads
};

/// A scene as the kernel takes it.
struct BuiltModel {
    Model model;
    StructureInfo structure;
};

/// Builds the kernel's model of a scene. Layers stand at nominal contact, z = H·(k − 1/2) for layer k, with neither gap nor overlap; odd
/// layers of a tower follow the tiling, even ones its quarter turn. Blocks of unequal height (block_heights.hpp) keep one shape and stand
/// on the level of the tallest block of the layer below, so that they do not overlap; most hang above what they will come to rest on.
/// Stiffnesses of a whole face are divided by reference_area(), whatever the block: one stone has one stiffness per area. So is the ground,
/// which is of the scene's material.
///
/// Throws SceneError for a scene that check_scene refuses, for blocks that overlap each other or the ground at the start (the two are
/// named, with the depth of the overlap), for nodes that do not fit the face, for a ring without tiling; records::ReadError for a record
/// that cannot be used.
BuiltModel build_model(const Scene& scene);

/// The model of build_model.
Model make_model(const Scene& scene);

/// Largest step that a scene may ask for over the critical one, which is a bound on the safe side for blocks that can turn: these were seen
/// to be stable up to here (docs/validation/stability.md), and a run between one and this ends with a warning [-].
inline constexpr double kLargestStep = 1.5;

/// Time step of a run: the scene's own, or `safety` times the critical step of its model. Throws SceneError for a step of the scene's own
/// above kLargestStep times the critical one.
scaling::Time compute_time_step(const Scene& scene, const Model& model);

}  // namespace musim::lsdem
