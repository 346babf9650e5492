#include "lsdem/solid/convex_hull.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numeric>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "lsdem/solid/detail/hull.hpp"
#include "lsdem/solid/detail/hull_faces.hpp"
#include "lsdem/solid/detail/hull_triangles.hpp"

namespace musim::lsdem {
namespace {

/// Points as multiples of 2⁻⁵⁰ of a power of two above their extent, from the first one on; all decisions are made with these.
struct Grid {
    std::vector<Vector3> points;
    double tolerance = 0.0;  ///< of planes and of equal points
};

Grid make_grid(std::span<const Vector3> points, double tolerance) {
    Vector3 low = points.front(), high = low;
    for (const Vector3& point : points) low = low.cwiseMin(point), high = high.cwiseMax(point);
    const double size = (high - low).maxCoeff();
    if (!(size > 0.0)) return {};
    const int exponent = std::ilogb(size) + 1;
    constexpr int kBits = 50;
    Grid grid;
    grid.points.reserve(points.size());
    for (const Vector3& point : points) {
        const Vector3 seen = point - points.front();
        grid.points.push_back(
            seen.unaryExpr([&](double x) { return std::ldexp(std::nearbyint(std::ldexp(x, kBits - exponent)), -kBits); }));
    }
    // coordinates far from the origin are rounded to a part of themselves: a plane is known to some of these
    constexpr double kRounding = 4.0 * std::numeric_limits<double>::epsilon();
    const double farthest = std::max(low.cwiseAbs().maxCoeff(), high.cwiseAbs().maxCoeff());
    grid.tolerance = std::ldexp(std::max({tolerance, kSamePlane * size, kRounding * farthest}), -exponent);
    return grid;
}

/// Points that are no nearer to an earlier one of `chosen` than the tolerance.
std::vector<std::uint32_t> leave_out_doubles(const Grid& grid, std::vector<std::uint32_t> chosen) {
    // sorted along a direction that lies along no side of a body, so that few points are near each other there
    const Vector3 direction = Vector3(0.7548776662466927, 0.5698402909980532, 0.3247179572447460).normalized();
    const auto along = [&](std::uint32_t p) { return direction.dot(grid.points[p]); };
    std::vector<std::uint32_t> order = chosen;
    std::sort(order.begin(), order.end(),
              [&](std::uint32_t a, std::uint32_t b) { return std::pair(along(a), a) < std::pair(along(b), b); });
    std::vector<std::pair<std::uint32_t, std::uint32_t>> doubles;  // the later point first
    for (std::size_t i = 0; i < order.size(); ++i) {
        for (std::size_t j = i + 1; j < order.size() && along(order[j]) - along(order[i]) <= grid.tolerance; ++j) {
            if ((grid.points[order[i]] - grid.points[order[j]]).norm() > grid.tolerance) continue;
            doubles.emplace_back(std::max(order[i], order[j]), std::min(order[i], order[j]));
        }
    }
    std::sort(doubles.begin(), doubles.end());
    std::vector<std::uint32_t> out;
    for (const auto& [later, earlier] : doubles) {
        if (!std::binary_search(out.begin(), out.end(), earlier) && (out.empty() || out.back() != later)) out.push_back(later);
    }
    std::erase_if(chosen, [&](std::uint32_t p) { return std::binary_search(out.begin(), out.end(), p); });
    return chosen;
}

/// Corners of the triangles, in ascending order.
std::vector<std::uint32_t> find_used(std::span<const detail::HullTriangle> triangles) {
    std::vector<std::uint32_t> used;
    for (const detail::HullTriangle& triangle : triangles) used.insert(used.end(), triangle.corners.begin(), triangle.corners.end());
    std::sort(used.begin(), used.end());
    used.erase(std::unique(used.begin(), used.end()), used.end());
    return used;
}

/// Leaves only the members of the given numbers, which ascend.
template <class Member>
void keep(const std::vector<std::uint32_t>& numbers, std::vector<Member>& members) {
    for (std::size_t i = 0; i < numbers.size(); ++i) members[i] = members[numbers[i]];
    members.erase(members.begin() + static_cast<std::ptrdiff_t>(numbers.size()), members.end());
}

/// Loops from the least corner on, in the order of their corners: an order that no rounding changes.
void sort_faces(std::vector<std::vector<std::uint32_t>>& faces) {
    for (std::vector<std::uint32_t>& loop : faces) std::rotate(loop.begin(), std::min_element(loop.begin(), loop.end()), loop.end());
    std::sort(faces.begin(), faces.end());
}

}  // namespace

std::optional<Polyhedron> detail::find_hull(std::span<const Vector3> points, double tolerance) {
    if (points.size() < 4) return std::nullopt;
    Grid grid = make_grid(points, tolerance);
    if (grid.points.empty()) return std::nullopt;
    // numbers of the grid's points among those given
    std::vector<std::uint32_t> given(points.size());
    std::iota(given.begin(), given.end(), 0U);
    std::vector<detail::HullTriangle> triangles;
    while (true) {
        const auto first = detail::find_first_corners(grid.points, grid.tolerance);
        if (!first) return std::nullopt;
        triangles = detail::find_hull_triangles(grid.points, *first);
        const std::vector<std::uint32_t> used = find_used(triangles), kept = leave_out_doubles(grid, used);
        if (kept.size() == used.size()) break;
        // once more, with one of each group of points that count as one
        keep(kept, grid.points);
        keep(kept, given);
    }
    std::vector<std::vector<std::uint32_t>> faces = detail::join_hull_triangles(grid.points, triangles, grid.tolerance);
    if (faces.size() < 4) return std::nullopt;
    std::vector<bool> is_corner(grid.points.size(), false);
    for (const auto& loop : faces) {
        for (const std::uint32_t p : loop) is_corner[p] = true;
    }
    std::vector<std::uint32_t> number(grid.points.size(), 0);
    std::vector<Vector3> corners;
    for (std::size_t p = 0; p < grid.points.size(); ++p) {
        if (!is_corner[p]) continue;
        number[p] = static_cast<std::uint32_t>(corners.size());
        corners.push_back(points[given[p]]);
    }
    for (auto& loop : faces) {
        for (std::uint32_t& p : loop) p = number[p];
    }
    sort_faces(faces);
    return make_polyhedron(std::move(corners), faces);
}

Polyhedron make_convex_hull(std::span<const Vector3> points) {
    if (points.size() < 4) {
        throw std::invalid_argument("convex hull: " + std::to_string(points.size()) + " points; four or more are needed");
    }
    if (points.size() > std::numeric_limits<std::uint32_t>::max() / 8) throw std::invalid_argument("convex hull: more than 5e8 points");
    for (std::size_t p = 0; p < points.size(); ++p) {
        if (!points[p].allFinite()) throw std::invalid_argument("convex hull: point " + std::to_string(p) + " is not finite");
    }
    std::optional<Polyhedron> hull = detail::find_hull(points, 0.0);
    if (!hull) throw std::invalid_argument("convex hull: all " + std::to_string(points.size()) + " points lie in one plane");
    return std::move(*hull);
}

}  // namespace musim::lsdem
