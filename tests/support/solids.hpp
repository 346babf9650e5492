#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <map>
#include <random>
#include <utility>
#include <vector>

#include "lsdem/solid/solid.hpp"

namespace musim::lsdem::tests {

/// A rotation drawn evenly from all.
inline Matrix3 draw_rotation(std::mt19937_64& random) {
    std::normal_distribution<double> normal;
    return Quaternion(normal(random), normal(random), normal(random), normal(random)).normalized().toRotationMatrix();
}

/// The box from `low` to `high` [m].
inline Polyhedron make_box_piece(const Vector3& low, const Vector3& high) {
    return moved(make_box_solid(high - low), {.rotation = Matrix3::Identity(), .position = 0.5 * (low + high)}).pieces.front();
}

/// Every edge lies between two faces in opposite directions, `neighbours` names the other one, Euler's formula holds, and no corner lies
/// beyond a face's plane or off a plane of its own by more than `tolerance` [m].
inline bool is_convex_polyhedron(const Polyhedron& body, double tolerance) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> face_of;
    std::vector<int> faces_at(body.corners.size(), 0);
    for (std::uint32_t f = 0; f < body.faces.size(); ++f) {
        const auto loop = body.loop(body.faces[f]);
        if (loop.size() < 3) return false;
        for (std::size_t i = 0; i < loop.size(); ++i) {
            if (!face_of.try_emplace({loop[i], loop[(i + 1) % loop.size()]}, f).second) return false;
            ++faces_at[loop[i]];
        }
        for (const Vector3& corner : body.corners) {
            if (body.faces[f].plane.depth(corner) < -tolerance) return false;
        }
        for (const std::uint32_t c : loop) {
            if (std::abs(body.faces[f].plane.depth(body.corners[c])) > tolerance) return false;
        }
    }
    for (const Polyhedron::Face& face : body.faces) {
        for (std::uint32_t i = 0; i < face.count; ++i) {
            const auto other = face_of.find({body.loops[face.first + (i + 1) % face.count], body.loops[face.first + i]});
            if (other == face_of.end() || other->second != body.neighbours[face.first + i]) return false;
        }
    }
    for (const int faces : faces_at) {
        if (faces < 3) return false;
    }
    return body.corners.size() + body.faces.size() == face_of.size() / 2 + 2;
}

}  // namespace musim::lsdem::tests
