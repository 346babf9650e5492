#include "lsdem/shape.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <variant>

#include "tests/support/models.hpp"
#include "tests/support/relative.hpp"

using namespace musim::lsdem;
using namespace musim::lsdem::tests;

// [Harmon23]: 44 points on the top face, edges and corners included, about 440 in all.
TEST_CASE("the papers' block has four by eleven nodes on its face") {
    const NodeLattice lattice = make_node_lattice(wood().size, 44);
    CHECK(lattice.nx == 4);
    CHECK(lattice.ny == 11);
    const Shape shape = make_box_shape(wood().size, lattice);
    const auto on_top = std::count_if(shape.nodes.z.begin(), shape.nodes.z.end(), [&](double z) { return z == shape.half_extents.z(); });
    CHECK(on_top == 44);
    CHECK(shape.nodes.size() > 350);
    CHECK(shape.nodes.size() < 500);
}

TEST_CASE("the node areas of every face sum to the face") {
    for (const NodeLattice& lattice : {NodeLattice{4, 11, 14}, NodeLattice{2, 2, 2}, NodeLattice{3, 2, 5}}) {
        const Shape shape = make_box_shape(wood().size, lattice);
        for (int axis = 0; axis < 3; ++axis) {
            double positive = 0.0, negative = 0.0;
            for (std::size_t i = 0; i < shape.nodes.size(); ++i) {
                const double area = shape.nodes.area(i)[axis];
                (area > 0.0 ? positive : negative) += area;
                // a share belongs to a node that lies on that face
                if (area != 0.0) CHECK(shape.nodes.position(i)[axis] == std::copysign(shape.half_extents[axis], area));
            }
            const double face = shape.volume / wood().size[axis];
            // rounding of some 200 terms
            CHECK(positive == relative(face, 1e-13));
            CHECK(negative == relative(-face, 1e-13));
        }
    }
}

TEST_CASE("nodes cover the surface without a double") {
    const Shape shape = make_box_shape(wood().size, {4, 11, 14});
    CHECK(shape.nodes.size() == 4 * 11 * 14 - 2 * 9 * 12);
    for (std::size_t i = 0; i < shape.nodes.size(); ++i) {
        const Vector3 beyond = shape.nodes.position(i).cwiseAbs() - shape.half_extents;
        CHECK(beyond.maxCoeff() == 0.0);
        for (std::size_t j = 0; j < i; ++j) REQUIRE((shape.nodes.position(i) - shape.nodes.position(j)).norm() > 0.0);
    }
}

// Landau and Lifshitz, Mechanics, § 32: the homogeneous block 1.36 x 2.82 x 4.25 m.
TEST_CASE("mass properties are those of the homogeneous solid") {
    const Shape box = make_box_shape({1.36, 2.82, 4.25}, {4, 11, 14});
    CHECK(box.volume == relative(16.2996, 1e-12));
    CHECK((box.inertia_over_mass - Vector3(2.1679083, 1.6593417, 0.8168333)).norm() < 1e-7);
    CHECK(box.face_area == relative(1.36 * 2.82, 1e-15));

    const Shape sphere = make_sphere_shape(2.0, 400, 0.25);
    CHECK(sphere.volume == relative(32.0 / 3.0 * kPi, 1e-15));
    CHECK(sphere.inertia_over_mass == Vector3::Constant(1.6));
    Vector3 sum = Vector3::Zero();
    double area = 0.0;
    for (std::size_t i = 0; i < sphere.nodes.size(); ++i) {
        sum += sphere.nodes.area(i);
        area += sphere.nodes.area(i).norm();
        CHECK(sphere.nodes.position(i).norm() == relative(2.0, 1e-14));
    }
    CHECK(area == relative(16.0 * kPi, 1e-12));
    // the Fibonacci lattice closes to about 1/n
    CHECK(sum.norm() < area / 400.0);
}

TEST_CASE("a number of nodes that makes no even lattice is refused with the nearest that does") {
    try {
        (void)make_node_lattice(wood().size, 43);
        FAIL("43 is prime");
    } catch (const std::invalid_argument& error) {
        CHECK(std::string(error.what()).find("43") != std::string::npos);
        CHECK((std::string(error.what()).find("use 42") != std::string::npos ||
               std::string(error.what()).find("use 44") != std::string::npos));
    }
    CHECK_THROWS_AS(make_node_lattice(wood().size, 3), std::invalid_argument);
    CHECK_THROWS_AS(make_box_shape(wood().size, {1, 4, 4}), std::invalid_argument);
    CHECK_THROWS_AS(make_box_shape({0.0, 1.0, 1.0}, {2, 2, 2}), std::invalid_argument);
    CHECK_THROWS_AS(make_grid_box_shape(wood().size, {2, 2, 2}, 0.0), std::invalid_argument);
    CHECK_THROWS_AS(make_sphere_shape(0.0, 10, 0.1), std::invalid_argument);
    CHECK_THROWS_AS(make_sphere_shape(1.0, 0, 0.1), std::invalid_argument);
}

