#include "lsdem/plot/space_view.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <optional>
#include <queue>
#include <utility>

namespace musim::lsdem {
namespace {

using Outline = std::vector<Eigen::Vector2d>;

double cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b) { return a.x() * b.y() - a.y() * b.x(); }

Plane to_picture(const Plane& body, const Placing& place, const SpaceView& view) {
    const Vector3 normal = place.rotation * body.normal;
    return {view * normal, body.offset + normal.dot(place.position)};
}

ViewBounds find_bounds_of(const Outline& outline) {
    Eigen::Vector2d low = outline.front(), high = low;
    for (const Eigen::Vector2d& corner : outline) low = low.cwiseMin(corner), high = high.cwiseMax(corner);
    return {low.x(), high.x(), low.y(), high.y()};
}

bool are_apart(const ViewBounds& a, const ViewBounds& b) {
    return a.right <= b.left || b.right <= a.left || a.top <= b.bottom || b.top <= a.bottom;
}

/// The part of a convex polygon in another one, edge by edge [Sutherland and Hodgman].
Outline intersect(Outline polygon, const Outline& other) {
    for (std::size_t i = 0; i < other.size() && !polygon.empty(); ++i) {
        const Eigen::Vector2d &from = other[i], along = other[(i + 1) % other.size()] - from;
        Outline inside;
        for (std::size_t k = 0; k < polygon.size(); ++k) {
            const Eigen::Vector2d &here = polygon[k], &next = polygon[(k + 1) % polygon.size()];
            const double a = cross(along, here - from), b = cross(along, next - from);
            if (a >= 0.0) inside.push_back(here);
            if ((a < 0.0) != (b < 0.0)) inside.emplace_back(here + a / (a - b) * (next - here));
        }
        polygon = std::move(inside);
    }
    return polygon;
}

/// Middle of a convex polygon that is wider than a part of what it belongs to; nothing of a narrower one.
std::optional<Eigen::Vector2d> find_middle(const Outline& polygon, double least_width) {
    double twice = 0.0, longest = 0.0;
    Eigen::Vector2d sum = Eigen::Vector2d::Zero();
    for (std::size_t i = 1; i + 1 < polygon.size(); ++i) {
        const Eigen::Vector2d a = polygon[i] - polygon[0], b = polygon[i + 1] - polygon[0];
        twice += cross(a, b);
        sum += cross(a, b) / 3.0 * (a + b);
        longest = std::max({longest, a.norm(), b.norm()});
    }
    if (!(twice > 2.0 * least_width * longest)) return std::nullopt;
    return polygon[0] + sum / twice;
}

/// Middle between the depths at which a line toward the eye enters and leaves a convex piece, twice.
double find_depth(const SeenPiece& piece, const Eigen::Vector2d& at) {
    double enter = -std::numeric_limits<double>::infinity(), leave = -enter;
    for (const Plane& plane : piece.planes) {
        const double toward = plane.normal.z(), room = plane.offset - plane.normal.head<2>().dot(at);
        if (toward > 0.0) leave = std::min(leave, room / toward);
        if (toward < 0.0) enter = std::max(enter, room / toward);
    }
    return enter + leave;
}

/// Does a piece hide a part of another one (1), is it hidden by it (-1), or neither (0)?
int compare_depth(const SeenPiece& a, const SeenPiece& b) {
    // pieces that touch beside each other seem to cross by roundings and by the overlap of their contact
    constexpr double kTouching = 1e-3;
    if (are_apart(a.bounds, b.bounds)) return 0;
    const double size = std::min({a.bounds.width(), a.bounds.height(), b.bounds.width(), b.bounds.height()});
    const std::optional<Eigen::Vector2d> at = find_middle(intersect(a.outline, b.outline), kTouching * size);
    if (!at) return 0;
    const double nearer = find_depth(a, *at) - find_depth(b, *at);
    return nearer > 0.0 ? 1 : nearer < 0.0 ? -1 : 0;
}

/// Pieces in order, the farthest first, each one before those that hide it.
class DepthSort {
  public:
    DepthSort(const std::vector<SeenPiece>& pieces, std::vector<std::size_t> some)
        : pieces_(pieces), some_(std::move(some)), hiding_(some_.size()), waiting_(some_.size(), 0), drawn_(some_.size(), false) {}

    std::vector<DrawnPart> run() {
        sort_by_middles();
        compare_all();
        std::priority_queue<std::size_t, std::vector<std::size_t>, std::greater<>> ready;
        for (std::size_t i = 0; i < some_.size(); ++i) {
            if (waiting_[i] == 0) ready.push(i);
        }
        std::size_t left = some_.size();
        while (left > 0) {
            // a ring of pieces, each before the next, begins at the farthest
            if (ready.empty()) ready.push(static_cast<std::size_t>(std::find(drawn_.begin(), drawn_.end(), false) - drawn_.begin()));
            const std::size_t i = ready.top();
            ready.pop();
            if (drawn_[i]) continue;
            draw(i);
            --left;
            for (const std::size_t k : hiding_[i]) {
                if (--waiting_[k] == 0) ready.push(k);
            }
        }
        return std::move(parts_);
    }

