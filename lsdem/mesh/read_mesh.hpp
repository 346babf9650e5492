#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "lsdem/mesh/mesh.hpp"

namespace musim::lsdem {

/// Reads the faces of a mesh: STL (text or binary), OBJ or PLY (text, little or big endian), by the ending of its name, in any case.
///
/// STL: binary when its length is that of its number of triangles, whatever its first word; a text's words may stand on any lines, keywords
/// in any case; normals are not used. OBJ: `v`, `f` (indices from 1 or negative, `v/vt/vn`, three corners or more), `o`, `g`, continued
/// lines; free-form surfaces are refused, the rest is skipped. PLY: `vertex` with x, y, z and `face` with vertex_indices, of any types.
///
/// Throws MeshError for a file that cannot be opened or is none of these, one that ends too early or has something behind its end, an
/// index of no vertex, a coordinate that is no finite number, no face at all, and beyond the limits.
Mesh read_mesh(const std::filesystem::path& path, const MeshLimits& limits = {});

/// The same for bytes at hand. `file`: their name in messages.
Mesh parse_stl(std::string_view bytes, const std::string& file, const MeshLimits& limits = {});
Mesh parse_obj(std::string_view bytes, const std::string& file, const MeshLimits& limits = {});
Mesh parse_ply(std::string_view bytes, const std::string& file, const MeshLimits& limits = {});

}  // namespace musim::lsdem
