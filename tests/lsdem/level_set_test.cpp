#include "lsdem/level_set.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <stdexcept>
#include <variant>

#include "lsdem/shape.hpp"
#include "tests/support/models.hpp"
#include "tests/support/relative.hpp"

using namespace musim::lsdem;
using namespace musim::lsdem::tests;

TEST_CASE("the box level set is the distance to the box") {
    const BoxLevelSet box{{1.0, 2.0, 3.0}};
    CHECK(box.value({0.0, 0.0, 0.0}) == -1.0);    // the nearest face is half the thin side away
    CHECK(box.value({0.0, 1.75, 0.0}) == -0.25);  // inside, near the face across y
    CHECK(box.value({1.0, 0.0, 0.0}) == 0.0);
    CHECK(box.value({0.0, 0.0, 5.0}) == 2.0);
    CHECK(box.value({4.0, 6.0, 0.0}) == 5.0);  // edge: 3-4-5
    CHECK(box.value({2.0, 4.0, 5.0}) == 3.0);  // corner: 1-2-2-3
    CHECK(box.gradient({0.0, -1.75, 0.0}) == Vector3(0.0, -1.0, 0.0));
    CHECK((box.gradient({4.0, 6.0, 0.0}) - Vector3(0.6, 0.8, 0.0)).norm() < 1e-15);
    CHECK((box.gradient({-2.0, 4.0, -5.0}) - Vector3(-1.0, 2.0, -2.0) / 3.0).norm() < 1e-15);
}

TEST_CASE("the gradient of the box level set is the slope of its value") {
    const BoxLevelSet box{{1.0, 2.0, 3.0}};
    std::mt19937 random(3);
    std::uniform_real_distribution<double> even(-4.0, 4.0);
    int checked = 0;
    for (int i = 0; i < 1000; ++i) {
        const Vector3 x(even(random), even(random), even(random));
        constexpr double h = 1e-5;
        Vector3 slope;
        for (int a = 0; a < 3; ++a) slope[a] = (box.value(x + h * Vector3::Unit(a)) - box.value(x - h * Vector3::Unit(a))) / (2.0 * h);
        // across the medial planes the slope jumps: leave out points within h of them, where differences see both sides
        if (std::abs(slope.norm() - 1.0) > 1e-3) continue;
        ++checked;
        // central differences: h²·curvature², and 1e-16/h of rounding
        CHECK((slope - box.gradient(x)).norm() < 1e-8);
    }
    CHECK(checked > 980);
}

namespace {

/// Largest difference of value, and of the unit gradient, between grid and closed form, near the middle of the faces.
double compare_grid(double voxel) {
    const Stone stone = wood();
    const Shape shape = make_grid_box_shape(stone.size, {4, 11, 11}, voxel);
    const auto& grid = std::get<GridLevelSet>(shape.level_set);
    const BoxLevelSet box{shape.half_extents};
    double worst = 0.0;
    std::mt19937 random(5);
    std::uniform_real_distribution<double> even(-0.5, 0.5);
    for (int i = 0; i < 500; ++i) {
        const Vector3 x(shape.half_extents.x() * (i % 2 == 0 ? 0.999 : -0.999), even(random) * shape.half_extents.y(),
                        even(random) * shape.half_extents.z());
        worst = std::max(worst, std::abs(grid.value(x) - box.value(x)));
        CHECK(grid.gradient(x).normalized().dot(box.gradient(x)) > 1.0 - 1e-12);
    }
    return worst;
}

/// Largest error of a sampled sphere of unit radius near its surface.
double sphere_error(double voxel) {
    const Shape sphere = make_sphere_shape(1.0, 10, voxel);
    const auto& grid = std::get<GridLevelSet>(sphere.level_set);
    std::mt19937 random(9);
    std::normal_distribution<double> normal;
    double worst = 0.0;
    for (int i = 0; i < 2000; ++i) {
        const Vector3 x = Vector3(normal(random), normal(random), normal(random)).normalized();
        worst = std::max(worst, std::abs(grid.value(x)));
    }
    return worst;
}

}  // namespace

