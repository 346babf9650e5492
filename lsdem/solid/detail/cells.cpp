#include "lsdem/solid/detail/cells.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "lsdem/solid/detail/hull.hpp"

namespace musim::lsdem::detail {
namespace {

/// A hull of points within the tolerance of planes has its faces within a few times the tolerance of these planes [-].
constexpr double kSlack = 4.0;

/// The face of a cell that a face of a share of it lies in, or the number of its faces where it lies in none.
std::size_t find_source_face(const Polyhedron& share, const Polyhedron::Face& face, const Polyhedron& body, double tolerance) {
    std::size_t best = body.faces.size();
    double nearest = kSlack * tolerance;
    for (std::size_t f = 0; f < body.faces.size(); ++f) {
        const Plane& plane = body.faces[f].plane;
        if (plane.normal.dot(face.plane.normal) <= 0.0) continue;
        double farthest = 0.0;
        for (const std::uint32_t c : share.loop(face)) farthest = std::max(farthest, std::abs(plane.depth(share.corners[c])));
        if (farthest <= nearest) nearest = farthest, best = f;
    }
    return best;
}

/// The share of a cell that is the hull of points; its faces lie in those of the cell, or else in the plane of the cut.
std::optional<Cell> make_share(const Cell& cell, const std::vector<Vector3>& points, const Plane& cut_plane, double tolerance) {
    std::optional<Polyhedron> hull = find_hull(points, tolerance);
    if (!hull) return std::nullopt;
    Cell share{.body = std::move(*hull), .sources = {}, .part = cell.part};
    for (Polyhedron::Face& face : share.body.faces) {
        const std::size_t source = find_source_face(share.body, face, cell.body, tolerance);
        const bool is_cut = source == cell.body.faces.size();
        face.plane = is_cut ? cut_plane : cell.body.faces[source].plane;
        share.sources.push_back(is_cut ? Cell::kCut : cell.sources[source]);
    }
    return share;
}

}  // namespace

Cell make_cell(const Polyhedron& part, std::size_t number) {
    Cell cell{.body = part, .sources = std::vector<std::uint32_t>(part.faces.size()), .part = number};
    std::iota(cell.sources.begin(), cell.sources.end(), 0U);
    return cell;
}

CutCell cut(const Cell& cell, const Plane& plane, double tolerance) {
    const Polyhedron& body = cell.body;
    std::vector<double> height;
    for (const Vector3& corner : body.corners) height.push_back(-plane.depth(corner));
    const auto [lowest, highest] = std::minmax_element(height.begin(), height.end());
    if (*highest <= tolerance) return {cell, std::nullopt};
    if (*lowest >= -tolerance) return {std::nullopt, cell};
    std::vector<Vector3> below, above;
    for (std::size_t c = 0; c < height.size(); ++c) {
        if (height[c] <= tolerance) below.push_back(body.corners[c]);
        if (height[c] >= -tolerance) above.push_back(body.corners[c]);
    }
    for (std::uint32_t f = 0; f < body.faces.size(); ++f) {
        const auto loop = body.loop(body.faces[f]);
        for (std::uint32_t i = 0; i < loop.size(); ++i) {
            const std::uint32_t from = loop[i], to = loop[(i + 1) % loop.size()];
            const bool crosses = std::min(height[from], height[to]) < -tolerance && std::max(height[from], height[to]) > tolerance;
            if (!crosses || body.neighbours[body.faces[f].first + i] < f) continue;
            const double share = height[from] / (height[from] - height[to]);
            below.push_back(body.corners[from] + share * (body.corners[to] - body.corners[from]));
            above.push_back(below.back());
        }
    }
    CutCell result{make_share(cell, below, plane, tolerance), make_share(cell, above, {-plane.normal, -plane.offset}, tolerance)};
    // a sliver counts as none
    if (!result.above) return {cell, std::nullopt};
    if (!result.below) return {std::nullopt, cell};
    return result;
}

CarvedCell carve(const Cell& cell, std::span<const Plane> planes, double tolerance) {
    CarvedCell result{cell, {}};
    for (const Plane& plane : planes) {
        CutCell sides = cut(*result.inside, plane, tolerance);
        if (!sides.below) return {std::nullopt, {cell}};
        if (sides.above) result.outside.push_back(std::move(*sides.above));
        result.inside = std::move(sides.below);
    }
    return result;
}

std::vector<Plane> collect_planes(const Polyhedron& body) {
    std::vector<Plane> planes;
    planes.reserve(body.faces.size());
    for (const Polyhedron::Face& face : body.faces) planes.push_back(face.plane);
    return planes;
}

Vector3 find_middle(const Polyhedron& body, const Polyhedron::Face& face) {
    Vector3 middle = Vector3::Zero();
    for (const std::uint32_t c : body.loop(face)) middle += body.corners[c] / static_cast<double>(face.count);
    return middle;
}

std::optional<Polyhedron> find_filled_hull(std::span<const Cell* const> cells, double tolerance) {
    std::vector<Vector3> points;
    for (const Cell* cell : cells) points.insert(points.end(), cell->body.corners.begin(), cell->body.corners.end());
    std::optional<Polyhedron> hull = find_hull(points, tolerance);
    if (!hull) return std::nullopt;
    // what is left of the hull without the cells
    std::vector<Cell> rest = {make_cell(*hull, 0)};
    for (const Cell* cell : cells) {
        const std::vector<Plane> planes = collect_planes(cell->body);
        std::vector<Cell> outside;
        for (const Cell& share : rest) {
            std::vector<Cell> shares = carve(share, planes, tolerance).outside;
            outside.insert(outside.end(), std::make_move_iterator(shares.begin()), std::make_move_iterator(shares.end()));
        }
        rest = std::move(outside);
    }
    if (!rest.empty()) return std::nullopt;
    // planes of the cells to the bit, of those in one plane the first's
    for (Polyhedron::Face& face : hull->faces) {
        for (const Cell* cell : cells) {
            const std::size_t source = find_source_face(*hull, face, cell->body, tolerance);
            if (source == cell->body.faces.size()) continue;
            face.plane = cell->body.faces[source].plane;
            break;
        }
    }
    hull->wholes = {collect_planes(*hull)};
    return hull;
}

}  // namespace musim::lsdem::detail
