#include "lsdem/shape.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

#include "lsdem/detail/shape_parts.hpp"

namespace musim::lsdem {
namespace {

/// Largest ratio of the two node spacings of a face that still resolves it evenly [-]. The papers' block, 44 nodes on 1.36 x 2.82, has 1.6.
constexpr double kMaxSpacingRatio = 3.0;

/// The best split of `nodes` into nx·ny for edges `a`, `b` and how uneven its spacings are (1: even; infinite: no split).
struct FaceSplit {
    int nx = 0, ny = 0;
    double ratio = std::numeric_limits<double>::infinity();
};

FaceSplit find_face_split(double a, double b, int nodes) {
    FaceSplit best;
    for (int nx = 2; nx * 2 <= nodes; ++nx) {
        if (nodes % nx != 0) continue;
        const int ny = nodes / nx;
        const double spacing_a = a / (nx - 1), spacing_b = b / (ny - 1);
        const double ratio = std::max(spacing_a / spacing_b, spacing_b / spacing_a);
        if (ratio < best.ratio) best = {nx, ny, ratio};
    }
    return best;
}

/// Lattice node (i, j, k) of a box surface: its cell reaches half a spacing to either side, and stops at the edges.
void add_box_node(SurfaceNodes& nodes, const Vector3& size, const std::array<int, 3>& counts, const std::array<int, 3>& index) {
    Vector3 position, center, half, area = Vector3::Zero();
    std::array<double, 3> side{};
    for (int a = 0; a < 3; ++a) {
        const auto u = static_cast<std::size_t>(a);
        const int last = counts[u] - 1;
        const double spacing = size[a] / last;
        side[u] = index[u] == 0 ? -1.0 : index[u] == last ? 1.0 : 0.0;
        // both ends come out at exactly half the edge length
        position[a] = 0.5 * size[a] * (static_cast<double>(2 * index[u] - last) / last);
        half[a] = side[u] == 0.0 ? 0.5 * spacing : 0.25 * spacing;
        center[a] = -side[u] * 0.25 * spacing;
    }
    for (int a = 0; a < 3; ++a) {
        const int b = (a + 1) % 3, c = (a + 2) % 3;
        area[a] = side[static_cast<std::size_t>(a)] * 4.0 * half[b] * half[c];
    }
    detail::add_node(nodes, position, area, center, half);
}

/// Nodes of the face across z first (top, then bottom), the long direction slowest, then the rest of the sides from the top down: the nodes
/// under one neighbor lie close together in memory.
SurfaceNodes make_box_nodes(const Vector3& size, const NodeLattice& lattice) {
    if (std::min({lattice.nx, lattice.ny, lattice.nz}) < 2) throw std::invalid_argument("make_box_shape: two nodes an edge at least");
    const std::array<int, 3> counts{lattice.nx, lattice.ny, lattice.nz};
    SurfaceNodes nodes;
    const auto add_layer = [&](int k, bool border_only) {
        const bool x_slowest = size.x() >= size.y();
        const int slow_count = x_slowest ? lattice.nx : lattice.ny, fast_count = x_slowest ? lattice.ny : lattice.nx;
        for (int s = 0; s < slow_count; ++s) {
            for (int f = 0; f < fast_count; ++f) {
                const bool border = s == 0 || s == slow_count - 1 || f == 0 || f == fast_count - 1;
                if (border_only && !border) continue;
                add_box_node(nodes, size, counts, x_slowest ? std::array{s, f, k} : std::array{f, s, k});
            }
        }
    };
    add_layer(lattice.nz - 1, false);
    add_layer(0, false);
    for (int k = lattice.nz - 2; k > 0; --k) add_layer(k, true);
    return nodes;
}

}  // namespace

NodeLattice make_node_lattice(const Vector3& size, int nodes_per_face) {
    const FaceSplit split = nodes_per_face < 4 ? FaceSplit{} : find_face_split(size.x(), size.y(), nodes_per_face);
    if (split.ratio > kMaxSpacingRatio) {
        const auto even = [&](int n) { return n >= 4 && find_face_split(size.x(), size.y(), n).ratio <= kMaxSpacingRatio; };
        int nearest = std::max(nodes_per_face, 4);
        for (int off = 0; off < 100000; ++off) {
            nearest = even(nodes_per_face - off) ? nodes_per_face - off : nodes_per_face + off;
            if (even(nearest)) break;
        }
        throw std::invalid_argument("no even lattice of " + std::to_string(nodes_per_face) + " nodes on a face of this shape; use " +
                                    std::to_string(nearest));
    }
    const double spacing = std::sqrt(size.x() / (split.nx - 1) * (size.y() / (split.ny - 1)));
    return {split.nx, split.ny, std::max(2, 1 + static_cast<int>(std::lround(size.z() / spacing)))};
}

Shape make_box_shape(const Vector3& size, const NodeLattice& lattice) {
    if (!(size.minCoeff() > 0.0)) throw std::invalid_argument("make_box_shape: edge lengths must be positive");
    Shape shape;
    shape.half_extents = 0.5 * size;
    shape.level_set = BoxLevelSet{shape.half_extents};
    shape.nodes = make_box_nodes(size, lattice);
    shape.node_spacing = size.cwiseQuotient(Vector3(lattice.nx - 1, lattice.ny - 1, lattice.nz - 1));
    shape.volume = size.prod();
    shape.inertia_over_mass = detail::box_inertia_over_mass(size);
    shape.face_area = size.x() * size.y();
    return shape;
}

Shape make_grid_box_shape(const Vector3& size, const NodeLattice& lattice, double voxel) {
    Shape shape = make_box_shape(size, lattice);
    const BoxLevelSet box{shape.half_extents};
    shape.level_set = detail::sample_level_set(shape.half_extents, voxel, [&](const Vector3& x) { return box.value(x); });
    return shape;
}

}  // namespace musim::lsdem