  private:
    void sort_by_middles() {
        const auto depth = [&](std::size_t p) {
            const SeenPiece& piece = pieces_[p];
            return find_depth(piece, {0.5 * (piece.bounds.left + piece.bounds.right), 0.5 * (piece.bounds.bottom + piece.bounds.top)});
        };
        std::vector<std::pair<double, std::size_t>> order;
        order.reserve(some_.size());
        for (const std::size_t p : some_) order.emplace_back(depth(p), p);
        std::stable_sort(order.begin(), order.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
        for (std::size_t i = 0; i < order.size(); ++i) some_[i] = order[i].second;
    }

    void compare_all() {
        for (std::size_t i = 0; i < some_.size(); ++i) {
            for (std::size_t k = i + 1; k < some_.size(); ++k) {
                const int nearer = compare_depth(pieces_[some_[i]], pieces_[some_[k]]);
                if (nearer == 0) continue;
                hiding_[nearer > 0 ? k : i].push_back(nearer > 0 ? i : k);
                ++waiting_[nearer > 0 ? i : k];
            }
        }
    }

    void draw(std::size_t i) {
        parts_.push_back({some_[i]});
        drawn_[i] = true;
        // of a ring: what hides this one and is drawn already, and what hides that in turn
        for (const std::size_t front : hiding_[i]) {
            if (!drawn_[front]) continue;
            const Outline within = intersect(pieces_[some_[front]].outline, pieces_[some_[i]].outline);
            parts_.push_back({some_[front], within});
            for (const std::size_t nearer : hiding_[front]) {
                if (drawn_[nearer]) parts_.push_back({some_[nearer], within});
            }
        }
    }

    const std::vector<SeenPiece>& pieces_;
    std::vector<std::size_t> some_;
    std::vector<std::vector<std::size_t>> hiding_;  ///< those that hide a part of it
    std::vector<std::size_t> waiting_;              ///< number of those that it hides and that are not drawn
    std::vector<bool> drawn_;
    std::vector<DrawnPart> parts_;
};

/// Where the line at a height crosses a polygon, from left to right; empty: nowhere.
std::pair<double, double> find_crossing(const std::vector<Vector3>& corners, double y) {
    double left = std::numeric_limits<double>::infinity(), right = -left;
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const Vector3 &a = corners[i], &b = corners[(i + 1) % corners.size()];
        if ((a.y() < y && b.y() < y) || (a.y() > y && b.y() > y)) continue;
        const double share = a.y() == b.y() ? 0.0 : (y - a.y()) / (b.y() - a.y());
        const double x = a.x() + share * (b.x() - a.x());
        left = std::min({left, x, a.y() == b.y() ? b.x() : x});
        right = std::max({right, x, a.y() == b.y() ? b.x() : x});
    }
    return {left, right};
}

}  // namespace

SpaceView look_from(double turn, double lift) {
    const Vector3 right(std::cos(turn), std::sin(turn), 0.0);
    const Vector3 toward(std::cos(lift) * std::sin(turn), -std::cos(lift) * std::cos(turn), std::sin(lift));
    return {right, toward.cross(right), toward};
}

SpaceView look_from_corner() { return look_from(0.62, 0.36); }

ViewBounds unite(const ViewBounds& a, const ViewBounds& b) {
    return {std::min(a.left, b.left), std::max(a.right, b.right), std::min(a.bottom, b.bottom), std::max(a.top, b.top)};
}

ViewBounds find_bounds(const Solid& solid, const Placing& place, const SpaceView& view) {
    constexpr double kFar = std::numeric_limits<double>::infinity();
    ViewBounds all{kFar, -kFar, kFar, -kFar};
    for (const Polyhedron& piece : solid.pieces) {
        for (const Vector3& corner : piece.corners) {
            const Vector3 seen = view * (place * corner);
            all = {std::min(all.left, seen.x()), std::max(all.right, seen.x()), std::min(all.bottom, seen.y()),
                   std::max(all.top, seen.y())};
        }
    }
    return all;
}

std::string write_point(const Vector3& world, const SpaceView& view, const ViewPlace& place) {
    return fmt::format("{:.1f},{:.1f}", place.x + place.scale * world.dot(view.right), place.y - place.scale * world.dot(view.up));
}

std::vector<SeenPiece> list_pieces(const std::vector<PlacedSolid>& solids, const SpaceView& view) {
    std::vector<SeenPiece> pieces;
    for (std::size_t b = 0; b < solids.size(); ++b) {
        for (const Polyhedron& polyhedron : solids[b].solid->pieces) {
            SeenPiece piece{.body = b, .piece = &polyhedron};
            for (const Polyhedron::Face& face : polyhedron.faces) {
                piece.planes.push_back(to_picture(face.plane, solids[b].place, view));
            }
            Outline points;
            for (const Vector3& corner : polyhedron.corners) {
                piece.corners.emplace_back(view * (solids[b].place * corner));
                points.emplace_back(piece.corners.back().head<2>());
            }
            piece.outline = find_outline(std::move(points));
            piece.bounds = find_bounds_of(piece.outline);
            pieces.push_back(std::move(piece));
        }
    }
    return pieces;
}

