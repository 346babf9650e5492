#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "lsdem/types.hpp"

namespace musim::lsdem {
namespace detail {
struct BoxMeeting;
}

/// A convex body bounded by planes, in its body frame: the points x with normal·x ≤ offset for every face.
struct Solid {
    struct Face {
        Vector3 normal;                     ///< outward, of unit length
        double offset = 0.0;                ///< of the plane from the origin along the normal [m]
        std::vector<std::uint8_t> corners;  ///< into `corners`, counter-clockwise seen from outside
    };
    std::vector<Vector3> corners;  ///< [m]
    std::vector<Face> faces;
};

/// The convex hull of the corners [m] of a body that encloses the origin; corners in one plane make one face. Throws
/// std::invalid_argument for fewer than four corners, more than PlacedSolid holds, or an origin that is not inside.
Solid make_solid(const std::vector<Vector3>& corners);

/// A solid where it stands, in world axes about an origin of the pair it belongs to. Fixed room, so that none is allocated in a step.
struct PlacedSolid {
    static constexpr std::size_t kMostFaces = 16, kMostCorners = 24;

    std::size_t face_count = 0, corner_count = 0;
    std::array<Vector3, kMostFaces> normal;    ///< outward
    std::array<double, kMostFaces> offset;     ///< of the plane from the origin of the pair along the normal [m]
    std::array<Vector3, kMostCorners> corner;  ///< [m]
    /// Corners of every face, counter-clockwise seen from outside.
    struct Loop {
        const std::uint8_t* first = nullptr;
        std::size_t count = 0;
    };
    std::array<Loop, kMostFaces> loop;

    PlacedSolid() {}  // room that is not used is not cleared

    /// Depth of a point below plane k; negative outside [m].
    double depth(std::size_t k, const Vector3& x) const { return offset[k] - normal[k].dot(x); }
};

/// Places a solid with its body frame at `center` [m]; refers to `solid`. `rotation`: body to world.
void place(const Solid& solid, const Matrix3& rotation, const Vector3& center, PlacedSolid& placed);

/// Places a box of half extents `half` [m].
void place_box(const Vector3& half, const Matrix3& rotation, const Vector3& center, PlacedSolid& placed);

/// The half space z ≤ `height`, seen by a body about the origin no point of which is farther away than `reach` [m]: of its face, the square
/// that holds all that the body can cover.
void place_half_space(double height, double reach, PlacedSolid& placed);

/// Two boxes, or a box and the ground, about the origin of the pair.
struct PlacedPair {
    PlacedSolid a, b;
    Vector3 apart;  ///< from the first centre to the second [m]

    explicit PlacedPair(const detail::BoxMeeting& boxes);
};

}  // namespace musim::lsdem
