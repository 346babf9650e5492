#include "lsdem/solid/solid_gap.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <vector>

#include "lsdem/solid/basic_solids.hpp"
#include "lsdem/solid/box_gap.hpp"
#include "lsdem/solid/convex_hull.hpp"
#include "lsdem/solid/outline.hpp"
#include "tests/support/relative.hpp"
#include "tests/support/solids.hpp"

namespace musim::lsdem {
namespace {

using tests::draw_rotation;
using tests::relative;

Vector3 draw_vector(std::mt19937_64& random) {
    std::uniform_real_distribution<double> number(-1.0, 1.0);
    return {number(random), number(random), number(random)};
}

Polyhedron draw_hull(std::mt19937_64& random, std::size_t points) {
    std::vector<Vector3> cloud(points);
    for (Vector3& point : cloud) point = draw_vector(random);
    return make_convex_hull(cloud);
}

/// The same from the convex hull of all differences of corners: the widest gap from the origin to a plane of a face.
double find_gap_by_differences(const Polyhedron& a, const Polyhedron& b, const Placing& place) {
    std::vector<Vector3> differences;
    for (const Vector3& of_a : a.corners) {
        for (const Vector3& of_b : b.corners) differences.push_back(place * of_b - of_a);
    }
    double widest = -std::numeric_limits<double>::infinity();
    for (const Polyhedron::Face& face : make_convex_hull(differences).faces) widest = std::max(widest, -face.plane.offset);
    return widest;
}

/// Depth over the 15 axes of two boxes [Gottschalk96].
double find_box_depth(const Vector3& half_a, const Vector3& half_b, const Placing& place) {
    std::vector<Vector3> axes;
    for (Eigen::Index i = 0; i < 3; ++i) {
        axes.push_back(Vector3::Unit(i));
        axes.push_back(place.rotation.col(i));
        for (Eigen::Index j = 0; j < 3; ++j) axes.push_back(Vector3::Unit(i).cross(place.rotation.col(j)).normalized());
    }
    double depth = std::numeric_limits<double>::infinity();
    for (const Vector3& axis : axes) {
        const double reach = axis.cwiseAbs().dot(half_a) + (place.rotation.transpose() * axis).cwiseAbs().dot(half_b);
        depth = std::min(depth, reach - std::abs(axis.dot(place.position)));
    }
    return depth;
}

}  // namespace

TEST_CASE("the gap between two polyhedra is that of the faces of their difference") {
    std::mt19937_64 random(1);
    for (int i = 0; i < 300; ++i) {
        const Polyhedron a = draw_hull(random, 4 + static_cast<std::size_t>(i % 9)),
                         b = draw_hull(random, 4 + static_cast<std::size_t>(i % 7));
        const Placing place{draw_rotation(random), 1.5 * draw_vector(random)};
        // flat tetrahedra magnify the rounding of their corners
        CHECK(find_gap(a, b, place) == doctest::Approx(find_gap_by_differences(a, b, place)).epsilon(1e-11).scale(1.0));
    }
}

TEST_CASE("boxes overlap by the least depth over their fifteen axes, or are apart as the boxes' own rule finds") {
    std::mt19937_64 random(2);
    int overlapping = 0, apart = 0;
    for (int i = 0; i < 1000; ++i) {
        const Vector3 half_a = draw_vector(random).cwiseAbs() + Vector3::Constant(0.1),
                      half_b = draw_vector(random).cwiseAbs() + Vector3::Constant(0.1);
        const Placing place{draw_rotation(random), 2.0 * draw_vector(random)};
        const double gap = find_gap(make_box_solid(2.0 * half_a), make_box_solid(2.0 * half_b), place);
        const double depth = find_box_depth(half_a, half_b, place);
        CHECK(find_gap(half_a, half_b, place) == relative(-depth, 1e-13 / std::abs(depth)));
        // that of either kind where one bounds it, and fast
        CHECK((find_clearance({half_a}, {half_b}, place, 0.0) > 0.0) == (depth < 0.0));
        const Solid solid_a = make_box_solid(2.0 * half_a);
        CHECK((find_clearance({half_a, &solid_a}, {half_b}, place, 0.0) > 0.0) == (depth < 0.0));
        CHECK(find_clearance({half_a, &solid_a}, {half_b}, place, 0.0) <= std::max(gap, 0.0) + 1e-14);
        if (depth > 0.0) {
            CHECK(gap == relative(-depth, 1e-13 / depth));
            ++overlapping;
        } else {
            CHECK(gap >= find_gap_of_faces(half_a, half_b, place) - 1e-14);
            CHECK(gap > 0.0);
            ++apart;
        }
    }
    CHECK(overlapping > 200);
    CHECK(apart > 200);
}

TEST_CASE("stacked, crossed and tilted bodies are as far apart as drawn") {
    const Solid box = make_box_solid({1.0, 0.5, 0.25});
    for (const double gap : {-1e-3, -1e-9, 0.0, 1e-9, 1e-3}) {
        CAPTURE(gap);
        CHECK(find_gap(box, box, {Matrix3::Identity(), {0.0, 0.0, 0.25 + gap}}) == doctest::Approx(gap).epsilon(1e-15).scale(1.0));
        // two ridges that cross at right angles: cubes turned by 45° about x and about y
        const Solid cube = make_box_solid({1.0, 1.0, 1.0});
        const Matrix3 about_x = Eigen::AngleAxisd(std::numbers::pi / 4.0, Vector3::UnitX()).toRotationMatrix();
        const Matrix3 about_y = Eigen::AngleAxisd(std::numbers::pi / 4.0, Vector3::UnitY()).toRotationMatrix();
        const Placing below{about_x, Vector3::Zero()}, above{about_y, {0.1, -0.2, std::sqrt(2.0) + gap}};
        CHECK(find_gap(cube, cube, below.inverse() * above) == doctest::Approx(gap).epsilon(1e-15).scale(1.0));
    }
}

TEST_CASE("the gap changes no faster than a body moves, over edges that become parallel and faces that become flush") {
    const Solid box = make_box_solid({1.0, 0.6, 0.8}), drum = make_drum(0.5, 0.7, 24, 0.5);
    const auto at = [](double t) {
        return Placing{(Eigen::AngleAxisd(t, Vector3::UnitZ()) * Eigen::AngleAxisd(0.3 * t * t, Vector3::UnitX())).toRotationMatrix(),
                       {0.75 + 0.1 * t, 0.5 * t, 0.2 * t}};
    };
    constexpr double kStep = 1e-4;
    double before = find_gap(box, drum, at(-0.2)), before_boxes = find_gap(box, box, at(-0.2));
    for (int i = 1; i <= 4000; ++i) {
        const double t = -0.2 + kStep * i;
        // translation 0.55, rotation 1.1 times a reach of 0.71
        const double gap = find_gap(box, drum, at(t)), of_boxes = find_gap(box, box, at(t));
        CHECK(std::abs(gap - before) < 1.4 * kStep);
        CHECK(std::abs(of_boxes - before_boxes) < 1.4 * kStep);
        before = gap, before_boxes = of_boxes;
    }
}

TEST_CASE("the gap is the same seen from either body, and at powers of four in length to the last bit") {
    std::mt19937_64 random(3);
    for (int i = 0; i < 100; ++i) {
        const Solid a{{draw_hull(random, 12)}}, b{{draw_hull(random, 9)}};
        const Placing place{draw_rotation(random), 1.3 * draw_vector(random)};
        const double gap = find_gap(a, b, place);
        CHECK(find_gap(b, a, place.inverse()) == doctest::Approx(gap).epsilon(1e-13).scale(1.0));
        const auto scaled = [](const Solid& solid) { return stretched(solid, Vector3::Constant(0x1p-6)); };
        CHECK(find_gap(scaled(a), scaled(b), {place.rotation, 0x1p-6 * place.position}) == 0x1p-6 * gap);
    }
}

TEST_CASE("a point is as far from a solid as the nearest face, edge or corner, or as deep as below the nearest face") {
    const Solid box = make_box_solid({2.0, 4.0, 6.0});
    CHECK(find_gap(box, Vector3(0.5, 1.0, 5.0)) == relative(2.0, 1e-15));
    CHECK(find_gap(box, Vector3(4.0, 6.0, 1.0)) == relative(5.0, 1e-15));
    CHECK(find_gap(box, Vector3(2.0, 4.0, -5.0)) == relative(3.0, 1e-15));
    CHECK(find_gap(box, Vector3(0.5, 1.9, 2.0)) == relative(-0.1, 1e-14));
    CHECK(find_gap(box, Vector3(1.0, 1.0, 1.0)) == 0.0);
    // no less than to a small box about the point, along planes; and no steeper than distance
    std::mt19937_64 random(4);
    for (int i = 0; i < 100; ++i) {
        const Solid hull{{draw_hull(random, 20)}};
        const Vector3 x = 1.5 * draw_vector(random);
        const double gap = find_gap(hull, x);
        const Vector3 nearer = x + 1e-6 * draw_vector(random).normalized();
        CHECK(std::abs(find_gap(hull, nearer) - gap) <= 1e-6 * (1.0 + 1e-9));
        CHECK(gap >= find_gap(hull, make_box_solid(Vector3::Constant(1e-9)), {Matrix3::Identity(), x}) - 1e-8);
        CHECK((gap <= 0.0) == contains(hull, x));
    }
}

TEST_CASE("the gap of solids of several pieces is that of the nearest pieces") {
    // a U about a block: 0.1 to the left arm, 0.3 to the right arm, 0.2 to the floor
    const Solid u{{tests::make_box_piece({-1.0, 0.0, 0.0}, {1.0, 1.0, 0.5}), tests::make_box_piece({-1.0, 0.0, 0.5}, {-0.6, 1.0, 2.0}),
                   tests::make_box_piece({0.8, 0.0, 0.5}, {1.0, 1.0, 2.0})}};
    const Solid block = make_box_solid({1.0, 1.0, 1.0});
    CHECK(find_gap(u, block, {Matrix3::Identity(), {0.0, 0.5, 1.2}}) == relative(0.1, 1e-14));
    CHECK(find_gap(block, u, {Matrix3::Identity(), {0.0, -0.5, -1.2}}) == relative(0.1, 1e-14));
    CHECK(find_gap(u, block, {Matrix3::Identity(), {-0.15, 0.5, 1.2}}) == relative(-0.05, 1e-13));
}

}  // namespace musim::lsdem
