#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "lsdem/solid/solid.hpp"

namespace musim::lsdem::tests {

/// Corners that lie off a plane by less than this part of the body's size lie in it [-]: far above the rounding of their places.
inline constexpr double kInPlane = 1e-12;

/// Sorts corners in a plane counter-clockwise about its normal.
inline void sort_around(const std::vector<Vector3>& corners, const Vector3& normal, std::vector<std::uint32_t>& loop) {
    Vector3 middle = Vector3::Zero();
    for (const std::uint32_t c : loop) middle += corners[c] / static_cast<double>(loop.size());
    const Vector3 e = (corners[loop.front()] - middle).normalized(), f = normal.cross(e);
    const auto angle = [&](std::uint32_t c) { return std::atan2(f.dot(corners[c] - middle), e.dot(corners[c] - middle)); };
    std::sort(loop.begin(), loop.end(), [&](std::uint32_t a, std::uint32_t b) { return angle(a) < angle(b); });
}

/// The convex hull of the corners [m] of a body that encloses the origin, by trying all planes through three of them.
inline Solid make_solid(const std::vector<Vector3>& corners) {
    double size = 0.0;
    for (const Vector3& corner : corners) size = std::max(size, corner.norm());
    std::vector<std::vector<std::uint32_t>> faces;
    const auto add_face = [&](std::size_t i, std::size_t j, std::size_t k) {
        Vector3 normal = (corners[j] - corners[i]).cross(corners[k] - corners[i]);
        if (!(normal.norm() > kInPlane * size * size)) return;
        normal *= (normal.dot(corners[i]) < 0.0 ? -1.0 : 1.0) / normal.norm();
        std::vector<std::uint32_t> loop;
        for (std::uint32_t c = 0; c < corners.size(); ++c) {
            const double beyond = normal.dot(corners[c] - corners[i]);
            if (beyond > kInPlane * size) return;
            if (beyond > -kInPlane * size) loop.push_back(c);
        }
        sort_around(corners, normal, loop);
        std::rotate(loop.begin(), std::min_element(loop.begin(), loop.end()), loop.end());
        if (std::find(faces.begin(), faces.end(), loop) == faces.end()) faces.push_back(loop);
    };
    for (std::size_t i = 0; i < corners.size(); ++i) {
        for (std::size_t j = i + 1; j < corners.size(); ++j) {
            for (std::size_t k = j + 1; k < corners.size(); ++k) add_face(i, j, k);
        }
    }
    return {{make_polyhedron(corners, faces)}};
}

}  // namespace musim::lsdem::tests
