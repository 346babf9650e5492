#pragma once

#include "lsdem/scene/scene.hpp"

namespace musim::lsdem {

/// Edges b, w, H of the block whose base has a scene's stiffnesses: the structure's block, the whole one of a wall, the first of a list; of
/// spheres the cube around them; of a solid the box of its height and base area, in the frame that it is placed by, b over w being that of
/// the box around it; zero of an empty list. Throws SceneError for a shape that cannot be made.
Triple<scaling::Length> reference_block(const Scene& scene);

/// The same of a block of a list.
Triple<scaling::Length> find_block_size(const Scene& scene, const BlockEntry& block);

/// Are there blocks of other bases than that, by more than a part in 10⁹? Only a list has them.
bool has_several_bases(const Scene& scene);

/// Area A of that block's base, b·w; of spheres their great circle, πR²; of a solid its faces that look down, see Shape::face_area.
/// Stiffnesses per area are K = k/A.
scaling::Area reference_area(const Scene& scene);

}  // namespace musim::lsdem
