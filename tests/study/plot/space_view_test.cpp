#include "lsdem/plot/space_view.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <set>

#include "lsdem/plot/body_view.hpp"
#include "lsdem/plot/solid_edges.hpp"

using namespace musim::lsdem;

namespace {

Placing place_at(const Vector3& position, double angle = 0.0, const Vector3& axis = Vector3::UnitZ()) {
    return {Eigen::AngleAxisd(angle, axis.normalized()).toRotationMatrix(), position};
}

bool is_inside(const std::vector<Eigen::Vector2d>& polygon, const Eigen::Vector2d& at) {
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const Eigen::Vector2d a = polygon[(i + 1) % polygon.size()] - polygon[i], b = at - polygon[i];
        if (a.x() * b.y() - a.y() * b.x() < 0.0) return false;
    }
    return true;
}

/// Number of the solid that a painter who draws parts one over another leaves at a point; kNoFace: none.
std::size_t find_painted(const std::vector<SeenPiece>& pieces, const std::vector<DrawnPart>& parts, const Eigen::Vector2d& at) {
    std::size_t painted = kNoFace;
    for (const DrawnPart& part : parts) {
        if (!is_inside(pieces[part.piece].outline, at)) continue;
        if (part.within.empty() || is_inside(part.within, at)) painted = pieces[part.piece].body;
    }
    return painted;
}

/// Points of a grid over all solids at which the painter leaves another solid than the nearest one.
std::size_t count_wrong(const std::vector<PlacedSolid>& solids, const SpaceView& view) {
    const std::vector<SeenPiece> pieces = list_pieces(solids, view);
    std::vector<std::size_t> all(pieces.size());
    for (std::size_t i = 0; i < all.size(); ++i) all[i] = i;
    const std::vector<DrawnPart> parts = sort_by_depth(pieces, all);
    ViewBounds bounds = pieces.front().bounds;
    for (const SeenPiece& piece : pieces) bounds = unite(bounds, piece.bounds);
    const double spacing = bounds.width() / 80.37;
    const PointGrid grid{.left = bounds.left,
                         .bottom = bounds.bottom,
                         .spacing = spacing,
                         .columns = 81,
                         .rows = static_cast<std::size_t>(bounds.height() / spacing) + 1};
    const std::vector<SeenFace> faces = list_faces(solids, view);
    const std::vector<std::size_t> nearest = find_nearest_faces(faces, grid);
    std::size_t wrong = 0;
    for (std::size_t row = 0; row < grid.rows; ++row) {
        for (std::size_t k = 0; k < grid.columns; ++k) {
            const Eigen::Vector2d at(grid.left + static_cast<double>(k) * spacing, grid.bottom + static_cast<double>(row) * spacing);
            const std::size_t face = nearest[row * grid.columns + k];
            if (find_painted(pieces, parts, at) != (face == kNoFace ? kNoFace : faces[face].body)) ++wrong;
        }
    }
    return wrong;
}

/// A box as two halves along x that share a face.
Solid make_halved_box(const Vector3& size) {
    Solid solid;
    for (const double sign : {-1.0, 1.0}) {
        const Solid half = moved(make_box_solid({0.5 * size.x(), size.y(), size.z()}), place_at({0.25 * sign * size.x(), 0.0, 0.0}));
        solid.pieces.push_back(half.pieces.front());
        solid.pieces.back().faces[sign < 0.0 ? 1 : 0].outer = false;
    }
    return solid;
}

}  // namespace

TEST_CASE("a view from a corner sees the top and two sides of a box, where they are") {
    const SpaceView view = look_from_corner();
    CHECK(view.right.cross(view.up).isApprox(view.toward, 1e-15));
    const Solid box = make_box_solid({1.0, 2.0, 3.0});
    const std::vector<SeenFace> faces = list_faces({{&box, place_at({5.0, 6.0, 7.0})}}, view);
    REQUIRE(faces.size() == 3);
    CHECK(faces[0].normal == Vector3::UnitX());
    CHECK(faces[1].normal == -Vector3::UnitY());
    CHECK(faces[2].normal == Vector3::UnitZ());
    for (const SeenFace& face : faces) {
        CHECK(face.corners.size() == 4);
        for (const Vector3& corner : face.corners) {
            const Vector3 body = view.right * corner.x() + view.up * corner.y() + view.toward * corner.z() - Vector3(5.0, 6.0, 7.0);
            CHECK(body.cwiseAbs().isApprox(Vector3(0.5, 1.0, 1.5), 1e-14));
        }
    }
    // six corners of a box are on its outline, and its bounds are theirs
    const std::vector<SeenPiece> pieces = list_pieces({{&box, {}}}, view);
    CHECK(pieces.front().outline.size() == 6);
    CHECK(pieces.front().bounds.width() == doctest::Approx(1.0 * std::cos(0.62) + 2.0 * std::sin(0.62)).epsilon(1e-14));
}

