#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "lsdem/types.hpp"
#include "scaling/error.hpp"

/// Meshes of faces as STL, OBJ and PLY files have them, and the convex solids that they enclose.
namespace musim::lsdem {

/// A mesh that cannot be read, or that encloses no solid that musim takes: `file:line: what (why); what to do`, in one line.
class MeshError : public Error {
  public:
    using Error::Error;
};

/// Limits of what is read and taken. Beyond them a mesh is refused with its number and the limit.
struct MeshLimits {
    std::size_t bytes = 2'000'000'000;  ///< of the file, which is read into memory
    std::size_t triangles = 5'000'000;  ///< a face of n corners counts n - 2; each takes some 300 bytes of memory
    std::size_t faces = 20'000;         ///< of the solid, every one of which contact may ask
    /// Depth of a dent that is taken for rounding [part of the size]: coordinates of six digits, as printf's %g writes them, are off by up
    /// to 5e-6 of the largest. The solid is the hull; its volume differs by no more than this depth times the area.
    double dent = 1e-5;
};

/// The content of a file as it stands: its numbers in its unit, its faces in their winding, nothing joined.
struct Mesh {
    struct Face {
        std::uint32_t first = 0;  ///< of its corners in `loops`
        std::uint32_t count = 0;  ///< of its corners, three at least
        std::uint32_t group = 0;  ///< into `groups`
        std::uint32_t line = 0;   ///< of the file, from 1; 0 in a binary file
    };
    /// Faces of one name: an STL's solid, an OBJ's group in its object. Faces without one are in a group without names.
    struct Group {
        std::string object, name;
    };

    std::string file;    ///< for messages
    std::string format;  ///< e.g. "binary STL"
    std::vector<Vector3> vertices;
    std::vector<std::uint32_t> loops;  ///< into `vertices`: the corners of all faces, one face behind the other
    std::vector<Face> faces;
    std::vector<Group> groups;
    bool indexed = true;            ///< faces share vertices by number; an STL has three of its own for each triangle
    bool single_precision = false;  ///< coordinates are binary numbers of 32 bits

    std::span<const std::uint32_t> loop(const Face& face) const { return std::span(loops).subspan(face.first, face.count); }
};

}  // namespace musim::lsdem
