#pragma once

#include <vector>

#include "lsdem/model.hpp"
#include "lsdem/scene/scene.hpp"
#include "scaling/laws/model_scales.hpp"
#include "scaling/structures/distortion.hpp"

namespace musim::lsdem {

/// A scene and the model that it builds.
struct BuiltScene {
    const Scene& scene;
    const Model& model;
};

/// The groups that a model, built and shaken, does not keep (scaling::find_distortions). Blocks correspond by their number.
///
/// `scales`: lengths, gravity and shaking as they are, friction and masses those of the first block, which is how laws speak of a model.
/// Contacts are compared by the stiffness per area that the kernel has, K_M/K_P λ_l² being that of a face. Where blocks are of several
/// materials, or friction differs by another factor on the ground, a group that is not off alike everywhere says of which blocks it is.
std::vector<scaling::Distortion> find_model_distortions(const BuiltScene& prototype, const BuiltScene& model,
                                                        const scaling::ModelScales& scales);

/// The material of a block, by its number: what it names in a list, else the scene's.
const BlockMaterial& material_of_block(const Scene& scene, std::size_t block);

}  // namespace musim::lsdem
