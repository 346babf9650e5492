#pragma once

#include <string>

#include "lsdem/scene/scene.hpp"

/// Structures as lists of blocks.
namespace musim::lsdem {

/// Is the structure made block by block, without layers: anything but a column, a tower or a wall?
bool is_listed(const Scene& scene);

/// The same scene with its structure as a list of blocks and the shapes that these need; a column, a tower and a wall stay what they are.
/// The one way in which an arch, a column of shapes and several structures become blocks: whoever asks for the blocks of a scene asks this.
///
/// Arch: voussoirs from the springing at -x to that at +x, then the two abutments, named "voussoir 1", ..., "abutment 1", "abutment 2".
/// Angle of a voussoir δ = embrace/n; corners lie on the circles of radius R ± t/2, so faces are flat. Its shape is drawn with z along the
/// arch, so that a joint is its base. The lowest point of the springings is at z = 0, or with abutments, that stand on the ground and move
/// with it, at z = t. Column of shapes: named by their shapes, with a number where one occurs again. Several: the name of a structure comes
/// before those of its blocks, "left voussoir 3".
///
/// The scene must have passed check_structure. Throws SceneError for a shape that cannot be made, or a tiling.
Scene as_listed(const Scene& scene);

}  // namespace musim::lsdem
