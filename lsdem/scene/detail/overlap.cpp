#include "lsdem/scene/detail/overlap.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>

#include "lsdem/solid/outline.hpp"
#include "lsdem/solid/solid_gap.hpp"

namespace musim::lsdem::detail {

namespace {

/// A body is large when its bounding box is this many times wider than the average; affects speed only.
constexpr double kLargeBody = 8.0;

/// Half extents of a body's bounding box in the world frame [m].
Vector3 bounding_half(const Body& body) { return body.round ? body.half : Vector3(body.axes.cwiseAbs() * body.half); }

Placing placing_of(const Body& body) { return {body.axes, body.center}; }

Outline outline_of(const Body& body) { return {body.half, body.solid}; }

/// Two spheres, or a sphere and a solid.
double round_overlap(const Body& a, const Body& b) {
    if (a.round && b.round) return a.half.x() + b.half.x() - (b.center - a.center).norm();
    const Body& ball = a.round ? a : b;
    const Body& other = a.round ? b : a;
    return ball.half.x() - find_gap(outline_of(other), placing_of(other).inverse() * ball.center);
}

bool bounds_meet(const Body& a, const Body& b, double tolerance) {
    const Vector3 room = bounding_half(a) + bounding_half(b) - (b.center - a.center).cwiseAbs();
    return room.minCoeff() > tolerance;
}

double touching_depth(const Body& a, const Body& b) { return kTouchingTolerance * 2.0 * std::min(a.half.minCoeff(), b.half.minCoeff()); }

/// The deepest overlap met so far.
class Deepest {
  public:
    explicit Deepest(const std::vector<Body>& bodies) : bodies_(bodies) {}

    void see(std::size_t i, std::size_t j) {
        const auto [first, second] = std::minmax(i, j);
        const Body& a = bodies_[first];
        const Body& b = bodies_[second];
        const double tolerance = touching_depth(a, b);
        if ((a.fixed && b.fixed) || !bounds_meet(a, b, tolerance)) return;
        const double depth = compute_overlap(a, b);
        if (depth <= tolerance) return;
        const Overlap overlap{first, second, depth};
        const auto earlier = [](const Overlap& l, const Overlap& r) { return std::pair(l.first, l.second) < std::pair(r.first, r.second); };
        if (!deepest_ || depth > deepest_->depth || (depth == deepest_->depth && earlier(overlap, *deepest_))) deepest_ = overlap;
    }

    std::optional<Overlap> result() const { return deepest_; }

  private:
    const std::vector<Body>& bodies_;
    std::optional<Overlap> deepest_;
};

/// Grid cell and index of a body; ordered by z, y, x, so that neighbors along x are neighbors in the sorted list.
using Cell = std::pair<std::array<std::int64_t, 3>, std::size_t>;

/// Cells further out than this share the last one: whole numbers up to here are exact in doubles and far from overflow.
constexpr double kLastCell = 1e15;

/// Compares every pair of bodies whose cells touch.
void see_neighbors(const std::vector<Body>& bodies, const std::vector<std::size_t>& members, double cell_size, Deepest& deepest) {
    Vector3 low = Vector3::Constant(std::numeric_limits<double>::infinity());
    for (const std::size_t k : members) low = low.cwiseMin(bodies[k].center);
    std::vector<Cell> cells;
    cells.reserve(members.size());
    for (const std::size_t k : members) {
        const Vector3 index = ((bodies[k].center - low) / cell_size).array().floor().min(kLastCell);
        cells.push_back(
            {{static_cast<std::int64_t>(index.z()), static_cast<std::int64_t>(index.y()), static_cast<std::int64_t>(index.x())}, k});
    }
    std::sort(cells.begin(), cells.end());
    for (auto cell = cells.begin(); cell != cells.end(); ++cell) {
        // each pair once: from the earlier cell in the list to the later one
        for (const auto& [dz, dy] : {std::pair{0, 0}, {0, 1}, {1, -1}, {1, 0}, {1, 1}}) {
            const auto [z, y, x] = cell->first;
            const bool own_row = dz == 0 && dy == 0;
            auto other = own_row ? cell + 1 : std::lower_bound(cell, cells.end(), Cell{{z + dz, y + dy, x - 1}, 0});
            const Cell end{{z + dz, y + dy, x + 2}, 0};
            for (; other != cells.end() && *other < end; ++other) deepest.see(cell->second, other->second);
        }
    }
}

}  // namespace

double compute_overlap(const Body& a, const Body& b) {
    if (a.round || b.round) return round_overlap(a, b);
    return -find_gap(outline_of(a), outline_of(b), placing_of(a).inverse() * placing_of(b));
}

double compute_depth_in_ground(const Body& body) {
    const double reach = body.round ? body.half.x() : find_reach(outline_of(body), -body.axes.row(2).transpose());
    return reach - body.center.z();
}

std::optional<Overlap> find_deepest_overlap(const std::vector<Body>& bodies) {
    Deepest deepest(bodies);
    if (bodies.empty()) return std::nullopt;
    double mean_width = 0.0;
    for (const Body& body : bodies) mean_width += 2.0 * bounding_half(body).maxCoeff() / static_cast<double>(bodies.size());

    std::vector<std::size_t> small, large;
    double cell_size = 0.0;
    for (std::size_t k = 0; k < bodies.size(); ++k) {
        const double width = 2.0 * bounding_half(bodies[k]).maxCoeff();
        const bool is_large = width > kLargeBody * mean_width;
        (is_large ? large : small).push_back(k);
        if (!is_large) cell_size = std::max(cell_size, width);
    }
    see_neighbors(bodies, small, cell_size, deepest);
    for (std::size_t k = 0; k < large.size(); ++k) {
        for (const std::size_t other : small) deepest.see(large[k], other);
        for (std::size_t m = k + 1; m < large.size(); ++m) deepest.see(large[k], large[m]);
    }
    return deepest.result();
}

}  // namespace musim::lsdem::detail
