#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "lsdem/mesh/mesh.hpp"

namespace musim::lsdem {

/// A closed surface: each edge belongs to two of its faces, which are wound counter-clockwise seen from outside.
struct ClosedPart {
    struct Face {
        std::uint32_t first = 0;   ///< of its corners in `loops`
        std::uint32_t count = 0;   ///< of its corners, three at least
        std::uint32_t number = 0;  ///< in the file, from 1
        std::uint32_t line = 0;    ///< of the file, from 1; 0 in a binary file
    };

    std::size_t number = 0;            ///< in the file, from 0
    std::string name;                  ///< of its group; empty without one
    std::vector<Vector3> corners;      ///< in the file's unit and frame
    std::vector<std::uint32_t> loops;  ///< into `corners`
    std::vector<Face> faces;           ///< in the order of the file
    double size = 0.0;                 ///< the longest edge of the box around it along the axes [file's unit]
    double area = 0.0;                 ///< by Newell's sum over each face, whatever its corners' order begins with [file's unit²]
    double volume = 0.0;               ///< [file's unit³]
    std::size_t corners_read = 0;      ///< vertices of the file that became `corners`
    std::size_t turned = 0;            ///< faces that the file winds the other way

    std::span<const std::uint32_t> loop(const Face& face) const { return std::span(loops).subspan(face.first, face.count); }
    std::size_t triangles() const { return loops.size() - 2 * faces.size(); }
};

/// The closed surfaces of a file, in the order of their first faces.
struct ClosedParts {
    std::string file, format;       ///< for messages
    bool single_precision = false;  ///< its coordinates are binary numbers of 32 bits
    std::size_t left_out = 0;       ///< triangles with two equal corners
    std::vector<ClosedPart> parts;
};

/// Parts a mesh into closed surfaces, before anything is joined across them: by groups, by what faces share, and by the order of the file,
/// where a closed surface ends before the next begins; so two blocks that share a face stay two. Only groups that are open alone (sides of
/// one body) are joined. Vertices of one part are joined where their coordinates are equal, to the last bit; 0 is -0. Triangles that two
/// equal corners make an edge are left out.
///
/// Each part is then wound by itself: along its edges, and outwards by its volume; normals of the file have no say.
///
/// Throws MeshError, with faces by number, line and coordinates, for a face with an area below `kLeastArea` of the size squared, with a
/// corner twice, or with corners off its plane by more than the limit of a dent; for edges of one face, with their number, or of three; for
/// a surface with one side, and for a volume below `kLeastVolume` of the size cubed.
ClosedParts split_mesh(const Mesh& mesh, const MeshLimits& limits = {});

/// The triangles, corners and parts of a file, how many corners were joined and how many faces turned, in one line of words.
std::string describe_parts(const ClosedParts& mesh);

/// Least area of a face [part of the size squared]: that of a triangle along the body whose height is the rounding of doubles, 2e-12 of
/// the size with some digits of the file's origin; its plane would have no direction.
inline constexpr double kLeastArea = 1e-12;

/// Least volume [part of the size cubed]: that of a plate as thin as the planes that a hull takes for one.
inline constexpr double kLeastVolume = 1e-12;

}  // namespace musim::lsdem
