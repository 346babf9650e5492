#include "lsdem/solid/detail/hull_triangles.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>

#include "lsdem/solid/detail/exact_sum.hpp"

namespace musim::lsdem::detail {
namespace {

/// A triangle of the hull so far, and the points that see it and are no corners yet.
struct Facet {
    HullTriangle triangle;
    Vector3 first, second;     ///< edges from the first corner
    Vector3 normal;            ///< twice the area, with rounding
    Vector3 normal_magnitude;  ///< of the products that it is the difference of
    std::vector<std::uint32_t> outside;
    bool removed = false;
    std::uint32_t visit = 0;  ///< the last corner that saw it
};

/// An edge between what a new corner sees and what it does not see.
struct HorizonEdge {
    std::uint32_t from = 0, to = 0;
    std::uint32_t beyond = 0;  ///< the facet that stays
};

/// Quickhull [Barber96] with exact signs: a point in the plane of a facet does not see it, so no facet degenerates and nothing is merged.
class HullBuilder {
  public:
    explicit HullBuilder(std::span<const Vector3> points) : points_(points) {}

    std::vector<HullTriangle> build(const std::array<std::uint32_t, 4>& first) {
        begin(first);
        // facets take their points when they are made, so that each is met once
        for (std::uint32_t f = 0; f < facets_.size(); ++f) {
            if (!facets_[f].removed && !facets_[f].outside.empty()) add_corner(f);
        }
        return collect();
    }

  private:
    void begin(const std::array<std::uint32_t, 4>& c) {
        facets_.push_back(make_facet({{c[0], c[2], c[1]}, {3, 2, 1}}));
        facets_.push_back(make_facet({{c[0], c[1], c[3]}, {0, 2, 3}}));
        facets_.push_back(make_facet({{c[1], c[2], c[3]}, {0, 3, 1}}));
        facets_.push_back(make_facet({{c[2], c[0], c[3]}, {0, 1, 2}}));
        for (std::uint32_t p = 0; p < points_.size(); ++p) give_to_facet(p, 0);
    }

    Facet make_facet(const HullTriangle& triangle) const {
        const Vector3& origin = points_[triangle.corners[0]];
        const Vector3 u = points_[triangle.corners[1]] - origin, v = points_[triangle.corners[2]] - origin;
        const Vector3 a = u.cwiseAbs(), b = v.cwiseAbs();
        return {.triangle = triangle,
                .first = u,
                .second = v,
                .normal = u.cross(v),
                .normal_magnitude = {a.y() * b.z() + a.z() * b.y(), a.z() * b.x() + a.x() * b.z(), a.x() * b.y() + a.y() * b.x()},
                .outside = {},
                .removed = false,
                .visit = 0};
    }

    /// Distance of a point over a facet times twice its area, with rounding.
    double height(const Facet& facet, std::uint32_t p) const { return facet.normal.dot(points_[p] - points_[facet.triangle.corners[0]]); }

    bool sees(std::uint32_t p, const Facet& facet) const {
        const Vector3 d = points_[p] - points_[facet.triangle.corners[0]];
        const double value = facet.normal.dot(d);
        // rounding: twice in the normal, three times in the product with d, each half a unit in the last place
        constexpr double kRounding = 4.0 * std::numeric_limits<double>::epsilon();
        const double bound = kRounding * facet.normal_magnitude.dot(d.cwiseAbs());
        if (std::abs(value) > bound) return value > 0.0;
        return find_exact_sign(facet.first, facet.second, d) > 0;
    }

    /// Gives a point to the first facet that it sees, from facet `begin` on.
    void give_to_facet(std::uint32_t p, std::size_t begin) {
        for (std::size_t f = begin; f < facets_.size(); ++f) {
            if (!sees(p, facets_[f])) continue;
            facets_[f].outside.push_back(p);
            return;
        }
    }

    void add_corner(std::uint32_t facet) {
        const std::vector<std::uint32_t>& outside = facets_[facet].outside;
        std::uint32_t corner = outside.front();
        for (const std::uint32_t p : outside) {
            if (height(facets_[facet], p) > height(facets_[facet], corner)) corner = p;
        }
        ++visits_;
        find_horizon(facet, corner);
        const std::size_t begin = facets_.size();
        add_cone(corner);
        for (const std::uint32_t f : seen_) {
            for (const std::uint32_t p : std::exchange(facets_[f].outside, {})) {
                if (p != corner) give_to_facet(p, begin);
            }
        }
    }

