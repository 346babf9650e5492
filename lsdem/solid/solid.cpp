#include "lsdem/solid/solid.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <map>
#include <stdexcept>
#include <utility>

#include "lsdem/solid/detail/exact_sum.hpp"

namespace musim::lsdem {
namespace {

/// The plane of a loop of corners: its normal by Newell's sum, its offset through their mean.
Plane find_plane(const std::vector<Vector3>& corners, std::span<const std::uint32_t> loop) {
    const Vector3 normal = detail::sum_cross_products(corners, loop).normalized();
    const Vector3& origin = corners[loop.front()];
    Vector3 mean = Vector3::Zero();
    for (const std::uint32_t c : loop) mean += (corners[c] - origin) / static_cast<double>(loop.size());
    return {normal, normal.dot(origin) + normal.dot(mean)};
}

/// Finds the face on the other side of every edge.
void find_neighbours(Polyhedron& body) {
    using Edge = std::pair<std::uint32_t, std::uint32_t>;
    std::map<Edge, std::uint32_t> face_of;
    const auto edge_at = [&](const Polyhedron::Face& face, std::uint32_t i) {
        return Edge{body.loops[face.first + i], body.loops[face.first + (i + 1) % face.count]};
    };
    for (std::uint32_t f = 0; f < body.faces.size(); ++f) {
        for (std::uint32_t i = 0; i < body.faces[f].count; ++i) {
            if (!face_of.try_emplace(edge_at(body.faces[f], i), f).second) {
                throw std::invalid_argument("an edge belongs to two faces in the same direction");
            }
        }
    }
    body.neighbours.resize(body.loops.size());
    for (const Polyhedron::Face& face : body.faces) {
        for (std::uint32_t i = 0; i < face.count; ++i) {
            const Edge edge = edge_at(face, i);
            const auto other = face_of.find({edge.second, edge.first});
            if (other == face_of.end()) throw std::invalid_argument("an edge belongs to one face only");
            body.neighbours[face.first + i] = other->second;
        }
    }
}

/// Marks the corners of every face.
void mark_corners(Polyhedron& body) {
    const std::size_t words = body.words_a_face();
    body.marks.assign(words * body.faces.size(), 0);
    for (std::size_t f = 0; f < body.faces.size(); ++f) {
        for (const std::uint32_t c : body.loop(body.faces[f])) body.marks[f * words + c / 64] |= std::uint64_t{1} << (c % 64);
    }
}

/// The one convex part of a convex solid.
void take_as_whole(Polyhedron& body) {
    std::vector<Plane> planes;
    planes.reserve(body.faces.size());
    for (const Polyhedron::Face& face : body.faces) planes.push_back(face.plane);
    body.wholes = {std::move(planes)};
}

Plane moved(const Plane& plane, const Placing& placing) {
    const Vector3 normal = placing.rotation * plane.normal;
    return {normal, plane.offset + normal.dot(placing.position)};
}

/// The image of a plane when coordinates are multiplied.
Plane stretched(const Plane& plane, const Vector3& factors) {
    const Vector3 magnitude = factors.cwiseAbs();
    if (magnitude == Vector3::Constant(magnitude.x()))
        return {plane.normal.cwiseProduct(factors.cwiseSign()), magnitude.x() * plane.offset};
    const Vector3 normal = plane.normal.cwiseQuotient(factors);
    const double length = normal.norm();
    return {normal / length, plane.offset / length};
}

/// Turns all faces about, as a mirrored polyhedron needs it.
void turn_faces(Polyhedron& body) {
    for (const Polyhedron::Face& face : body.faces) {
        const auto first = body.loops.begin() + face.first, last = first + face.count;
        std::reverse(first, last);
    }
    find_neighbours(body);
}

}  // namespace

Polyhedron make_polyhedron(std::vector<Vector3> corners, const std::vector<std::vector<std::uint32_t>>& faces) {
    Polyhedron body;
    body.corners = std::move(corners);
    for (const std::vector<std::uint32_t>& loop : faces) {
        if (loop.size() < 3) throw std::invalid_argument("a face has fewer than three corners");
        body.faces.push_back({.plane = find_plane(body.corners, loop),
                              .first = static_cast<std::uint32_t>(body.loops.size()),
                              .count = static_cast<std::uint32_t>(loop.size())});
        body.loops.insert(body.loops.end(), loop.begin(), loop.end());
    }
    find_neighbours(body);
    mark_corners(body);
    take_as_whole(body);
    return body;
}

Solid make_box_solid(const Vector3& size) {
    const Vector3 half = 0.5 * size;
    std::vector<Vector3> corners;
    for (unsigned c = 0; c < 8; ++c) {
        corners.emplace_back((c & 1U) != 0 ? half.x() : -half.x(), (c & 2U) != 0 ? half.y() : -half.y(),
                             (c & 4U) != 0 ? half.z() : -half.z());
    }
    Polyhedron box =
        make_polyhedron(std::move(corners), {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}});
    // to the last bit
    for (Eigen::Index a = 0; a < 3; ++a) {
        const auto f = 2 * static_cast<std::size_t>(a);
        box.faces[f].plane = {-Vector3::Unit(a), half[a]};
        box.faces[f + 1].plane = {Vector3::Unit(a), half[a]};
    }
    take_as_whole(box);
    return {{std::move(box)}};
}

Vector3 find_support(const Solid& solid, const Vector3& direction) {
    Vector3 best = Vector3::Zero();
    double farthest = -std::numeric_limits<double>::infinity();
    for (const Polyhedron& piece : solid.pieces) {
        for (const Vector3& corner : piece.corners) {
            const double along = direction.dot(corner);
            if (along > farthest) farthest = along, best = corner;
        }
    }
    return best;
}

Bounds find_bounds(const Solid& solid, const Placing& placing) {
    constexpr double kNowhere = std::numeric_limits<double>::infinity();
    Bounds bounds{Vector3::Constant(kNowhere), Vector3::Constant(-kNowhere)};
    for (const Polyhedron& piece : solid.pieces) {
        for (const Vector3& corner : piece.corners) {
            const Vector3 x = placing * corner;
            bounds.low = bounds.low.cwiseMin(x);
            bounds.high = bounds.high.cwiseMax(x);
        }
    }
    return bounds;
}

bool contains(const Solid& solid, const Vector3& x) {
    return std::any_of(solid.pieces.begin(), solid.pieces.end(), [&](const Polyhedron& piece) {
        return std::all_of(piece.faces.begin(), piece.faces.end(),
                           [&](const Polyhedron::Face& face) { return face.plane.depth(x) >= 0.0; });
    });
}

Solid moved(const Solid& solid, const Placing& placing) {
    Solid result = solid;
    for (Polyhedron& piece : result.pieces) {
        for (Vector3& corner : piece.corners) corner = placing * corner;
        for (Polyhedron::Face& face : piece.faces) face.plane = moved(face.plane, placing);
        for (auto& whole : piece.wholes) {
            for (Plane& plane : whole) plane = moved(plane, placing);
        }
    }
    return result;
}

Solid stretched(const Solid& solid, const Vector3& factors) {
    Solid result = solid;
    for (Polyhedron& piece : result.pieces) {
        for (Vector3& corner : piece.corners) corner = corner.cwiseProduct(factors);
        for (Polyhedron::Face& face : piece.faces) face.plane = stretched(face.plane, factors);
        for (auto& whole : piece.wholes) {
            for (Plane& plane : whole) plane = stretched(plane, factors);
        }
        if (factors.prod() < 0.0) turn_faces(piece);
    }
    return result;
}

}  // namespace musim::lsdem
