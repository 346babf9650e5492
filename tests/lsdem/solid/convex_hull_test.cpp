#include "lsdem/solid/convex_hull.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <stdexcept>
#include <vector>

#include "lsdem/solid/basic_solids.hpp"
#include "lsdem/solid/mass_properties.hpp"
#include "tests/support/relative.hpp"
#include "tests/support/solids.hpp"

namespace musim::lsdem {
namespace {

using tests::draw_rotation;
using tests::is_convex_polyhedron;
using tests::relative;

using Points = std::vector<Vector3>;

Points turn(const Points& points, const Matrix3& rotation, const Vector3& offset = Vector3::Zero()) {
    Points turned;
    for (const Vector3& point : points) turned.push_back(rotation * point + offset);
    return turned;
}

/// Points spread evenly over the unit sphere.
Points make_sphere_points(std::size_t count) {
    const double golden = std::numbers::pi * (3.0 - std::sqrt(5.0));
    Points points;
    for (std::size_t i = 0; i < count; ++i) {
        const double z = 1.0 - (2.0 * static_cast<double>(i) + 1.0) / static_cast<double>(count), r = std::sqrt(1.0 - z * z);
        points.emplace_back(r * std::cos(golden * static_cast<double>(i)), r * std::sin(golden * static_cast<double>(i)), z);
    }
    return points;
}

/// Edges of a box cut into `parts`: points at corners, in edges, in faces and inside.
Points make_lattice(const Vector3& size, int parts) {
    Points points;
    for (int i = 0; i <= parts; ++i) {
        for (int j = 0; j <= parts; ++j) {
            for (int k = 0; k <= parts; ++k) points.push_back(size.cwiseProduct(Vector3(i, j, k) / static_cast<double>(parts)));
        }
    }
    return points;
}

double volume(const Polyhedron& body) { return compute_mass_properties({{body}}).volume; }

std::vector<std::size_t> count_corners_of_faces(const Polyhedron& body) {
    std::vector<std::size_t> counts;
    for (const Polyhedron::Face& face : body.faces) counts.push_back(face.count);
    std::sort(counts.begin(), counts.end());
    return counts;
}

}  // namespace

TEST_CASE("the hull of a box's corners is the box, with six faces of four corners, however it is turned") {
    std::mt19937_64 random(1);
    const Polyhedron box = make_box_solid({1.0, 0.3, 2.0}).pieces.front();
    CHECK(make_convex_hull(box.corners).corners == box.corners);
    for (int i = 0; i < 200; ++i) {
        const Polyhedron hull = make_convex_hull(turn(box.corners, draw_rotation(random), {0.3, -0.2, 0.1}));
        REQUIRE(count_corners_of_faces(hull) == std::vector<std::size_t>(6, 4));
        REQUIRE(hull.corners.size() == 8);
        REQUIRE(is_convex_polyhedron(hull, 2e-15));
    }
}

TEST_CASE("points in faces, in edges and inside are no corners, however the body is turned") {
    std::mt19937_64 random(2);
    const Points lattice = make_lattice({1.0, 0.7, 1.3}, 6);
    for (int i = 0; i < 50; ++i) {
        Points points = turn(lattice, draw_rotation(random));
        const Polyhedron hull = make_convex_hull(points);
        REQUIRE(hull.corners.size() == 8);
        REQUIRE(count_corners_of_faces(hull) == std::vector<std::size_t>(6, 4));
        REQUIRE(is_convex_polyhedron(hull, 2e-15));
        // corners are those given, to the bit and in their order
        auto at = points.begin();
        for (const Vector3& corner : hull.corners) {
            at = std::find(at, points.end(), corner);
            REQUIRE(at != points.end());
        }
    }
}

TEST_CASE("the hull of a drum has its flats and two ends, however it is turned") {
    std::mt19937_64 random(3);
    for (const int flats : {3, 5, 24, 200}) {
        for (const double top : {1.0, 0.6}) {
            CAPTURE(flats);
            const Solid drum = make_drum(1.0, 0.8, flats, top);
            for (int i = 0; i < 20; ++i) {
                const Polyhedron hull = make_convex_hull(turn(drum.pieces.front().corners, draw_rotation(random), {1.0, 2.0, 3.0}));
                std::vector<std::size_t> expected(static_cast<std::size_t>(flats), 4);
                expected.insert(flats == 3 ? expected.begin() : expected.end(), 2, static_cast<std::size_t>(flats));
                REQUIRE(count_corners_of_faces(hull) == expected);
                REQUIRE(is_convex_polyhedron(hull, 1e-14));
                REQUIRE(volume(hull) == relative(compute_mass_properties(drum).volume, 1e-13));
            }
        }
    }
}

TEST_CASE("a long drum with points along its flats keeps them plane") {
    std::mt19937_64 random(4);
    const Polyhedron drum = make_drum(0.1, 2.0, 200, 0.1).pieces.front();
    Points points;
    for (int k = 0; k <= 10; ++k) {
        for (const Vector3& corner : drum.corners) {
            if (corner.z() < 0.0) points.emplace_back(corner.x(), corner.y(), 0.2 * k);
        }
    }
    for (int i = 0; i < 10; ++i) {
        const Polyhedron hull = make_convex_hull(turn(points, draw_rotation(random)));
        REQUIRE(hull.faces.size() == 202);
        REQUIRE(hull.corners.size() == 400);
        REQUIRE(is_convex_polyhedron(hull, 4e-15));
    }
}

TEST_CASE("the hull of a geodesic sphere has all its points and its triangles") {
    // points of a cube's lattice on the sphere: 6 n² + 2 of them, many symmetric
    Points points;
    for (const Vector3& x : make_lattice({2.0, 2.0, 2.0}, 8)) {
        const Vector3 d = x - Vector3::Ones();
        if (d.cwiseAbs().maxCoeff() > 0.999) points.push_back(d.normalized());
    }
    std::mt19937_64 random(5);
    for (int i = 0; i < 5; ++i) {
        const Polyhedron hull = make_convex_hull(turn(points, i == 0 ? Matrix3::Identity() : draw_rotation(random)));
        REQUIRE(hull.corners.size() == 6 * 64 + 2);
        REQUIRE(is_convex_polyhedron(hull, 2e-15));
    }
}

TEST_CASE("twenty thousand points on a sphere make a hull of all of them, of nearly its volume") {
    const Points points = make_sphere_points(20000);
    const Polyhedron hull = make_convex_hull(points);
    CHECK(hull.corners == points);
    CHECK(hull.faces.size() == 2 * 20000 - 4);
    // 2n triangles of area 2π/n lie below the sphere by a mean of area/(2√3) where they are equilateral: 3π/√3/n of the volume
    CHECK(volume(hull) == relative(4.0 / 3.0 * std::numbers::pi, 1.1 * std::sqrt(3.0) * std::numbers::pi / 20000.0));
}

TEST_CASE("no point of a random cloud lies outside its hull") {
    std::mt19937_64 random(6);
    std::normal_distribution<double> normal;
    for (int i = 0; i < 200; ++i) {
        const Vector3 stretch(1.0, std::pow(10.0, -(i % 4)), std::pow(10.0, -(i % 7)));
        Points points(4 + static_cast<std::size_t>(i));
        for (Vector3& point : points) point = stretch.cwiseProduct(Vector3(normal(random), normal(random), normal(random)));
        const Polyhedron hull = make_convex_hull(turn(points, draw_rotation(random)));
        REQUIRE(is_convex_polyhedron(hull, 2e-11));
        REQUIRE(hull.corners.size() + hull.faces.size() >= 8);
    }
    for (int i = 0; i < 100; ++i) {
        Points points(200);
        for (Vector3& point : points) point = Vector3(normal(random), normal(random), normal(random));
        const Polyhedron hull = make_convex_hull(points);
        REQUIRE(is_convex_polyhedron(hull, 1e-14));
        for (const Vector3& point : points) REQUIRE(contains({{moved({{hull}}, {}).pieces.front()}}, point * (1.0 - 1e-14)));
    }
}

TEST_CASE("hulls of points with rounding of any size are closed and convex to that size") {
    // rounding near the part of the size at which faces are joined is where a careless hull tears
    std::mt19937_64 random(7);
    std::uniform_real_distribution<double> noise(-1.0, 1.0);
    const Points drum = make_drum(0.5, 0.6, 24, 0.5).pieces.front().corners, lattice = make_lattice({1.0, 0.7, 1.3}, 5);
    for (const double size : {1e-16, 1e-14, 1e-13, 3e-13, 1e-12, 2e-12, 5e-12, 1e-11, 1e-9, 1e-6}) {
        CAPTURE(size);
        for (int i = 0; i < 10; ++i) {
            for (const Points* shape : {&drum, &lattice}) {
                Points points = turn(*shape, draw_rotation(random));
                for (Vector3& point : points) point += size * Vector3(noise(random), noise(random), noise(random));
                const Polyhedron hull = make_convex_hull(points);
                // points that were left out, and those that a face was joined over, lie within a few times the tolerance
                REQUIRE(is_convex_polyhedron(hull, 8.0 * kSamePlane));
                REQUIRE(volume(hull) ==
                        relative(shape == &drum ? 12.0 * 0.25 * std::sin(std::numbers::pi / 12.0) * 0.6 : 0.91, 1e-12 + 20.0 * size));
            }
        }
    }
}

TEST_CASE("clusters of points as wide as the tolerance make one corner each, or some, and cost no other") {
    std::mt19937_64 random(11);
    std::uniform_real_distribution<double> number(-1.0, 1.0);
    for (int i = 0; i < 400; ++i) {
        const double width = std::pow(10.0, -16.0 + 8.0 * (i % 40) / 40.0);
        Points points;
        for (int k = 0; k < 12; ++k) {
            const Vector3 middle(number(random), number(random), number(random));
            for (int n = 0; n < 4; ++n) points.push_back(middle + width * Vector3(number(random), number(random), number(random)));
        }
        const Polyhedron hull = make_convex_hull(points);
        CAPTURE(width);
        REQUIRE(is_convex_polyhedron(hull, 16.0 * kSamePlane));
        double beyond = 0.0;
        for (const Polyhedron::Face& face : hull.faces) {
            for (const Vector3& point : points) beyond = std::max(beyond, -face.plane.depth(point));
        }
        REQUIRE(beyond < 16.0 * kSamePlane);
    }
}

TEST_CASE("a far origin tears no hull: planes are known to the rounding of coordinates") {
    std::mt19937_64 random(8);
    for (const double far : {1e3, 1e5, 1e7}) {
        for (int i = 0; i < 20; ++i) {
            const Polyhedron hull =
                make_convex_hull(turn(make_lattice({1.0, 0.7, 1.3}, 4), draw_rotation(random), far * Vector3(0.7, -0.9, 0.4)));
            CAPTURE(far);
            REQUIRE(count_corners_of_faces(hull) == std::vector<std::size_t>(6, 4));
            REQUIRE(is_convex_polyhedron(hull, 8.0 * far * std::numeric_limits<double>::epsilon()));
        }
    }
}

TEST_CASE("points that are nearly one count as one") {
    Points points = make_box_solid({1.0, 1.0, 1.0}).pieces.front().corners;
    for (int i = 0; i < 8; ++i) points.push_back(points[static_cast<std::size_t>(i)] * (1.0 + 1e-14));
    for (int i = 0; i < 8; ++i) points.push_back(points[static_cast<std::size_t>(i)]);
    const Polyhedron hull = make_convex_hull(points);
    CHECK(hull.corners.size() == 8);
    CHECK(count_corners_of_faces(hull) == std::vector<std::size_t>(6, 4));
}

TEST_CASE("hulls at powers of four in length agree to the last bit") {
    std::mt19937_64 random(9);
    const Points points = turn(make_drum(0.7, 0.3, 24, 0.6).pieces.front().corners, draw_rotation(random), {0.1, 0.2, 0.3});
    const Polyhedron hull = make_convex_hull(points);
    for (const double factor : {0x1p-40, 0x1p-6, 0x1p-2, 0x1p8}) {
        Points scaled = points;
        for (Vector3& point : scaled) point *= factor;
        CHECK(make_convex_hull(scaled) == stretched({{hull}}, Vector3::Constant(factor)).pieces.front());
    }
}

TEST_CASE("points that span no volume are refused") {
    const auto refused = [](const Points& points, const char* message) {
        CHECK_THROWS_WITH_AS(make_convex_hull(points), message, std::invalid_argument);
    };
    refused({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, "convex hull: 3 points; four or more are needed");
    refused({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}}, "convex hull: all 4 points lie in one plane");
    refused({{0, 0, 0}, {1, 1, 1}, {2, 2, 2}, {3, 3, 3}}, "convex hull: all 4 points lie in one plane");
    refused({{1, 1, 1}, {1, 1, 1}, {1, 1, 1}, {1, 1, 1}}, "convex hull: all 4 points lie in one plane");
    refused({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, std::nan(""), 1}}, "convex hull: point 3 is not finite");
    std::mt19937_64 random(10);
    Points flat;
    for (int i = 0; i < 50; ++i) flat.emplace_back(0.1 * (i % 7), 0.1 * (i % 11), 0.0);
    for (int i = 0; i < 50; ++i) {
        CHECK_THROWS_AS(make_convex_hull(turn(flat, draw_rotation(random), {0.5, 0.6, 0.7})), std::invalid_argument);
    }
}

}  // namespace musim::lsdem