// Integrals over the solid cylinder; the shares of the nodes are those of the faces they stand for.
TEST_CASE("the nodes of a drum carry its ends and its side, rims included") {
    const double radius = 2.0, height = 3.0;
    const Shape drum = make_cylinder_shape(radius, height, {24, 4, 5}, 0.25);
    const double end = kPi * radius * radius, side = 2.0 * kPi * radius * height;
    double top = 0.0, bottom = 0.0, around = 0.0, inertia = 0.0;
    Vector3 sum = Vector3::Zero();
    for (std::size_t i = 0; i < drum.nodes.size(); ++i) {
        const Vector3 p = drum.nodes.position(i), area = drum.nodes.area(i);
        const double from_axis = std::hypot(p.x(), p.y()), outward = std::hypot(area.x(), area.y());
        (area.z() > 0.0 ? top : bottom) += area.z();
        around += outward;
        sum += area;
        if (area.z() > 0.0) inertia += area.z() * p.x() * p.x();
        // a share belongs to a node on that face, and looks out of it
        if (area.z() != 0.0) CHECK(p.z() == std::copysign(0.5 * height, area.z()));
        if (outward > 0.0) {
            CHECK(from_axis == relative(radius, 1e-15));
            CHECK(p.x() * area.x() + p.y() * area.y() == relative(radius * outward, 1e-14));
        }
        for (std::size_t j = 0; j < i; ++j) REQUIRE((p - drum.nodes.position(j)).norm() > 1e-3 * radius);
    }
    // rounding of some 200 terms
    CHECK(top == relative(end, 1e-13));
    CHECK(bottom == relative(-end, 1e-13));
    CHECK(around == relative(side, 1e-13));
    CHECK(sum.norm() < 1e-13 * side);
    // rocking stiffness of an end, ∫x² dA = πR⁴/4: of n rings at their own radius, 1 + 1/(2n²), the trapezoidal rule of the disc
    CHECK(inertia == relative(end * radius * radius / 4.0 * (1.0 + 1.0 / (2.0 * 4.0 * 4.0)), 1e-12));

    CHECK(drum.face_area == relative(end, 1e-15));
    CHECK(drum.volume == relative(end * height, 1e-15));
    CHECK((drum.inertia_over_mass - Vector3(1.75, 1.75, 2.0)).norm() < 1e-15);
    CHECK(drum.half_extents == Vector3(2.0, 2.0, 1.5));
    CHECK_FALSE(drum.faceted);
}

// Exact where the distance is linear; where it is curved, a trilinear interpolant is off by at most h²/8 times the curvatures 1/(R − h).
TEST_CASE("the grid of a drum is its signed distance") {
    const double radius = 2.0, height = 3.0, voxel = 0.25;
    const Shape drum = make_cylinder_shape(radius, height, {24, 4, 5}, voxel);
    const auto& grid = std::get<GridLevelSet>(drum.level_set);
    CHECK(grid.value({0.4, -0.3, 1.4}) == relative(-0.1, 1e-13));
    CHECK(grid.value({0.4, -0.3, -1.6}) == relative(0.1, 1e-13));
    CHECK((grid.gradient({0.4, -0.3, 1.4}) - Vector3::UnitZ()).norm() < 1e-13);
    for (int i = 0; i < 40; ++i) {
        const double angle = 0.1 + 0.155 * i;
        const double off = grid.value({radius * std::cos(angle), radius * std::sin(angle), 0.3});
        CHECK(off >= -1e-15);
        CHECK(off < voxel * voxel / 8.0 / (radius - voxel));
    }
}

TEST_CASE("a drum that has no size or too few nodes is refused") {
    CHECK_THROWS_AS(make_cylinder_shape(0.0, 1.0, {24, 4, 5}, 0.1), std::invalid_argument);
    CHECK_THROWS_AS(make_cylinder_shape(1.0, -1.0, {24, 4, 5}, 0.1), std::invalid_argument);
    CHECK_THROWS_AS(make_cylinder_shape(1.0, 1.0, {2, 4, 5}, 0.1), std::invalid_argument);
    CHECK_THROWS_AS(make_cylinder_shape(1.0, 1.0, {24, 0, 5}, 0.1), std::invalid_argument);
    CHECK_THROWS_AS(make_cylinder_shape(1.0, 1.0, {24, 4, 1}, 0.1), std::invalid_argument);
    CHECK_THROWS_AS(make_cylinder_shape(1.0, 1.0, {24, 4, 5}, 0.0), std::invalid_argument);
}
