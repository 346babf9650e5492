#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <stdexcept>

#include "lsdem/detail/shape_parts.hpp"
#include "lsdem/shape.hpp"

namespace musim::lsdem {
namespace {

constexpr double kPi = std::numbers::pi;

/// Signed distance to a solid cylinder about the z axis [m].
double cylinder_distance(const Vector3& x, double radius, double half_height) {
    const double beyond_side = std::hypot(x.x(), x.y()) - radius, beyond_end = std::abs(x.z()) - half_height;
    if (std::max(beyond_side, beyond_end) <= 0.0) return std::max(beyond_side, beyond_end);
    return std::hypot(std::max(beyond_side, 0.0), std::max(beyond_end, 0.0));
}

/// Direction from the axis of node i of `count` around it.
Vector3 outward(int i, int count) {
    const double angle = 2.0 * kPi * i / count;
    return {std::cos(angle), std::sin(angle), 0.0};
}

/// The disc inside the rim, on the side of `sign`: a node in the middle, then rings, each for the annulus half way to its neighbors.
void add_end_nodes(SurfaceNodes& nodes, double radius, double half_height, const CylinderLattice& lattice, double sign) {
    const double spacing = radius / lattice.rings;
    const Vector3 middle{0.0, 0.0, sign * half_height};
    detail::add_node(nodes, middle, {0.0, 0.0, sign * 0.25 * kPi * spacing * spacing});
    for (int ring = 1; ring < lattice.rings; ++ring) {
        const int count = std::max(3, static_cast<int>(std::lround(static_cast<double>(lattice.around) * ring / lattice.rings)));
        const double share = 2.0 * kPi * ring * spacing * spacing / count;
        for (int i = 0; i < count; ++i) detail::add_node(nodes, middle + ring * spacing * outward(i, count), {0.0, 0.0, sign * share});
    }
}

/// Row `row` of the side, counted from the bottom. The first and the last are the rims: they carry the outer half ring of their end too.
void add_side_nodes(SurfaceNodes& nodes, double radius, double height, const CylinderLattice& lattice, int row) {
    const int last = lattice.along - 1;
    const double end = row == 0 ? -1.0 : row == last ? 1.0 : 0.0;
    const double place = 0.5 * height * (static_cast<double>(2 * row - last) / last);
    const double inner = radius * (1.0 - 0.5 / lattice.rings);
    const double side_share = 2.0 * kPi * radius / lattice.around * height / last * (end == 0.0 ? 1.0 : 0.5);
    const double end_share = end * kPi * (radius * radius - inner * inner) / lattice.around;
    for (int i = 0; i < lattice.around; ++i) {
        const Vector3 normal = outward(i, lattice.around);
        detail::add_node(nodes, radius * normal + Vector3(0.0, 0.0, place), side_share * normal + Vector3(0.0, 0.0, end_share));
    }
}

}  // namespace

Shape make_sphere_shape(double radius, std::size_t node_count, double voxel) {
    if (!(radius > 0.0)) throw std::invalid_argument("make_sphere_shape: the radius must be positive");
    if (node_count == 0) throw std::invalid_argument("make_sphere_shape: one node at least");
    Shape shape;
    shape.faceted = false;
    shape.half_extents = Vector3::Constant(radius);
    shape.level_set = detail::sample_level_set(shape.half_extents, voxel, [radius](const Vector3& x) { return x.norm() - radius; });
    const double share = 4.0 * kPi * radius * radius / static_cast<double>(node_count);
    const double golden_angle = kPi * (3.0 - std::sqrt(5.0));
    for (std::size_t i = 0; i < node_count; ++i) {
        const double height = 1.0 - (2.0 * static_cast<double>(i) + 1.0) / static_cast<double>(node_count);
        const double ring = std::sqrt(1.0 - height * height), angle = golden_angle * static_cast<double>(i);
        const Vector3 normal{ring * std::cos(angle), ring * std::sin(angle), height};
        detail::add_node(shape.nodes, radius * normal, share * normal);
    }
    shape.volume = 4.0 / 3.0 * kPi * radius * radius * radius;
    shape.inertia_over_mass = Vector3::Constant(0.4 * radius * radius);
    shape.face_area = kPi * radius * radius;
    return shape;
}

Shape make_cylinder_shape(double radius, double height, const CylinderLattice& lattice, double voxel) {
    if (!(radius > 0.0 && height > 0.0)) throw std::invalid_argument("make_cylinder_shape: radius and height must be positive");
    if (lattice.around < 3 || lattice.rings < 1 || lattice.along < 2)
        throw std::invalid_argument("make_cylinder_shape: three nodes around, one ring and two nodes along at least");
    Shape shape;
    shape.faceted = false;
    shape.half_extents = {radius, radius, 0.5 * height};
    shape.level_set =
        detail::sample_level_set(shape.half_extents, voxel, [=](const Vector3& x) { return cylinder_distance(x, radius, 0.5 * height); });
    add_end_nodes(shape.nodes, radius, 0.5 * height, lattice, 1.0);
    add_end_nodes(shape.nodes, radius, 0.5 * height, lattice, -1.0);
    for (int row = lattice.along - 1; row >= 0; --row) add_side_nodes(shape.nodes, radius, height, lattice, row);
    shape.volume = kPi * radius * radius * height;
    const double across = (3.0 * radius * radius + height * height) / 12.0;
    shape.inertia_over_mass = {across, across, 0.5 * radius * radius};
    shape.face_area = kPi * radius * radius;
    return shape;
}

}  // namespace musim::lsdem
