#include "lsdem/plot/box_view.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <queue>

namespace musim::lsdem {
namespace {

/// Top, left and right side of a body by its colour; the last are those of marked ones.
struct Shades {
    const char *top, *left, *right;
};
constexpr std::array<Shades, 4> kShades{{{"#f3e3c3", "#d9bd8b", "#b99763"},
                                         {"#e4e7ea", "#b9c0c7", "#8f99a3"},
                                         {"#d7e8d4", "#a5c7a0", "#7aa474"},
                                         {"#e6dcf0", "#bfa9d6", "#9579b4"}}};
constexpr Shades kMarked{"#8fc3ea", "#3f8fca", "#1f6da8"};
constexpr const char* kEdge = R"(stroke="#4a4036" stroke-width="0.5" stroke-linejoin="round")";

/// A face of a body that looks at the eye.
struct Face {
    std::size_t body = 0;
    Vector3 normal = Vector3::Zero();
    std::array<Vector3, 4> corner;
};

/// A point in the picture and its depth toward the eye.
Vector3 project(const Vector3& world, const BoxView& view) {
    return {world.dot(view.right()), world.dot(view.up()), world.dot(view.toward())};
}

std::vector<Face> find_faces(const std::vector<DrawnBody>& bodies, const BoxView& view) {
    std::vector<Face> faces;
    for (std::size_t b = 0; b < bodies.size(); ++b) {
        const DrawnBody& body = bodies[b];
        for (int axis = 0; axis < 3 && !body.is_round; ++axis) {
            const int u = (axis + 1) % 3, v = (axis + 2) % 3;
            const double sign = body.orientation.col(axis).dot(view.toward()) > 0.0 ? 1.0 : -1.0;
            const Vector3 normal = sign * body.orientation.col(axis);
            const Vector3 middle = body.center + body.half[axis] * normal;
            const Vector3 along = body.half[u] * body.orientation.col(u), across = body.half[v] * body.orientation.col(v);
            faces.push_back(
                {b, normal, {middle - along - across, middle + along - across, middle + along + across, middle - along + across}});
        }
    }
    return faces;
}

/// Which faces show in at least one point of a grid: the nearest one of each point does.
std::vector<bool> find_shown(const std::vector<Face>& faces, const ViewBounds& bounds, const BoxView& view, double spacing) {
    const auto columns = static_cast<std::size_t>(bounds.width() / spacing) + 1,
               rows = static_cast<std::size_t>(bounds.height() / spacing) + 1;
    constexpr std::size_t kNone = std::numeric_limits<std::size_t>::max();
    std::vector<double> depth(columns * rows, -std::numeric_limits<double>::infinity());
    std::vector<std::size_t> nearest(columns * rows, kNone);
    for (std::size_t f = 0; f < faces.size(); ++f) {
        const Vector3 origin = project(faces[f].corner[0], view);
        const Vector3 u = project(faces[f].corner[1], view) - origin, v = project(faces[f].corner[3], view) - origin;
        const double area = u.x() * v.y() - u.y() * v.x();
        if (area == 0.0) continue;
        // points of the grid in the rectangle around the face
        const double left = origin.x() + std::min(0.0, u.x()) + std::min(0.0, v.x()), right = left + std::abs(u.x()) + std::abs(v.x());
        const double low = origin.y() + std::min(0.0, u.y()) + std::min(0.0, v.y()), high = low + std::abs(u.y()) + std::abs(v.y());
        const auto first = [&](double from) { return static_cast<std::size_t>(std::max(0.0, std::ceil(from / spacing))); };
        for (std::size_t row = first(low - bounds.bottom); row < rows && bounds.bottom + static_cast<double>(row) * spacing <= high;
             ++row) {
            for (std::size_t k = first(left - bounds.left); k < columns && bounds.left + static_cast<double>(k) * spacing <= right; ++k) {
                const double x = bounds.left + static_cast<double>(k) * spacing - origin.x();
                const double y = bounds.bottom + static_cast<double>(row) * spacing - origin.y();
                const double along = (x * v.y() - y * v.x()) / area, across = (u.x() * y - u.y() * x) / area;
                if (along < 0.0 || along > 1.0 || across < 0.0 || across > 1.0) continue;
                const double z = origin.z() + along * u.z() + across * v.z();
                if (z > depth[row * columns + k]) depth[row * columns + k] = z, nearest[row * columns + k] = f;
            }
        }
    }
    std::vector<bool> shown(faces.size(), false);
    for (const std::size_t f : nearest) {
        if (f != kNone) shown[f] = true;
    }
    return shown;
}

/// A body's outline as a rectangle, and how far it reaches along a direction.
ViewBounds find_bounds_of(const DrawnBody& body, const BoxView& view) {
    const auto reach = [&](const Vector3& direction) {
        return body.is_round ? body.half.x() : (body.orientation.transpose() * direction).cwiseAbs().dot(body.half);
    };
    const double x = body.center.dot(view.right()), y = body.center.dot(view.up());
    return {x - reach(view.right()), x + reach(view.right()), y - reach(view.up()), y + reach(view.up())};
}

/// Does `body` lie beyond the plane of a face of `other` that looks in a direction, to a part of its size?
bool is_beyond(const DrawnBody& body, const DrawnBody& other, const Vector3& direction) {
    constexpr double kTouching = 1e-3;
    for (int axis = 0; axis < 3; ++axis) {
        const double facing = other.orientation.col(axis).dot(direction);
        if (std::abs(facing) < kTouching) continue;
        const Vector3 normal = facing > 0.0 ? Vector3(other.orientation.col(axis)) : Vector3(-other.orientation.col(axis));
        const double reach = body.is_round ? body.half.x() : (body.orientation.transpose() * normal).cwiseAbs().dot(body.half);
        if (normal.dot(body.center - other.center) - reach >= other.half[axis] - kTouching * reach) return true;
    }
    return false;
}

/// Does `front` hide a part of `back`?
bool covers(const DrawnBody& front, const DrawnBody& back, const BoxView& view) {
    return is_beyond(front, back, view.toward()) || is_beyond(back, front, -view.toward());
}

/// The bodies of `some` from the farthest to the nearest.
std::vector<std::size_t> sort_by_depth(const std::vector<DrawnBody>& bodies, std::vector<std::size_t> some, const BoxView& view) {
    const auto depth = [&](std::size_t b) { return bodies[b].center.dot(view.toward()); };
    std::stable_sort(some.begin(), some.end(), [&](std::size_t a, std::size_t b) { return depth(a) < depth(b); });
    std::vector<ViewBounds> bounds;
    bounds.reserve(some.size());
    for (const std::size_t b : some) bounds.push_back(find_bounds_of(bodies[b], view));
    // what each one covers comes before it
    std::vector<std::vector<std::size_t>> after(some.size());
    std::vector<std::size_t> before(some.size(), 0);
    for (std::size_t i = 0; i < some.size(); ++i) {
        for (std::size_t k = i + 1; k < some.size(); ++k) {
            const ViewBounds &a = bounds[i], &b = bounds[k];
            if (a.right <= b.left || b.right <= a.left || a.top <= b.bottom || b.top <= a.bottom) continue;
            const bool k_covers = covers(bodies[some[k]], bodies[some[i]], view), i_covers = covers(bodies[some[i]], bodies[some[k]], view);
            if (k_covers == i_covers) continue;
            const std::size_t back = k_covers ? i : k, front = k_covers ? k : i;
            after[back].push_back(front);
            ++before[front];
        }
    }
    std::priority_queue<std::size_t, std::vector<std::size_t>, std::greater<>> ready;
    for (std::size_t i = 0; i < some.size(); ++i) {
        if (before[i] == 0) ready.push(i);
    }
    std::vector<bool> drawn(some.size(), false);
    std::vector<std::size_t> order;
    while (order.size() < some.size()) {
        // a ring of bodies, each before the next, is broken at the farthest
        if (ready.empty()) ready.push(static_cast<std::size_t>(std::find(drawn.begin(), drawn.end(), false) - drawn.begin()));
        const std::size_t i = ready.top();
        ready.pop();
        if (drawn[i]) continue;
        drawn[i] = true;
        order.push_back(some[i]);
        for (const std::size_t k : after[i]) {
            if (--before[k] == 0) ready.push(k);
        }
    }
    return order;
}

const Shades& shades_of(const DrawnBody& body) {
    return body.is_marked ? kMarked : kShades[static_cast<std::size_t>(body.color) % kShades.size()];
}

const char* find_shade(const Face& face, const DrawnBody& body, const BoxView& view) {
    const Shades& shades = shades_of(body);
    constexpr double kSlope = 0.7;  // of a face that counts as level
    if (face.normal.z() > kSlope) return shades.top;
    return face.normal.dot(view.right()) < 0.0 ? shades.left : shades.right;
}

}  // namespace

Vector3 BoxView::right() const { return {std::cos(turn), std::sin(turn), 0.0}; }
Vector3 BoxView::toward() const { return {std::cos(lift) * std::sin(turn), -std::cos(lift) * std::cos(turn), std::sin(lift)}; }
Vector3 BoxView::up() const { return toward().cross(right()); }

ViewBounds find_bounds(const std::vector<DrawnBody>& bodies, const BoxView& view) {
    constexpr double kFar = std::numeric_limits<double>::infinity();
    ViewBounds all{kFar, -kFar, kFar, -kFar};
    for (const DrawnBody& body : bodies) {
        const ViewBounds own = find_bounds_of(body, view);
        all = {std::min(all.left, own.left), std::max(all.right, own.right), std::min(all.bottom, own.bottom), std::max(all.top, own.top)};
    }
    return all;
}

const char* find_swatch(const DrawnBody& body) { return shades_of(body).left; }

std::string write_point(const Vector3& world, const BoxView& view, const ViewPlace& place) {
    return fmt::format("{:.1f},{:.1f}", place.x + place.scale * world.dot(view.right()), place.y - place.scale * world.dot(view.up()));
}

void draw_bodies(std::string& svg, const std::vector<DrawnBody>& bodies, const BoxView& view, const ViewPlace& place) {
    const std::vector<Face> faces = find_faces(bodies, view);
    const std::vector<bool> shown = find_shown(faces, find_bounds(bodies, view), view, 0.7 / place.scale);
    std::vector<std::vector<std::size_t>> faces_of(bodies.size());
    for (std::size_t f = 0; f < faces.size(); ++f) {
        if (shown[f]) faces_of[faces[f].body].push_back(f);
    }
    std::vector<std::size_t> seen;
    for (std::size_t b = 0; b < bodies.size(); ++b) {
        if (bodies[b].is_round || !faces_of[b].empty()) seen.push_back(b);
    }
    svg += fmt::format("<g {}>\n", kEdge);
    for (const std::size_t b : sort_by_depth(bodies, std::move(seen), view)) {
        if (bodies[b].is_round) {
            const Vector3& c = bodies[b].center;
            svg +=
                fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"{:.1f}\" fill=\"{}\"/>\n", place.x + place.scale * c.dot(view.right()),
                            place.y - place.scale * c.dot(view.up()), place.scale * bodies[b].half.x(), find_swatch(bodies[b]));
        }
        for (const std::size_t f : faces_of[b]) {
            std::string points;
            for (const Vector3& corner : faces[f].corner) points += (points.empty() ? "" : " ") + write_point(corner, view, place);
            svg += fmt::format("<polygon points=\"{}\" fill=\"{}\"/>\n", points, find_shade(faces[f], bodies[b], view));
        }
    }
    svg += "</g>\n";
}

}  // namespace musim::lsdem