    /// Removes the facets that a corner sees, from one that it sees; the edges around them stay in `horizon_`.
    void find_horizon(std::uint32_t start, std::uint32_t corner) {
        seen_.assign(1, start);
        horizon_.clear();
        facets_[start].removed = true;
        facets_[start].visit = visits_;
        for (std::size_t k = 0; k < seen_.size(); ++k) {
            const HullTriangle triangle = facets_[seen_[k]].triangle;
            for (std::size_t i = 0; i < 3; ++i) {
                const std::uint32_t other = triangle.neighbours[i];
                Facet& beyond = facets_[other];
                if (!beyond.removed && beyond.visit != visits_) {
                    beyond.visit = visits_;
                    if (sees(corner, beyond)) {
                        beyond.removed = true;
                        seen_.push_back(other);
                    }
                }
                if (!beyond.removed) horizon_.push_back({triangle.corners[i], triangle.corners[(i + 1) % 3], other});
            }
        }
    }

    /// Adds a facet from each edge of the horizon to the corner.
    void add_cone(std::uint32_t corner) {
        // each corner of the horizon begins one edge: put them one behind the other
        const auto by_start = [](const HorizonEdge& a, const HorizonEdge& b) { return a.from < b.from; };
        std::sort(horizon_.begin(), horizon_.end(), by_start);
        const auto first = static_cast<std::uint32_t>(facets_.size()), count = static_cast<std::uint32_t>(horizon_.size());
        const auto index_of = [&](std::uint32_t from) {
            const auto edge = std::lower_bound(horizon_.begin(), horizon_.end(), HorizonEdge{from, 0, 0}, by_start);
            return static_cast<std::uint32_t>(edge - horizon_.begin());
        };
        for (std::uint32_t k = 0; k < count; ++k) {
            const HorizonEdge& edge = horizon_[k];
            facets_.push_back(make_facet({{edge.from, edge.to, corner}, {edge.beyond, first + index_of(edge.to), 0}}));
            HullTriangle& beyond = facets_[edge.beyond].triangle;
            beyond.neighbours[find_edge(beyond, edge.to)] = first + k;
        }
        for (std::uint32_t k = 0; k < count; ++k) {
            const std::uint32_t next = facets_[first + k].triangle.neighbours[1];
            facets_[next].triangle.neighbours[2] = first + k;
        }
    }

    std::vector<HullTriangle> collect() const {
        std::vector<std::uint32_t> number(facets_.size(), 0);
        std::vector<HullTriangle> triangles;
        for (std::size_t f = 0; f < facets_.size(); ++f) {
            if (facets_[f].removed) continue;
            number[f] = static_cast<std::uint32_t>(triangles.size());
            triangles.push_back(facets_[f].triangle);
        }
        for (HullTriangle& triangle : triangles) {
            for (std::uint32_t& other : triangle.neighbours) other = number[other];
        }
        return triangles;
    }

    std::span<const Vector3> points_;
    std::vector<Facet> facets_;
    std::vector<std::uint32_t> seen_;
    std::vector<HorizonEdge> horizon_;
    std::uint32_t visits_ = 0;
};

/// The point for which a function is largest; of equal ones the first.
template <class Function>
std::uint32_t find_farthest(std::span<const Vector3> points, const Function& measure) {
    std::uint32_t best = 0;
    double largest = -std::numeric_limits<double>::infinity();
    for (std::uint32_t p = 0; p < points.size(); ++p) {
        const double value = measure(points[p]);
        if (value > largest) largest = value, best = p;
    }
    return best;
}

}  // namespace

std::optional<std::array<std::uint32_t, 4>> find_first_corners(std::span<const Vector3> points, double tolerance) {
    const std::uint32_t a = find_farthest(points, [](const Vector3& x) { return -x.x(); });
    const Vector3& origin = points[a];
    const std::uint32_t b = find_farthest(points, [&](const Vector3& x) { return (x - origin).squaredNorm(); });
    const Vector3 line = points[b] - origin;
    const std::uint32_t c = find_farthest(points, [&](const Vector3& x) { return line.cross(x - origin).squaredNorm(); });
    const Vector3 normal = line.cross(points[c] - origin);
    if (!(normal.norm() > tolerance * line.norm())) return std::nullopt;
    const std::uint32_t d = find_farthest(points, [&](const Vector3& x) { return std::abs(normal.dot(x - origin)); });
    const double height = normal.dot(points[d] - origin);
    if (!(std::abs(height) > tolerance * normal.norm())) return std::nullopt;
    if (height > 0.0) return std::array{a, b, c, d};
    return std::array{a, c, b, d};
}

std::vector<HullTriangle> find_hull_triangles(std::span<const Vector3> points, const std::array<std::uint32_t, 4>& first) {
    return HullBuilder(points).build(first);
}

}  // namespace musim::lsdem::detail
