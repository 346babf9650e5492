#include "lsdem/contact/depth_cells.hpp"

#include <algorithm>
#include <limits>
#include <utility>

namespace musim::lsdem::detail {

void PolygonCutter::clip(const Affine& inside, bool with_border, Polygon& polygon) {
    const std::size_t before = polygon.size();
    at_.resize(before);
    double least = std::numeric_limits<double>::infinity(), most = -least;
    for (std::size_t i = 0; i < before; ++i) {
        at_[i] = inside(polygon[i]);
        least = std::min(least, at_[i]);
        most = std::max(most, at_[i]);
    }
    const auto holds = [&](double value) { return with_border ? value >= 0.0 : value > 0.0; };
    if (holds(least)) return;
    if (!holds(most)) return polygon.clear();
    std::swap(from_, polygon);
    polygon.clear();
    for (std::size_t i = 0; i < before; ++i) {
        const std::size_t next = i + 1 == before ? 0 : i + 1;
        if (holds(at_[i])) polygon.push_back(from_[i]);
        if (holds(at_[i]) == holds(at_[next])) continue;
        polygon.push_back(from_[i] + at_[i] / (at_[i] - at_[next]) * (from_[next] - from_[i]));
    }
}

namespace {

/// Up to so many planes are looked at one by one; of more, those that are far below all of the polygon are left out at one point. Affects
/// speed only.
constexpr std::size_t kFewPlanes = 8;
/// Part of a polygon's radius by which it is taken to be larger, far above rounding [-].
constexpr double kRadiusMargin = 1e-9;

/// A sphere that holds a polygon.
struct Sphere {
    Vector3 middle = Vector3::Zero();
    double radius = 0.0;

    explicit Sphere(const Polygon& polygon) {
        for (const Vector3& x : polygon) middle += x;
        middle /= static_cast<double>(polygon.size());
        for (const Vector3& x : polygon) radius = std::max(radius, (x - middle).squaredNorm());
        radius = (1.0 + kRadiusMargin) * std::sqrt(radius);
    }
};

}  // namespace

void DepthCells::find_candidates(const Polygon& polygon, const PlacedPiece& piece, std::size_t whole, Level& room) {
    const std::size_t count = piece.whole_size(whole);
    room.candidates.clear();
    room.least.clear();
    double bound = std::numeric_limits<double>::infinity();
    std::size_t lowest = 0;
    const auto look_at = [&](std::uint32_t k) {
        const Plane plane = piece.nearest_plane(k);
        double most = 0.0, least = std::numeric_limits<double>::infinity();
        for (const Vector3& x : polygon) {
            const double d = plane.depth(x);
            least = std::min(least, d);
            most = std::max(most, d);
        }
        if (most < bound) bound = most, lowest = room.candidates.size();
        room.candidates.push_back(k);
        room.least.push_back(least);
    };
    if (count <= kFewPlanes) {
        for (std::size_t i = 0; i < count; ++i) look_at(piece.member(whole, i));
    } else {
        const Sphere sphere(polygon);
        double nearest = std::numeric_limits<double>::infinity();
        room.depth.resize(count);
        for (std::size_t i = 0; i < count; ++i) {
            room.depth[i] = piece.nearest_plane(piece.member(whole, i)).depth(sphere.middle);
            nearest = std::min(nearest, room.depth[i]);
        }
        for (std::size_t i = 0; i < count; ++i) {
            if (room.depth[i] <= nearest + 2.0 * sphere.radius) look_at(piece.member(whole, i));
        }
        // the one that is least deep cuts most away, and so comes first
        std::swap(room.candidates[0], room.candidates[lowest]);
        std::swap(room.least[0], room.least[lowest]);
    }
    std::size_t kept = 0;
    for (std::size_t i = 0; i < room.candidates.size(); ++i) {
        if (room.least[i] <= bound) room.candidates[kept++] = room.candidates[i];
    }
    room.candidates.resize(kept);
}

void DepthCells::cut_cell(const Polygon& polygon, const PlacedPiece& piece, std::uint32_t k, Level& room) {
    Polygon& cell = room.cell;
    cell = polygon;
    const Affine own = depth_below(piece.nearest_plane(k));
    const auto cut_by = [&](std::uint32_t other) {
        if (other != k && !cell.empty()) cutter_.clip(difference(depth_below(piece.nearest_plane(other)), own), other > k, cell);
    };
    if (room.candidates.size() <= kFewPlanes) {
        for (const std::uint32_t other : room.candidates) cut_by(other);
        return;
    }
    // the first leaves little, far above which most others are
    cut_by(room.candidates.front());
    if (cell.empty()) return;
    const Sphere sphere(cell);
    const double reach = own(sphere.middle) + 2.0 * sphere.radius;
    for (const std::uint32_t other : room.candidates) {
        if (other != room.candidates.front() && piece.nearest_plane(other).depth(sphere.middle) <= reach) cut_by(other);
    }
}

}  // namespace musim::lsdem::detail
