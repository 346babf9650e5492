#include <doctest/doctest.h>

#include <cmath>

#include "tests/stability/scenes.hpp"
#include "tests/stability/table.hpp"

using namespace musim::lsdem;
using namespace musim::lsdem::tests;

TEST_SUITE("stability") {
    TEST_CASE("a step in the velocity of the base moves a wall without energy from nowhere") {
        Model wall = make_wall(coarse_wood());
        wall.ground.motion[0] = velocity_step(0.3);
        wall.ground.motion[2] = velocity_step(0.05);
        check_sound("base velocity step", observe(wall, default_time_step(wall), 0.2, 100),
                    {.closure = 0.02, .gain = 1e-3, .overlap = 0.02});
    }

    TEST_CASE("ten g at the base throw a wall down and the ledger still closes") {
        Model wall = make_wall(coarse_wood());
        shake(wall, 10.0 * kGravity, 20.0, 0.15);
        wall.ground.motion[2] = sample_velocity(0.15, 600, [](double t) { return 10.0 * kGravity / 300.0 * std::sin(300.0 * t); });
        check_sound("base at 10 g", observe(wall, default_time_step(wall), 0.4, 200), {.closure = 0.02, .gain = 0.01, .overlap = 0.3});
    }

    // 0.1 g at 0.01 Hz carries the base over hundreds of meters; a column must come along as if it stood still. At the size of the
    // prototype, where a step is 80 µs. Rounding of a displacement of 500 m moves a joint by 1e-13 m of its overlap of 1e-7 m.
    TEST_CASE("a column follows a base that moves very slowly and very far without creeping") {
        Stone stone = at_length(coarse_wood(), 107.0);
        stone.nodes_per_face = 8;
        Model column = make_resting_column(stone, 3);
        const double period = 100.0, omega = 2.0 * kPi / period;
        column.ground.motion[0] = sample_velocity(period, 20000, [=](double t) { return 0.1 * kGravity / omega * std::sin(omega * t); });
        const double step = default_time_step(column);
        // the lean of a stack of 3 under 0.1 g comes and goes with the acceleration
        check_sound("base at 0.01 Hz, 0.1 g", observe(column, step, period, 400),
                    {.closure = 1e-3, .gain = 1e-6, .drift = 1e-4, .overlap = 1e-3});
    }
}
