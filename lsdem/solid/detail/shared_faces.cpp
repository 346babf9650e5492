#include "lsdem/solid/detail/shared_faces.hpp"

#include <algorithm>
#include <cmath>

namespace musim::lsdem::detail {
namespace {

/// The plane along an edge of a face, across the face; the face lies below it.
Plane find_edge_plane(const Vector3& from, const Vector3& to, const Vector3& face_normal) {
    const Vector3 normal = (to - from).cross(face_normal).normalized();
    return {normal, normal.dot(from)};
}

/// The share of a convex polygon below a plane.
void clip(std::vector<Vector3>& polygon, const Plane& plane) {
    std::vector<Vector3> kept;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const Vector3 &here = polygon[i], &next = polygon[(i + 1) % polygon.size()];
        const double depth = plane.depth(here), next_depth = plane.depth(next);
        if (depth >= 0.0) kept.push_back(here);
        if ((depth < 0.0) != (next_depth < 0.0)) kept.push_back(here + depth / (depth - next_depth) * (next - here));
    }
    polygon = std::move(kept);
}

/// Is a polygon wider than the tolerance? By its area over half its perimeter.
bool is_wide(const std::vector<Vector3>& polygon, double tolerance) {
    Vector3 twice_area = Vector3::Zero();
    double perimeter = 0.0;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const Vector3 &here = polygon[i], &next = polygon[(i + 1) % polygon.size()];
        twice_area += (here - polygon.front()).cross(next - polygon.front());
        perimeter += (next - here).norm();
    }
    return twice_area.norm() > tolerance * perimeter;
}

/// The polygon in which two faces touch, counter-clockwise seen from outside the first; empty where they do not.
std::vector<Vector3> find_touching_polygon(const Polyhedron& a, const Polyhedron::Face& face_a, const Polyhedron& b,
                                           const Polyhedron::Face& face_b, double tolerance) {
    if (face_a.plane.normal.dot(face_b.plane.normal) >= 0.0) return {};
    std::vector<Vector3> polygon;
    for (const std::uint32_t c : b.loop(face_b)) polygon.push_back(b.corners[c]);
    std::reverse(polygon.begin(), polygon.end());
    const auto height = [&](const Vector3& x) { return std::abs(face_a.plane.depth(x)); };
    if (std::all_of(polygon.begin(), polygon.end(), [&](const Vector3& x) { return face_a.plane.depth(x) < -tolerance; })) return {};
    const auto loop = a.loop(face_a);
    for (std::size_t i = 0; i < loop.size() && !polygon.empty(); ++i) {
        clip(polygon, find_edge_plane(a.corners[loop[i]], a.corners[loop[(i + 1) % loop.size()]], face_a.plane.normal));
    }
    if (polygon.size() < 3 || !is_wide(polygon, tolerance)) return {};
    if (!std::all_of(polygon.begin(), polygon.end(), [&](const Vector3& x) { return height(x) <= tolerance; })) return {};
    return polygon;
}

bool are_apart(const Bounds& a, const Bounds& b, double tolerance) {
    return ((a.low - b.high).maxCoeff() > tolerance) || ((b.low - a.high).maxCoeff() > tolerance);
}

}  // namespace

std::vector<SharedFace> find_shared_faces(std::span<const Polyhedron> parts, double tolerance) {
    std::vector<Bounds> bounds;
    for (const Polyhedron& part : parts) bounds.push_back(find_bounds({{part}}));
    std::vector<SharedFace> shared_faces;
    for (std::size_t a = 0; a < parts.size(); ++a) {
        for (std::size_t b = a + 1; b < parts.size(); ++b) {
            if (are_apart(bounds[a], bounds[b], tolerance)) continue;
            for (std::uint32_t f = 0; f < parts[a].faces.size(); ++f) {
                for (std::uint32_t g = 0; g < parts[b].faces.size(); ++g) {
                    std::vector<Vector3> polygon =
                        find_touching_polygon(parts[a], parts[a].faces[f], parts[b], parts[b].faces[g], tolerance);
                    if (!polygon.empty()) shared_faces.push_back({{a, b}, {f, g}, std::move(polygon)});
                }
            }
        }
    }
    return shared_faces;
}

bool lies_within(const SharedFace& shared, const Vector3& x) {
    const std::vector<Vector3>& polygon = shared.polygon;
    Vector3 normal = Vector3::Zero();
    for (std::size_t i = 2; i < polygon.size(); ++i) normal += (polygon[i - 1] - polygon[0]).cross(polygon[i] - polygon[0]);
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const Vector3 &from = polygon[i], &to = polygon[(i + 1) % polygon.size()];
        if ((to - from).cross(x - from).dot(normal) < 0.0) return false;
    }
    return true;
}

std::vector<Plane> find_side_planes(const SharedFace& shared, std::size_t side, const Polyhedron& part, double tolerance) {
    const Polyhedron::Face& face = part.faces[shared.faces[side]];
    const auto loop = part.loop(face);
    std::vector<Plane> planes;
    for (std::uint32_t i = 0; i < loop.size(); ++i) {
        const Vector3 &from = part.corners[loop[i]], &to = part.corners[loop[(i + 1) % loop.size()]];
        const Plane across = find_edge_plane(from, to, face.plane.normal);
        const Vector3 along = (to - from).normalized();
        double low = std::numeric_limits<double>::infinity(), high = -low;
        for (const Vector3& x : shared.polygon) {
            if (std::abs(across.depth(x)) > tolerance) continue;
            low = std::min(low, along.dot(x - from));
            high = std::max(high, along.dot(x - from));
        }
        if (high - low > tolerance) planes.push_back(part.faces[part.neighbours[face.first + i]].plane);
    }
    return planes;
}

}  // namespace musim::lsdem::detail
