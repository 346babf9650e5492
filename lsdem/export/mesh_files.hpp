#pragma once

#include <string>

#include "lsdem/export/exported_blocks.hpp"

namespace musim::lsdem {

/// Blocks as Wavefront OBJ: one object a block, with its name and material, faces as polygons; world frame, z up, in m.
std::string make_obj(const ExportedBlocks& exported);

/// Blocks as binary STL: all triangles one after another, world frame, z up, in m.
std::string make_stl(const ExportedBlocks& exported);

}  // namespace musim::lsdem
