#include "lsdem/contact/depth_cells.hpp"

#include <algorithm>
#include <limits>
#include <utility>

namespace musim::lsdem::detail {

namespace {

/// Part of a polygon's radius by which it is taken to be larger, far above rounding [-].
constexpr double kRadiusMargin = 1e-9;

/// A sphere that holds a polygon.
struct Sphere {
    Vector3 middle = Vector3::Zero();
    double radius = 0.0;

    explicit Sphere(const Polygon& polygon) {
        for (std::size_t i = 0; i < polygon.size(); ++i) middle += polygon[i];
        middle /= static_cast<double>(polygon.size());
        for (std::size_t i = 0; i < polygon.size(); ++i) radius = std::max(radius, (polygon[i] - middle).squaredNorm());
        radius = (1.0 + kRadiusMargin) * std::sqrt(radius);
    }
};

/// Is an affine function, of value `middle` in the middle of a sphere, above zero all over it? Says no of planes that are nearly parallel,
/// where rounding would decide over all of a polygon at once.
bool is_above(const Vector3& slope, double middle, double radius) {
    constexpr double kNearlyParallel = 1e-6;
    const double steepness = slope.squaredNorm();
    return steepness > kNearlyParallel && middle > 0.0 && middle * middle > steepness * (radius * radius);
}

}  // namespace

void DepthCells::find_candidates(const Polygon& polygon, const PlacedPiece& piece, std::size_t whole, Level& room) {
    room.candidates.clear();
    room.least.clear();
    double bound = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < piece.whole_size(whole); ++i) {
        const std::uint32_t k = piece.member(whole, i);
        const Affine depth = depth_below(piece.nearest_plane(k));
        double most = 0.0, least = std::numeric_limits<double>::infinity();
        for (std::size_t c = 0; c < polygon.size(); ++c) {
            const double d = depth(polygon[c]);
            least = std::min(least, d);
            most = std::max(most, d);
        }
        bound = std::min(bound, most);
        room.candidates.push_back(k);
        room.least.push_back(least);
    }
    std::size_t kept = 0;
    for (std::size_t i = 0; i < room.candidates.size(); ++i) {
        if (room.least[i] <= bound) room.candidates[kept++] = room.candidates[i];
    }
    room.candidates.resize(kept);
}

void DepthCells::cut_cell(const Polygon& polygon, const PlacedPiece& piece, std::uint32_t k, Level& room) {
    const Affine own = depth_below(piece.nearest_plane(k));
    room.cell.copy(polygon);
    for (const std::uint32_t other : room.candidates) {
        if (other == k) continue;
        cutter_.clip(difference(depth_below(piece.nearest_plane(other)), own), other > k, room.cell);
        if (room.cell.empty()) return;
    }
}

void DepthCells::find_neighbours(const Polygon& polygon, const PlacedPiece& piece, std::size_t whole, Level& room) {
    const Sphere sphere(polygon);
    piece.nearest_rows.find_depths(sphere.middle, room.depth);
    std::uint32_t nearest = piece.member(whole, 0);
    for (std::size_t i = 1; i < piece.whole_size(whole); ++i) {
        const std::uint32_t k = piece.member(whole, i);
        if (room.depth[k] < room.depth[nearest]) nearest = k;
    }
    const double reach = room.depth[nearest] + 2.0 * sphere.radius;
    const Affine own = depth_below(piece.nearest_plane(nearest));
    room.candidates.clear();
    room.rows.clear();
    const auto add = [&](std::uint32_t k) {
        room.candidates.push_back(k);
        room.rows.push_back(piece.nearest_plane(k));
        if (room.nearer.size() <= room.candidates.size()) room.nearer.resize(room.candidates.size() + 1);
    };
    if (room.nearer.empty()) room.nearer.resize(1);
    room.nearer[0].copy(polygon);
    add(nearest);
    for (std::size_t i = 0; i < piece.whole_size(whole); ++i) {
        const std::uint32_t k = piece.member(whole, i);
        if (k == nearest || room.depth[k] > reach) continue;
        const Affine beyond = difference(depth_below(piece.nearest_plane(k)), own);
        if (is_above(beyond.slope, room.depth[k] - room.depth[nearest], sphere.radius)) continue;
        if (cutter_.find_rest(beyond, k > nearest, polygon, room.nearer[room.candidates.size()])) add(k);
    }
}

void DepthCells::cut_nearer(const PlacedPiece& piece, std::size_t candidate, Level& room) {
    const std::uint32_t k = room.candidates[candidate];
    Polygon& cell = room.nearer[candidate];
    const Affine own = depth_below(piece.nearest_plane(k));
    const auto find_beyond = [&](std::size_t i) { return difference(depth_below(piece.nearest_plane(room.candidates[i])), own); };
    if (candidate == 0) {
        for (std::size_t i = 1; i < room.candidates.size() && !cell.empty(); ++i) {
            cutter_.clip(find_beyond(i), room.candidates[i] > k, cell);
        }
        return;
    }
    // little is left, far above which most others are
    const Sphere sphere(cell);
    room.rows.find_depths(sphere.middle, room.depth);
    const double at = room.depth[candidate];
    for_each_up_to(room.depth, room.candidates.size(), at + 2.0 * sphere.radius, [&](std::size_t i) {
        if (i == 0 || i == candidate || cell.empty()) return;
        const Affine beyond = find_beyond(i);
        if (!is_above(beyond.slope, room.depth[i] - at, sphere.radius)) cutter_.clip(beyond, room.candidates[i] > k, cell);
    });
}

}  // namespace musim::lsdem::detail
