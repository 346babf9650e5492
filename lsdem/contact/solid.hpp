#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "lsdem/types.hpp"

namespace musim::lsdem {
namespace detail {
struct BoxMeeting;
}

/// A convex body bounded by planes where it stands, in world axes about an origin of the pair it belongs to. Fixed room, so that none is
/// allocated in a step.
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
