#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "lsdem/solid/vectors.hpp"

/// Solids bounded by planes, in the frame of a block: what contact, checks, statics and pictures know of a block's form.
namespace musim::lsdem {

/// The plane normal·x = offset, with what lies inside below it.
struct Plane {
    Vector3 normal = Vector3::UnitZ();  ///< outward, of unit length
    double offset = 0.0;                ///< from the origin along the normal [m]

    /// Depth of a point below the plane; negative outside [m].
    double depth(const Vector3& x) const { return offset - normal.dot(x); }
    bool operator==(const Plane&) const = default;
};

/// A convex polyhedron: a piece of a solid.
struct Polyhedron {
    struct Face {
        Plane plane;
        std::uint32_t first = 0;  ///< of its corners in `loops`
        std::uint32_t count = 0;  ///< of its corners, counter-clockwise seen from outside
        /// Is part of the solid's surface. Faces between two pieces are not: they bear nothing.
        bool outer = true;

        bool operator==(const Face&) const = default;
    };
    std::vector<Vector3> corners;           ///< [m]
    std::vector<Face> faces;                ///< corners in one plane make one face
    std::vector<std::uint32_t> loops;       ///< into `corners`: those of all faces, one face behind the other
    std::vector<std::uint64_t> marks;       ///< corners of all faces, one bit each in words_a_face() words a face
    std::vector<std::uint32_t> neighbours;  ///< beside `loops`: the face on the other side of the edge from that corner to the face's next
    /// Planes that a point of the piece can be nearest to: those of every largest convex part of the solid that holds the piece. The depth
    /// of a point of the piece is the largest, over these parts, of the least depth below their planes: continuous over all pieces. Of a
    /// convex solid the one part is the solid: the planes of its faces, in their order.
    std::vector<std::vector<Plane>> wholes;

    std::size_t words_a_face() const { return (corners.size() + 63) / 64; }
    std::span<const std::uint32_t> loop(const Face& face) const { return std::span(loops).subspan(face.first, face.count); }
    bool operator==(const Polyhedron&) const = default;
};

/// A rigid solid: a convex polyhedron, or convex pieces that touch by whole faces and do not overlap.
struct Solid {
    std::vector<Polyhedron> pieces;

    bool is_convex() const { return pieces.size() == 1; }
    bool operator==(const Solid&) const = default;
};

/// Where a solid is: its frame in the world's, or in that of another solid.
struct Placing {
    Matrix3 rotation = Matrix3::Identity();  ///< body to world
    Vector3 position = Vector3::Zero();      ///< of the origin of its frame [m]

    Vector3 operator*(const Vector3& x) const { return rotation * x + position; }
    /// The placing of a solid that `other` places in the frame that this one places.
    Placing operator*(const Placing& other) const { return {rotation * other.rotation, rotation * other.position + position}; }
    Placing inverse() const { return {rotation.transpose(), -(rotation.transpose() * position)}; }
};

/// The corner of a solid that lies farthest along a direction, in its frame [m].
Vector3 find_support(const Solid& solid, const Vector3& direction);

/// Reach of a solid from the origin of its frame along a direction of unit length [m].
inline double find_reach(const Solid& solid, const Vector3& direction) { return direction.dot(find_support(solid, direction)); }

/// A box along the axes of a frame.
struct Bounds {
    Vector3 low = Vector3::Zero(), high = Vector3::Zero();  ///< [m]

    Vector3 size() const { return high - low; }
    Vector3 middle() const { return 0.5 * (low + high); }
};
/// The smallest box along the world's axes that holds a placed solid.
Bounds find_bounds(const Solid& solid, const Placing& placing = {});

/// Is a point, in the frame of the solid, in it or on its surface?
bool contains(const Solid& solid, const Vector3& x);

/// A polyhedron of the given corners [m] whose faces are given by their corners, counter-clockwise seen from outside: normals by Newell's
/// sum without rounding, neighbours, `wholes` of a convex solid. Faces in one plane must be one. Throws std::invalid_argument when an edge
/// does not belong to two faces in opposite directions.
Polyhedron make_polyhedron(std::vector<Vector3> corners, const std::vector<std::vector<std::uint32_t>>& faces);

/// A box of edge lengths `size` [m] about the origin, the corners by the signs of x, y, z in the bits of their number, faces -x, +x, -y,
/// +y, -z, +z.
Solid make_box_solid(const Vector3& size);

/// The same solid in another frame: x -> rotation·x + position.
Solid moved(const Solid& solid, const Placing& placing);

/// The same solid with all coordinates multiplied, of one sign mirrored: x -> (f_x x, f_y y, f_z z). No factor may be zero.
Solid stretched(const Solid& solid, const Vector3& factors);

}  // namespace musim::lsdem
