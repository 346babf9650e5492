#include "lsdem/study/compare_runs.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <stdexcept>

#include "scaling/laws/law_similitude.hpp"
#include "tests/study/made_run.hpp"

using namespace musim::lsdem;
using musim::scaling::make_similitude;
using musim::scaling::Similitude;

TEST_CASE("a similar run at a power of four scales back to the same bits") {
    const RunResult prototype = make_made_run(200);
    const Similitude sixteenth = make_similitude("exact", {.length = 1.0 / 16.0});
    const RunDifference difference = compare_runs(prototype, scale_run(prototype, sixteenth), sixteenth);
    CHECK(difference.bitwise_identical);
    CHECK(difference.rms_velocity == 0.0);
    CHECK(difference.max_velocity == 0.0);
    CHECK(difference.digits() == 16);
}

TEST_CASE("a similar run at 1:107 differs by rounding only") {
    const RunResult prototype = make_made_run(200);
    const Similitude small = make_similitude("exact", {.length = 1.0 / 107.0});
    const RunDifference difference = compare_runs(prototype, scale_run(prototype, small), small);
    // two roundings per value, each of at most half a unit in the last place
    CHECK(difference.rms_velocity < 2.0 * std::numeric_limits<double>::epsilon());
    CHECK(difference.digits() >= 15);
}

TEST_CASE("one changed bit anywhere breaks bitwise identity") {
    const RunResult prototype = make_made_run(20);
    const Similitude same;
    REQUIRE(compare_runs(prototype, prototype, same).bitwise_identical);
    const auto next = [](double& value) { value = std::nextafter(value, 1e9); };

    SUBCASE("time") {
        RunResult model = prototype;
        next(model.history.time[7]);
        CHECK_FALSE(compare_runs(prototype, model, same).bitwise_identical);
    }
    SUBCASE("spine velocity") {
        RunResult model = prototype;
        next(model.history.spine_velocity[11].y());
        CHECK_FALSE(compare_runs(prototype, model, same).bitwise_identical);
    }
    SUBCASE("spine rotation") {
        RunResult model = prototype;
        next(model.history.spine_rotation[11].z());
        CHECK_FALSE(compare_runs(prototype, model, same).bitwise_identical);
    }
    SUBCASE("energy") {
        RunResult model = prototype;
        next(model.history.energy[3].friction_loss);
        CHECK_FALSE(compare_runs(prototype, model, same).bitwise_identical);
    }
    SUBCASE("loss of one interface") {
        RunResult model = prototype;
        next(model.losses->block[0].damping);
        CHECK_FALSE(compare_runs(prototype, model, same).bitwise_identical);
    }
    SUBCASE("final orientation of a block off the spine") {
        RunResult model = prototype;
        next(model.final.orientation[1].z());
        CHECK_FALSE(compare_runs(prototype, model, same).bitwise_identical);
    }
    SUBCASE("a missing sample") { CHECK_FALSE(compare_runs(make_made_run(21), prototype, same).bitwise_identical); }
}

TEST_CASE("the difference is that of the worst spine block, relative to the same block of the prototype") {
    const RunResult prototype = make_made_run(300);
    RunResult model = prototype;
    for (std::size_t k = 0; k < 300; ++k) model.history.spine_velocity[2 * k + 1] *= 1.009;
    const RunDifference difference = compare_runs(prototype, model, Similitude());
    // every velocity of block 1 is 0.9 % too large, so both measures are 0.9 %, up to rounding of 1.009 v - v
    CHECK(difference.rms_velocity == doctest::Approx(0.009).epsilon(1e-10));
    CHECK(difference.max_velocity == doctest::Approx(0.009).epsilon(1e-10));
    CHECK(difference.digits() == 2);
}

TEST_CASE("losses are compared level by level, as a part of all that the prototype dissipated") {
    // 0.5 J under level 1, nothing under level 2, 0.5 J at the ground
    const RunResult prototype = make_made_run(20);
    const Similitude small = make_similitude("exact", {.length = 1.0 / 16.0});
    RunResult model = scale_run(prototype, small);
    CHECK(compare_runs(prototype, model, small).losses == 0.0);
    model.losses->block[0].friction += 0.02 * small.energy();
    CHECK(compare_runs(prototype, model, small).losses.value() == doctest::Approx(0.02));
    model.losses->block[1].damping += 0.03 * small.energy();
    CHECK(compare_runs(prototype, model, small).losses.value() == doctest::Approx(0.03));
    // what one level gains and another loses does not cancel
    model.losses->ground.friction -= 0.05 * small.energy();
    CHECK(compare_runs(prototype, model, small).losses.value() == doctest::Approx(0.05));

    RunResult still = prototype;
    still.losses = Losses{.block = {{}, {}}, .ground = {}};
    CHECK_FALSE(compare_runs(still, model, small).losses.has_value());
    model.losses->block.pop_back();
    CHECK_THROWS_AS(compare_runs(prototype, model, small), std::invalid_argument);
}

TEST_CASE("a block that rests in the prototype is measured against the liveliest block") {
    RunResult prototype = make_made_run(300);
    for (std::size_t k = 0; k < 300; ++k) prototype.history.spine_velocity[2 * k].setZero();
    RunResult model = prototype;
    for (std::size_t k = 0; k < 300; ++k) model.history.spine_velocity[2 * k] = 0.05 * prototype.history.spine_velocity[2 * k + 1];
    const RunDifference difference = compare_runs(prototype, model, Similitude());
    CHECK(difference.rms_velocity == doctest::Approx(0.05).epsilon(1e-10));
}

TEST_CASE("runs with spines of different length cannot be compared") {
    RunResult model = make_made_run(5);
    model.spine.block.pop_back();
    CHECK_THROWS_AS(compare_runs(make_made_run(5), model, Similitude()), std::invalid_argument);
}

TEST_CASE("the energy closure relates the drift of the balance to the energy in play") {
    // 4 J of base work, of which 3 J move and 1 J rubs; 0.02 J are lost track of
    const std::vector<Energy> history{{.gravitational = 100.0},
                                      {.kinetic = 3.0, .gravitational = 100.0, .friction_loss = 0.98, .base_work = 4.0}};
    CHECK(compute_energy_closure(history) == doctest::Approx(0.02 / (3.0 + 0.98 + 4.0)).epsilon(1e-12));
    CHECK(compute_energy_closure({{.gravitational = 100.0}, {.gravitational = 100.0}}) == 0.0);
}
