#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "lsdem/mesh/split_mesh.hpp"
#include "lsdem/solid/solid.hpp"

namespace musim::lsdem {

/// The unit of a file's coordinates.
struct MeshUnit {
    std::string name = "m";  ///< for messages
    double metres = 1.0;     ///< of one unit
};

/// A convex solid that a part of a mesh bounds.
struct MeshSolid {
    std::string name;   ///< of the part
    Polyhedron solid;   ///< [m], about the file's `MeshSolids::origin`; triangles in one plane are one face
    double dent = 0.0;  ///< depth of the deepest point of the surface below the solid's, taken for rounding [file's unit]
};

/// The convex solids of a file, in one frame: the file's, moved to the middle of their bounds so that a far origin costs no digits.
struct MeshSolids {
    Vector3 origin = Vector3::Zero();  ///< of the solids' frame in the file's [m]
    std::vector<MeshSolid> solids;
};

/// The solids that closed surfaces bound, each the convex hull of its corners.
///
/// Throws MeshError for a part that is not convex, with the deepest dent below its hull (over corners and edges) and where it is, in the
/// file's unit; for one whose faces cover one another (its volume is not that of its hull); and for one whose hull has too many faces.
MeshSolids make_mesh_solids(const ClosedParts& mesh, const MeshUnit& unit, const MeshLimits& limits = {});

/// The one part of this name, or of this number, from 0; the only part of a file without either. Throws MeshError, with numbers and names
/// of what the file has, where there is no such part or there are several.
ClosedParts choose_part(const ClosedParts& mesh, std::string_view name);
ClosedParts choose_part(const ClosedParts& mesh, std::size_t number);
ClosedParts choose_part(const ClosedParts& mesh);

}  // namespace musim::lsdem
