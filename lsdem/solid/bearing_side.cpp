#include "lsdem/solid/bearing_side.hpp"

namespace musim::lsdem {
namespace {

/// Faces within this angle of each other bear together: cos 15° [-].
constexpr double kTogether = 0.966;

/// Adds the middles of the edges of a face's triangles, a third of the triangle each: exact up to second moments.
void add_points(const Polyhedron& piece, const Polyhedron::Face& face, std::vector<AreaPoint>& points) {
    const auto loop = piece.loop(face);
    const Vector3& a = piece.corners[loop[0]];
    for (std::size_t i = 1; i + 1 < loop.size(); ++i) {
        const Vector3 &b = piece.corners[loop[i]], &c = piece.corners[loop[i + 1]];
        const double third = face.plane.normal.dot((b - a).cross(c - a)) / 6.0;
        for (const Vector3& middle : {Vector3(0.5 * (a + b)), Vector3(0.5 * (b + c)), Vector3(0.5 * (c + a))}) {
            points.push_back({middle, third});
        }
    }
}

/// Calls visit(piece, face) for all faces on the surface of a solid.
template <class Visit>
void for_each_outer_face(const Solid& solid, const Visit& visit) {
    for (const Polyhedron& piece : solid.pieces) {
        for (const Polyhedron::Face& face : piece.faces) {
            if (face.outer) visit(piece, face);
        }
    }
}

BearingSide make_side(const Solid& solid, const Vector3& normal) {
    BearingSide side{normal, {}};
    for_each_outer_face(solid, [&](const Polyhedron& piece, const Polyhedron::Face& face) {
        if (face.plane.normal.dot(normal) >= kTogether) add_points(piece, face, side.points);
    });
    return side;
}

}  // namespace

double BearingSide::area() const {
    double sum = 0.0;
    for (const AreaPoint& point : points) sum += point.area;
    return sum;
}

BearingSide find_bearing_side(const Solid& solid, const Vector3& direction) {
    Vector3 closest = Vector3::Zero();
    double most = -2.0;
    for_each_outer_face(solid, [&](const Polyhedron& /*piece*/, const Polyhedron::Face& face) {
        const double along = face.plane.normal.dot(direction);
        if (along > most) most = along, closest = face.plane.normal;
    });
    return make_side(solid, closest);
}

std::vector<BearingSide> find_bearing_sides(const Solid& solid) {
    std::vector<BearingSide> sides;
    for_each_outer_face(
        solid, [&](const Polyhedron& /*piece*/, const Polyhedron::Face& face) { sides.push_back(make_side(solid, face.plane.normal)); });
    return sides;
}

}  // namespace musim::lsdem