std::vector<std::array<Vector3, 2>> find_silhouette(const SeenPiece& piece, const std::vector<std::vector<bool>>& drawn) {
    const Polyhedron& body = *piece.piece;
    const auto is_seen = [&](std::size_t face) { return body.faces[face].outer && piece.planes[face].normal.z() > 0.0; };
    std::vector<std::array<Vector3, 2>> lines;
    for (std::size_t f = 0; f < body.faces.size(); ++f) {
        const auto loop = body.loop(body.faces[f]);
        for (std::size_t i = 0; i < loop.size() && is_seen(f); ++i) {
            if (!drawn[f][i] || is_seen(body.neighbours[body.faces[f].first + i])) continue;
            lines.push_back({piece.corners[loop[i]], piece.corners[loop[(i + 1) % loop.size()]]});
        }
    }
    return lines;
}

std::vector<SeenFace> list_faces(const std::vector<PlacedSolid>& solids, const SpaceView& view) {
    std::vector<SeenFace> faces;
    std::size_t number = 0;
    for (std::size_t b = 0; b < solids.size(); ++b) {
        for (const Polyhedron& piece : solids[b].solid->pieces) {
            for (std::size_t f = 0; f < piece.faces.size(); ++f) {
                const Polyhedron::Face& face = piece.faces[f];
                const Vector3 normal = solids[b].place.rotation * face.plane.normal;
                if (!face.outer || !(normal.dot(view.toward) > 0.0)) continue;
                SeenFace seen{.body = b, .piece = number, .face = f, .normal = normal};
                for (const std::uint32_t c : piece.loop(face)) seen.corners.push_back(view * (solids[b].place * piece.corners[c]));
                faces.push_back(std::move(seen));
            }
            ++number;
        }
    }
    return faces;
}

std::vector<Eigen::Vector2d> find_outline(std::vector<Eigen::Vector2d> points) {
    std::sort(points.begin(), points.end(),
              [](const Eigen::Vector2d& a, const Eigen::Vector2d& b) { return a.x() < b.x() || (a.x() == b.x() && a.y() < b.y()); });
    Outline hull;
    const auto add = [&](const Eigen::Vector2d& next, std::size_t least) {
        while (hull.size() > least && cross(hull.back() - hull[hull.size() - 2], next - hull.back()) <= 0.0) hull.pop_back();
        hull.push_back(next);
    };
    for (const Eigen::Vector2d& point : points) add(point, 1);
    const std::size_t lower = hull.size();
    for (auto point = std::next(points.rbegin()); point != points.rend(); ++point) add(*point, lower);
    hull.pop_back();
    return hull;
}

std::vector<std::size_t> find_nearest_faces(const std::vector<SeenFace>& faces, const PointGrid& grid) {
    std::vector<std::size_t> nearest(grid.columns * grid.rows, kNoFace);
    std::vector<double> depth(nearest.size(), -std::numeric_limits<double>::infinity());
    const auto first = [](double from, double spacing) { return static_cast<std::size_t>(std::max(0.0, std::ceil(from / spacing))); };
    for (std::size_t f = 0; f < faces.size(); ++f) {
        const std::vector<Vector3>& corners = faces[f].corners;
        // the face's plane over the picture: depth = corner's + slope·(distance from it)
        Vector3 normal = Vector3::Zero();
        for (std::size_t i = 1; i + 1 < corners.size(); ++i) normal += (corners[i] - corners[0]).cross(corners[i + 1] - corners[0]);
        if (!(normal.z() > 0.0)) continue;
        const Eigen::Vector2d slope = -normal.head<2>() / normal.z();
        const auto lowest_highest =
            std::minmax_element(corners.begin(), corners.end(), [](const Vector3& a, const Vector3& b) { return a.y() < b.y(); });
        const double high = lowest_highest.second->y();
        for (std::size_t row = first(lowest_highest.first->y() - grid.bottom, grid.spacing); row < grid.rows; ++row) {
            const double y = grid.bottom + static_cast<double>(row) * grid.spacing;
            if (y > high) break;
            const auto [left, right] = find_crossing(corners, y);
            for (std::size_t k = first(left - grid.left, grid.spacing); k < grid.columns; ++k) {
                const double x = grid.left + static_cast<double>(k) * grid.spacing;
                if (x > right) break;
                const double z = corners[0].z() + slope.x() * (x - corners[0].x()) + slope.y() * (y - corners[0].y());
                const std::size_t at = row * grid.columns + k;
                if (z > depth[at]) depth[at] = z, nearest[at] = f;
            }
        }
    }
    return nearest;
}

std::vector<DrawnPart> sort_by_depth(const std::vector<SeenPiece>& pieces, std::vector<std::size_t> some) {
    return DepthSort(pieces, std::move(some)).run();
}

}  // namespace musim::lsdem
