#pragma once

#include <string>

#include "lsdem/export/exported_blocks.hpp"

namespace musim::lsdem {

/// Forms of a glTF file.
enum class GltfForm {
    binary,   ///< .glb
    embedded  ///< .gltf: JSON, with its numbers in it as base64
};

/// Blocks as glTF 2.0, in m. One node a block, named as in results, below a root node that turns z up into y up; one mesh for each shape
/// and material, with flat normals, on balls smooth ones. Frames of a run are an animation of translation and rotation at the run's own
/// time; `asset.extras` says by what prototype time and lengths are larger. What does not move has no channels. `version`: of the program.
/// Throws records::WriteError of more than 2 GB of motion, which readers do not take, and of frames that are no poses.
std::string make_gltf(const ExportedBlocks& exported, GltfForm form, const std::string& version);

}  // namespace musim::lsdem
