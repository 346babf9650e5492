#include <doctest/doctest.h>

#include <cmath>
#include <cstddef>
#include <vector>

#include "tests/stability/scenes.hpp"
#include "tests/stability/table.hpp"

using namespace musim::lsdem;
using namespace musim::lsdem::tests;

namespace {

/// Lean of the uppermost block of a column under A g: joints of n blocks bear N = n m g at e = A n H/2 from the middle, evenly spread
/// within b/6, else as a wedge over 3 (b/2 − e) [m].
double find_lean(const Stone& stone, int count, double acceleration_g) {
    const double b = stone.size.x(), h = stone.size.z(), per_length = stone.normal_stiffness / b;
    double lean = 0.0;
    for (int n = 1; n <= count; ++n) {
        const double load = n * stone.weight(), e = 0.5 * acceleration_g * n * h, wedge = 3.0 * (0.5 * b - e);
        const double turn = e < b / 6.0 ? 12.0 * load * e / (per_length * b * b * b) : 2.0 * load / (per_length * wedge * wedge);
        lean += turn * (n - 0.5) * h + acceleration_g * load / stone.shear_stiffness;
    }
    return lean;
}

}  // namespace

TEST_SUITE("stability") {
    TEST_CASE("a step in the velocity of the base moves a wall without energy from nowhere") {
        Model wall = make_wall(coarse_wood());
        wall.ground.motion.shift[0] = velocity_step(0.3);
        wall.ground.motion.shift[2] = velocity_step(0.05);
        check_sound("base velocity step", observe(wall, default_time_step(wall), 0.2, 100),
                    {.closure = 0.02, .gain = 1e-3, .overlap = 0.02});
    }

    TEST_CASE("ten g at the base throw a wall down and the energy balance still closes") {
        Model wall = make_wall(coarse_wood());
        shake(wall, 10.0 * kGravity, 20.0, 0.15);
        wall.ground.motion.shift[2] = sample_velocity(0.15, 600, [](double t) { return 10.0 * kGravity / 300.0 * std::sin(300.0 * t); });
        check_sound("base at 10 g", observe(wall, default_time_step(wall), 0.4, 200), {.closure = 0.02, .gain = 0.01, .overlap = 0.3});
    }

    // 0.1 g at 0.01 Hz carries the base over hundreds of meters; a column must come along as if it stood still. At the size of the
    // prototype, where a step is 80 µs. Rounding of a displacement of 500 m moves a joint by 1e-13 m of its overlap of 1e-7 m.
    TEST_CASE("a column follows a base that moves very slowly and very far without creeping") {
        const Stone stone = at_length(coarse_wood(), 107.0);
        Model column = make_resting_column(stone, 3);
        const double period = 100.0, omega = 2.0 * kPi / period;
        column.ground.motion.shift[0] =
            sample_velocity(period, 20000, [=](double t) { return 0.1 * kGravity / omega * std::sin(omega * t); });
        const double step = default_time_step(column);
        std::vector<Vector3> place;
        const Observation seen =
            observe(column, step, period, 400, [&](const Simulation& now) { place.push_back(now.position(2) - now.base().displacement); });
        // in the last quarter the acceleration comes up from zero; the lean moves the weights by some percent of what is left to the edge
        check_sound("base at 0.01 Hz, 0.1 g", seen,
                    {.closure = 1e-3, .gain = 1e-6, .drift = 1.1 * find_lean(stone, 3, 0.1) / stone.size.x(), .overlap = 1e-3});
        // where the acceleration passes zero, at a quarter and three quarters of the period, it stands where it stood; samples are off zero
        // by ω dt = 3e-4 of its greatest, 1e-6 of an edge
        CHECK((place.at(300) - place.at(100)).norm() < 1e-5 * stone.size.x());
        MESSAGE("back to " << (place.at(300) - place.at(100)).norm() / stone.size.x() << " of an edge, after a lean of "
                           << find_lean(stone, 3, 0.1) / stone.size.x());
    }
}