TEST_CASE("a sampled box is exact off its edges since trilinear interpolation reproduces planes") {
    // 0.65 mm is the papers' voxel; rounding of coordinates of 2e-2 m
    CHECK(compare_grid(0.65e-3) < 1e-16);
}

TEST_CASE("a sampled sphere converges with the square of the voxel") {
    // trilinear interpolation of curvature 1/R: 2·h²/8 along each of two principal directions at most
    CHECK(sphere_error(0.1) < 0.25 * 0.1 * 0.1);
    CHECK(sphere_error(0.1) / sphere_error(0.05) == relative(4.0, 0.15));
}

TEST_CASE("inside its grid a level set is the trilinear function of its nodes, and its gradient that function's") {
    const auto value = [](const Vector3& x) {
        return 1.0 + 2.0 * x.x() - 3.0 * x.y() + 5.0 * x.z() + 7.0 * x.x() * x.y() - 11.0 * x.y() * x.z() + 13.0 * x.z() * x.x() +
               17.0 * x.x() * x.y() * x.z();
    };
    const auto slope = [](const Vector3& x) {
        return Vector3(2.0 + 7.0 * x.y() + 13.0 * x.z() + 17.0 * x.y() * x.z(), -3.0 + 7.0 * x.x() - 11.0 * x.z() + 17.0 * x.z() * x.x(),
                       5.0 - 11.0 * x.y() + 13.0 * x.x() + 17.0 * x.x() * x.y());
    };
    // other numbers of nodes along each axis, an origin that is none
    const Vector3 origin(-0.5, 0.25, 1.0), extent = 0.5 * Vector3(1.0, 2.0, 4.0);
    const GridLevelSet grid(origin, 0.5, {2, 3, 5}, value);
    std::mt19937 random(11);
    std::uniform_real_distribution<double> even(0.0, 1.0);
    for (int i = 0; i < 200; ++i) {
        const Vector3 x = origin + extent.cwiseProduct(Vector3(even(random), even(random), even(random)));
        // rounding of terms of up to 100
        CHECK(std::abs(grid.value(x) - value(x)) < 1e-13);
        CHECK((grid.gradient(x) - slope(x)).norm() < 1e-12);
    }
}

TEST_CASE("outside its grid a level set goes on as the distance to the grid") {
    // of a plane that leans, beyond a face, an edge and a corner: the value at the nearest place of the grid, and how far that is
    const auto plane = [](const Vector3& x) { return x.x() - 2.0 * x.y() + 3.0 * x.z(); };
    const GridLevelSet grid({0.0, 0.0, 0.0}, 0.5, {3, 3, 3}, plane);
    CHECK(grid.value({4.0, 0.5, 0.5}) == relative(plane({1.0, 0.5, 0.5}) + 3.0, 1e-15));
    CHECK(grid.value({4.0, 0.25, 5.0}) == relative(plane({1.0, 0.25, 1.0}) + 5.0, 1e-15));
    CHECK(grid.value({-3.0, 0.25, -4.0}) == relative(plane({0.0, 0.25, 0.0}) + 5.0, 1e-15));
    CHECK(grid.value({2.0, -2.0, 3.0}) == relative(plane({1.0, 0.0, 1.0}) + 3.0, 1e-15));  // 1-2-2-3
    CHECK_THROWS_AS(GridLevelSet({0.0, 0.0, 0.0}, 0.0, {3, 3, 3}, [](const Vector3&) { return 0.0; }), std::invalid_argument);
    CHECK_THROWS_AS(GridLevelSet({0.0, 0.0, 0.0}, 1.0, {1, 3, 3}, [](const Vector3&) { return 0.0; }), std::invalid_argument);
}
