#include "lsdem/solid/solid_gap.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace musim::lsdem {
namespace {

/// Sine of the angle below which two edges count as parallel [-]. They separate what faces do not by less than this part of their lengths.
constexpr double kParallelEdges = 1e-9;

/// An edge, with the normals of the faces on its left and on its right seen from outside.
struct Edge {
    Vector3 from, along;
    Vector3 left, right;
};

std::vector<Edge> collect_edges(const Polyhedron& body, const Placing& place) {
    std::vector<Edge> edges;
    for (std::uint32_t f = 0; f < body.faces.size(); ++f) {
        const Polyhedron::Face& face = body.faces[f];
        for (std::uint32_t i = 0; i < face.count; ++i) {
            const std::uint32_t other = body.neighbours[face.first + i];
            if (other < f) continue;
            const Vector3 &from = body.corners[body.loops[face.first + i]],
                          &to = body.corners[body.loops[face.first + (i + 1) % face.count]];
            edges.push_back({place * from, place.rotation * (to - from), place.rotation * face.plane.normal,
                             place.rotation * body.faces[other].plane.normal});
        }
    }
    return edges;
}

/// The widest gap along the normals of the faces of a body, from it to the corners of another one in its frame [m].
double find_gap_along_faces(const Polyhedron& body, const std::vector<Vector3>& corners) {
    double widest = -std::numeric_limits<double>::infinity();
    for (const Polyhedron::Face& face : body.faces) {
        double gap = std::numeric_limits<double>::infinity();
        for (const Vector3& corner : corners) {
            gap = std::min(gap, -face.plane.depth(corner));
            if (gap <= widest) break;
        }
        widest = std::max(widest, gap);
    }
    return widest;
}

/// Does the plane along two edges touch both bodies there only? On the sphere of normals an edge is the arc between the normals of its
/// faces. The arc of one and the opposite of the other's cross just when the edges make a face of the difference of the bodies
/// [Gregorius13].
bool makes_face(const Edge& a, const Edge& b) {
    const double left_of_b = b.left.dot(a.along);
    if (left_of_b * b.right.dot(a.along) >= 0.0) return false;
    const double right_of_a = a.right.dot(b.along);
    return right_of_a * a.left.dot(b.along) < 0.0 && left_of_b * right_of_a < 0.0;
}

double find_gap_across_edges(const std::vector<Edge>& edges_a, const std::vector<Edge>& edges_b) {
    double widest = -std::numeric_limits<double>::infinity();
    for (const Edge& a : edges_a) {
        for (const Edge& b : edges_b) {
            if (!makes_face(a, b)) continue;
            Vector3 normal = a.along.cross(b.along);
            const double length = normal.norm();
            if (!(length > kParallelEdges * a.along.norm() * b.along.norm())) continue;
            // outward of a
            if (normal.dot(a.left + a.right) < 0.0) normal = -normal;
            widest = std::max(widest, normal.dot(b.from - a.from) / length);
        }
    }
    return widest;
}

/// The largest, over the convex parts that hold a piece, of the least depth of a point below their planes [m].
double find_depth(const Polyhedron& piece, const Vector3& x) {
    double depth = -std::numeric_limits<double>::infinity();
    for (const std::vector<Plane>& whole : piece.wholes) {
        double least = std::numeric_limits<double>::infinity();
        for (const Plane& plane : whole) least = std::min(least, plane.depth(x));
        depth = std::max(depth, least);
    }
    return depth;
}

/// Distance of a point above a face from it [m].
double find_distance(const Polyhedron& body, const Polyhedron::Face& face, const Vector3& x) {
    const auto loop = body.loop(face);
    double squared = std::numeric_limits<double>::infinity();
    bool is_above = true;
    for (std::size_t i = 0; i < loop.size(); ++i) {
        const Vector3& from = body.corners[loop[i]];
        const Vector3 along = body.corners[loop[(i + 1) % loop.size()]] - from, there = x - from;
        is_above = is_above && along.cross(there).dot(face.plane.normal) >= 0.0;
        const double share = std::clamp(along.dot(there) / along.squaredNorm(), 0.0, 1.0);
        squared = std::min(squared, (there - share * along).squaredNorm());
    }
    return is_above ? -face.plane.depth(x) : std::sqrt(squared);
}

/// Distance of a point from a convex polyhedron; negative inside [m].
double find_gap_to_point(const Polyhedron& piece, const Vector3& x) {
    double nearest = std::numeric_limits<double>::infinity();
    for (const Polyhedron::Face& face : piece.faces) {
        if (face.plane.depth(x) < 0.0) nearest = std::min(nearest, find_distance(piece, face, x));
    }
    return std::isfinite(nearest) ? nearest : -find_depth(piece, x);
}

void place_corners(const Polyhedron& body, const Placing& place, std::vector<Vector3>& corners) {
    corners.clear();
    for (const Vector3& corner : body.corners) corners.push_back(place * corner);
}

/// Along the faces of both; `back`: the inverse of `place`.
double find_gap_of_faces(const Polyhedron& a, const Polyhedron& b, const Placing& place, const Placing& back) {
    thread_local std::vector<Vector3> corners;  // room
    place_corners(b, place, corners);
    const double of_a = find_gap_along_faces(a, corners);
    place_corners(a, back, corners);
    return std::max(of_a, find_gap_along_faces(b, corners));
}

}  // namespace

double find_gap(const Polyhedron& a, const Polyhedron& b, const Placing& place) {
    return std::max(find_gap_of_faces(a, b, place, place.inverse()), find_gap_across_edges(collect_edges(a, {}), collect_edges(b, place)));
}

double find_gap(const Solid& a, const Solid& b, const Placing& place) {
    double least = std::numeric_limits<double>::infinity();
    for (const Polyhedron& of_a : a.pieces) {
        for (const Polyhedron& of_b : b.pieces) least = std::min(least, find_gap(of_a, of_b, place));
    }
    return least;
}

double find_gap_of_faces(const Solid& a, const Solid& b, const Placing& place) {
    const Placing back = place.inverse();
    double least = std::numeric_limits<double>::infinity();
    for (const Polyhedron& of_a : a.pieces) {
        for (const Polyhedron& of_b : b.pieces) least = std::min(least, find_gap_of_faces(of_a, of_b, place, back));
    }
    return least;
}

double find_gap(const Solid& solid, const Vector3& x) {
    double least = std::numeric_limits<double>::infinity();
    for (const Polyhedron& piece : solid.pieces) least = std::min(least, find_gap_to_point(piece, x));
    return least;
}

}  // namespace musim::lsdem
