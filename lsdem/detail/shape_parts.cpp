#include "lsdem/detail/shape_parts.hpp"

#include <array>
#include <cmath>
#include <cstddef>
#include <stdexcept>

namespace musim::lsdem::detail {

void add_node(SurfaceNodes& nodes, const Vector3& position, const Vector3& area, const Vector3& center, const Vector3& half) {
    nodes.x.push_back(position.x());
    nodes.y.push_back(position.y());
    nodes.z.push_back(position.z());
    nodes.area_x.push_back(area.x());
    nodes.area_y.push_back(area.y());
    nodes.area_z.push_back(area.z());
    nodes.center_x.push_back(center.x());
    nodes.center_y.push_back(center.y());
    nodes.center_z.push_back(center.z());
    nodes.half_x.push_back(half.x());
    nodes.half_y.push_back(half.y());
    nodes.half_z.push_back(half.z());
}

void add_node(SurfaceNodes& nodes, const Vector3& position, const Vector3& area) {
    add_node(nodes, position, area, Vector3::Zero(), Vector3::Zero());
}

Vector3 box_inertia_over_mass(const Vector3& size) {
    const Vector3 s2 = size.cwiseProduct(size);
    return Vector3(s2.y() + s2.z(), s2.x() + s2.z(), s2.x() + s2.y()) / 12.0;
}

GridLevelSet sample_level_set(const Vector3& half, double voxel, const std::function<double(const Vector3&)>& distance) {
    if (!(voxel > 0.0)) throw std::invalid_argument("grid level set: the voxel size must be positive");
    std::array<std::size_t, 3> counts{};
    Vector3 origin;
    for (int a = 0; a < 3; ++a) {
        const auto voxels = static_cast<std::size_t>(std::ceil(2.0 * half[a] / voxel)) + 2;
        counts[static_cast<std::size_t>(a)] = voxels + 1;
        origin[a] = -0.5 * voxel * static_cast<double>(voxels);
    }
    return {origin, voxel, counts, distance};
}

}  // namespace musim::lsdem::detail