TEST_CASE("solids that do not overlap are drawn so that each point shows the nearest one") {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> share(0.0, 1.0);
    for (int trial = 0; trial < 4; ++trial) {
        std::vector<Solid> shapes;
        for (int i = 0; i < 27; ++i) shapes.push_back(make_box_solid({0.2 + 0.7 * share(random), 0.2 + 0.7 * share(random), 0.3}));
        std::vector<PlacedSolid> solids;
        for (int i = 0; i < 27; ++i) {
            // each within a ball of radius 0.66 of its own
            const Vector3 cell(1.34 * (i % 3), 1.34 * (i / 3 % 3), 1.34 * (i / 9));
            const Vector3 axis(share(random), share(random) - 0.5, share(random) - 0.5);
            solids.push_back({&shapes[static_cast<std::size_t>(i)], place_at(cell, 3.0 * share(random), axis)});
        }
        CHECK(count_wrong(solids, look_from_corner()) == 0);
        CHECK(count_wrong(solids, look_from(-1.1, 0.0)) == 0);
    }
}

TEST_CASE("bars that hide each other in a ring are drawn right in every corner") {
    // three bars about the line of sight, each tilted so that its far end lies behind the next one's near end
    const Solid bar = make_box_solid({4.0, 0.5, 0.1});
    const SpaceView from_above{.right = Vector3::UnitX(), .up = Vector3::UnitY(), .toward = Vector3::UnitZ()};
    std::vector<PlacedSolid> solids;
    for (int i = 0; i < 3; ++i) {
        const double around = 2.0 * std::numbers::pi * i / 3.0;
        const Matrix3 turn =
            Eigen::AngleAxisd(around, Vector3::UnitZ()).toRotationMatrix() * Eigen::AngleAxisd(0.3, Vector3::UnitY()).toRotationMatrix();
        solids.push_back({&bar, {turn, Eigen::AngleAxisd(around, Vector3::UnitZ()) * Vector3(0.0, -0.7, 0.0)}});
    }
    const std::vector<SeenPiece> pieces = list_pieces(solids, from_above);
    CHECK(sort_by_depth(pieces, {0, 1, 2}).size() > 3);
    CHECK(count_wrong(solids, from_above) == 0);
}

TEST_CASE("halves of a box show no line where they meet") {
    const Solid halves = make_halved_box({2.0, 1.0, 1.0});
    const SolidEdges edges = find_edges(halves);
    std::size_t lines = 0, none = 0;
    for (std::size_t p = 0; p < 2; ++p) {
        for (std::size_t f = 0; f < 6; ++f) {
            for (const bool line : edges.drawn[p][f]) {
                if (halves.pieces[p].faces[f].outer) ++(line ? lines : none);
            }
        }
    }
    // of each half four sides with an edge on the other half, three others, and an end with four
    CHECK(none == 8);
    CHECK(lines == 2 * (4 * 3 + 4));
    // the outline of both, from the front: two edges along x of each half, and the two ends
    const SpaceView front;
    const std::vector<SeenPiece> pieces = list_pieces({{&halves, {}}}, front);
    CHECK(find_silhouette(pieces[0], edges.drawn[0]).size() == 3);
    CHECK(find_silhouette(pieces[1], edges.drawn[1]).size() == 3);

    // a taller half keeps the line along which it rises above the other
    Solid stepped = halves;
    stepped.pieces[1] = stretched({{stepped.pieces[1]}}, {1.0, 1.0, 2.0}).pieces.front();
    const SolidEdges of_step = find_edges(stepped);
    CHECK(std::all_of(of_step.drawn[0][5].begin(), of_step.drawn[0][5].end(), [](bool line) { return line; }));
}

TEST_CASE("faces are drawn where they show, and not where another body hides them") {
    const auto box = std::make_shared<const Solid>(make_box_solid({1.0, 1.0, 1.0}));
    const auto count = [](const std::string& text, const std::string& part) {
        std::size_t n = 0;
        for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++n;
        return n;
    };
    const auto draw = [](const std::vector<DrawnBody>& bodies) {
        std::string svg;
        draw_bodies(svg, bodies, look_from_corner(), {.x = 100.0, .y = 100.0, .scale = 50.0});
        return svg;
    };
    const DrawnBody lower{.solid = box, .place = place_at({0.0, 0.0, 0.5}), .radius = 0.0, .color = 0, .is_marked = false};
    DrawnBody upper = lower;
    upper.place = place_at({0.0, 0.0, 1.5});
    CHECK(count(draw({lower}), "<polygon") == 3);
    CHECK(count(draw({lower}), "#f3e3c3") == 1);
    // the upper box covers the top of the lower one
    CHECK(count(draw({lower, upper}), "<polygon") == 5);
    // a box of halves is drawn as four faces without a stroke of their own where they join, with the lines beside
    DrawnBody halves = lower;
    halves.solid = std::make_shared<const Solid>(make_halved_box({1.0, 1.0, 1.0}));
    CHECK(count(draw({halves}), "<polygon") == 5);
    CHECK(count(draw({halves}), "<path") == 4);
    // a ball is a circle
    DrawnBody ball = lower;
    ball.radius = 0.5;
    CHECK(count(draw({ball}), "<circle") == 1);
    CHECK(count(draw({ball}), "<polygon") == 0);
}
