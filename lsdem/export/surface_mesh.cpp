#include "lsdem/export/surface_mesh.hpp"

#include <map>

namespace musim::lsdem {
namespace {

/// Calls visit(piece, face) for all faces on the surface of a shape.
template <class Visit>
void for_each_surface_face(const BlockShape& shape, const Visit& visit) {
    for (const Polyhedron& piece : shape.solid.pieces) {
        for (const Polyhedron::Face& face : piece.faces) {
            if (face.outer) visit(piece, face);
        }
    }
}

}  // namespace

SurfaceMesh make_surface_mesh(const BlockShape& shape) {
    SurfaceMesh mesh;
    for_each_surface_face(shape, [&](const Polyhedron& piece, const Polyhedron::Face& face) {
        const auto first = static_cast<std::uint32_t>(mesh.places.size());
        for (const std::uint32_t corner : piece.loop(face)) {
            const Vector3& place = piece.corners[corner];
            mesh.places.push_back(place);
            mesh.normals.push_back(shape.radius > 0.0 ? place.normalized() : face.plane.normal);
        }
        for (std::uint32_t i = 1; i + 1 < face.count; ++i) mesh.triangles.push_back({first, first + i, first + i + 1});
    });
    return mesh;
}

SurfacePolygons make_surface_polygons(const BlockShape& shape) {
    SurfacePolygons polygons;
    std::map<std::array<double, 3>, std::uint32_t> known;
    for_each_surface_face(shape, [&](const Polyhedron& piece, const Polyhedron::Face& face) {
        std::vector<std::uint32_t>& corners = polygons.faces.emplace_back();
        for (const std::uint32_t corner : piece.loop(face)) {
            const Vector3& place = piece.corners[corner];
            const auto [found, is_new] =
                known.try_emplace({place.x(), place.y(), place.z()}, static_cast<std::uint32_t>(polygons.corners.size()));
            if (is_new) polygons.corners.push_back(place);
            corners.push_back(found->second);
        }
    });
    return polygons;
}

}  // namespace musim::lsdem
