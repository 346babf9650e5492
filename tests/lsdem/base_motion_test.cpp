#include "lsdem/base_motion.hpp"

#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>

using namespace musim::lsdem;

// Velocity 0, 2, 1 m/s at 1.0, 1.5, 2.0 s: areas of triangles and trapezia.
TEST_CASE("displacement is the exact integral of the piecewise linear velocity") {
    BaseComponents components;
    components.shift[1] = {1.0, 0.5, {0.0, 2.0, 1.0}};
    const BaseMotion motion(components);
    CHECK(motion.displacement(0.5) == Vector3::Zero());
    CHECK(motion.displacement(1.5).y() == 0.5);
    CHECK(motion.displacement(1.25).y() == 0.125);
    CHECK(motion.displacement(2.0).y() == 1.25);
    CHECK(motion.displacement(1.75).y() == 0.5 + 0.4375);
    CHECK(motion.displacement(3.0).y() == 2.25);  // the last sample holds
    CHECK(motion.velocity(1.25).y() == 1.0);
    CHECK(motion.velocity(1.75).y() == 1.5);
    CHECK(motion.velocity(9.0).y() == 1.0);
    CHECK(motion.acceleration(1.25).y() == 4.0);
    CHECK(motion.acceleration(1.5).y() == -2.0);  // from the right
    CHECK(motion.acceleration(2.5).y() == 0.0);
    CHECK(motion.acceleration(0.5).y() == 0.0);
    CHECK(motion.displacement(2.0).x() == 0.0);
}

TEST_CASE("a single sample is a step of the velocity") {
    BaseComponents components;
    components.shift[0] = {0.25, 0.0, {3.0}};
    const BaseMotion motion(components);
    CHECK(motion.velocity(0.2).x() == 0.0);
    CHECK(motion.velocity(0.25).x() == 3.0);
    CHECK(motion.displacement(1.25).x() == 3.0);
}

TEST_CASE("the peak acceleration is that of the steepest line between samples up to a time, without sign") {
    BaseComponents components;
    components.shift[0] = {0.0, 0.5, {0.0, 1.0, -1.0, 0.0}};   // 2, -4, 2
    components.shift[2] = {-1.0, 0.5, {0.0, 9.0, 9.0, 10.0}};  // 18 before t = 0, 0, 2
    const BaseMotion motion(components);
    CHECK(motion.peak_acceleration(10.0) == Vector3(4.0, 0.0, 2.0));
    CHECK(motion.peak_acceleration(0.25) == Vector3(2.0, 0.0, 2.0));
}

TEST_CASE("base motion refuses samples that make no sense") {
    BaseComponents components;
    components.shift[0] = {0.0, 0.0, {0.0, 1.0}};
    CHECK_THROWS_AS(BaseMotion{components}, std::invalid_argument);
    components.shift[0] = {0.0, 0.1, {0.0, std::numeric_limits<double>::quiet_NaN()}};
    CHECK_THROWS_AS(BaseMotion{components}, std::invalid_argument);
    components.shift[0] = {std::numeric_limits<double>::infinity(), 0.1, {0.0, 1.0}};
    CHECK_THROWS_AS(BaseMotion{components}, std::invalid_argument);
}
