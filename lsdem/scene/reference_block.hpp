#pragma once

#include "lsdem/scene/scene.hpp"

namespace musim::lsdem {

/// Edges b, w, H of the block whose base has a scene's stiffnesses: the structure's block, the whole one of a wall, the first of a list; of
/// spheres the cube around them; zero of an empty list.
Triple<scaling::Length> reference_block(const Scene& scene);

/// Are there blocks of other bases than that, by more than a part in 10⁹? Only a list has them.
bool has_several_bases(const Scene& scene);

/// Area A of that block's base, b·w; of spheres their great circle, πR². Stiffnesses per area are K = k/A.
scaling::Area reference_area(const Scene& scene);

}  // namespace musim::lsdem
