#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <stdexcept>

#include "lsdem/shape.hpp"

namespace musim::lsdem {
namespace {

/// Faces within this angle of each other bear together: cos 15° [-].
constexpr double kTogether = 0.966;

double find_area(const Polyhedron& piece, const Polyhedron::Face& face) {
    const auto loop = piece.loop(face);
    const Vector3& origin = piece.corners[loop.front()];
    Vector3 twice = Vector3::Zero();
    for (std::size_t i = 1; i + 1 < loop.size(); ++i) {
        twice += (piece.corners[loop[i]] - origin).cross(piece.corners[loop[i + 1]] - origin);
    }
    return 0.5 * twice.dot(face.plane.normal);
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

/// Area of the faces that look down, or of those about the face that does most of all [m²].
double find_base_area(const Solid& drawn) {
    double lowest = std::numeric_limits<double>::infinity();
    Vector3 down = -Vector3::UnitZ();
    for_each_outer_face(drawn, [&](const Polyhedron& /*piece*/, const Polyhedron::Face& face) {
        if (face.plane.normal.z() < lowest) lowest = face.plane.normal.z();
    });
    if (-lowest < kTogether) {
        for_each_outer_face(drawn, [&](const Polyhedron& /*piece*/, const Polyhedron::Face& face) {
            if (face.plane.normal.z() == lowest) down = face.plane.normal;
        });
    }
    double area = 0.0;
    for_each_outer_face(drawn, [&](const Polyhedron& piece, const Polyhedron::Face& face) {
        if (face.plane.normal.dot(down) >= kTogether) area += find_area(piece, face);
    });
    return area;
}

}  // namespace

Shape make_solid_shape(const Solid& drawn, const std::optional<MassProperties>& given) {
    const MassProperties mass = given ? *given : compute_mass_properties(drawn);
    if (!(mass.volume > 0.0)) throw std::invalid_argument("make_solid_shape: the solid has no volume");
    const PrincipalAxes principal = find_principal_axes(mass.inertia_over_mass);
    if (!(principal.moments.minCoeff() > 0.0)) throw std::invalid_argument("make_solid_shape: moments of inertia must be positive");
    Shape shape;
    shape.own = Placing{principal.axes, mass.centre}.inverse();
    const auto solid = std::make_shared<const Solid>(moved(drawn, shape.own));
    const Bounds bounds = find_bounds(*solid);
    shape.half_extents = bounds.high.cwiseMax(-bounds.low);
    shape.level_set = BoxLevelSet{shape.half_extents};
    shape.solid = solid;
    shape.volume = mass.volume;
    shape.inertia_over_mass = principal.moments;
    shape.face_area = find_base_area(drawn);
    return shape;
}

}  // namespace musim::lsdem
