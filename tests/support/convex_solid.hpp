#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "lsdem/contact/solid.hpp"

namespace musim::lsdem::tests {

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

/// Corners that lie off a plane by less than this part of the body's size lie in it [-]: far above the rounding of their places.
inline constexpr double kSamePlane = 1e-12;

/// Sorts corners in a plane counter-clockwise about its normal.
inline void sort_around(const std::vector<Vector3>& corners, const Vector3& normal, std::vector<std::uint8_t>& loop) {
    Vector3 middle = Vector3::Zero();
    for (const std::uint8_t c : loop) middle += corners[c] / static_cast<double>(loop.size());
    const Vector3 e = (corners[loop.front()] - middle).normalized(), f = normal.cross(e);
    const auto angle = [&](std::uint8_t c) { return std::atan2(f.dot(corners[c] - middle), e.dot(corners[c] - middle)); };
    std::sort(loop.begin(), loop.end(), [&](std::uint8_t a, std::uint8_t b) { return angle(a) < angle(b); });
}

/// The face through three corners, if all others lie on one side of them and it is not there yet.
inline void add_face(std::size_t i, std::size_t j, std::size_t k, double size, Solid& solid) {
    const std::vector<Vector3>& corners = solid.corners;
    Solid::Face face{.normal = (corners[j] - corners[i]).cross(corners[k] - corners[i]), .corners = {}};
    if (!(face.normal.norm() > kSamePlane * size * size)) return;
    face.normal.normalize();
    face.offset = face.normal.dot(corners[i]);
    if (face.offset < 0.0) face.normal = -face.normal, face.offset = -face.offset;
    for (std::size_t c = 0; c < corners.size(); ++c) {
        const double beyond = face.normal.dot(corners[c]) - face.offset;
        if (beyond > kSamePlane * size) return;
        if (beyond > -kSamePlane * size) face.corners.push_back(static_cast<std::uint8_t>(c));
    }
    for (const Solid::Face& known : solid.faces) {
        if (known.corners == face.corners) return;
    }
    solid.faces.push_back(face);
}

/// The convex hull of the corners [m] of a body that encloses the origin; corners in one plane make one face.
inline Solid make_solid(const std::vector<Vector3>& corners) {
    Solid solid{.corners = corners, .faces = {}};
    double size = 0.0;
    for (const Vector3& corner : corners) size = std::max(size, corner.norm());
    for (std::size_t i = 0; i < corners.size(); ++i) {
        for (std::size_t j = i + 1; j < corners.size(); ++j) {
            for (std::size_t k = j + 1; k < corners.size(); ++k) add_face(i, j, k, size, solid);
        }
    }
    // faces were known by their corners in ascending order
    for (Solid::Face& face : solid.faces) sort_around(corners, face.normal, face.corners);
    return solid;
}

/// Places a solid with its body frame at `center` [m]; refers to `solid`. `rotation`: body to world.
inline void place(const Solid& solid, const Matrix3& rotation, const Vector3& center, PlacedSolid& placed) {
    placed.face_count = solid.faces.size();
    placed.corner_count = solid.corners.size();
    for (std::size_t c = 0; c < solid.corners.size(); ++c) placed.corner[c] = rotation * solid.corners[c] + center;
    for (std::size_t f = 0; f < solid.faces.size(); ++f) {
        const Solid::Face& face = solid.faces[f];
        placed.normal[f] = rotation * face.normal;
        placed.offset[f] = face.offset + placed.normal[f].dot(center);
        placed.loop[f] = {face.corners.data(), face.corners.size()};
    }
}

}  // namespace musim::lsdem::tests
