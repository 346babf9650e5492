#include "lsdem/contact/stiffness_watch.hpp"

#include <doctest/doctest.h>

#include "lsdem/motion/simulation.hpp"
#include "lsdem/time_step.hpp"
#include "tests/support/models.hpp"
#include "tests/support/relative.hpp"

using namespace musim::lsdem;
using namespace musim::lsdem::tests;

TEST_CASE("a chain and a standing column use of the limit what their time step says") {
    for (const bool locked : {true, false}) {
        Stone stone = wood();
        stone.restitution = 1.0;
        const Model model = make_resting_column(stone, 5, locked);
        for (const double safety : {0.8, 1.02}) {
            Simulation simulation(model, safety * compute_critical_time_step(model));
            simulation.advance(64);
            const std::optional<Overstiff> worst = simulation.statistics().overstiff;
            REQUIRE(worst.has_value() == (safety > 1.0));
            // strips along the edges of a face, of the depth's width, bear less
            if (worst) CHECK(worst->used == relative(safety * safety, 1e-4));
        }
    }
}

TEST_CASE("a block that comes to lie on its largest face uses more of the limit than it did upright, and is named with the time") {
    Stone stone = wood();
    Model model = make_resting_column(stone, 2);
    // the upper block topples and comes to lie on the ground beside the lower one, whose large face it never leaves
    model.blocks[1].position += Vector3(2.0 * stone.size.norm(), 0.0, 0.0);
    model.blocks[1].position.z() = 0.5 * stone.size.x() + 1e-3 * stone.size.z();
    model.blocks[1].orientation = lying();
    Model upright = model;
    upright.blocks.pop_back();
    // the step is that of the block as built, which lies already in this model
    const double step = 0.99 * compute_critical_time_step(upright);
    REQUIRE(step > compute_critical_time_step(model));
    Simulation simulation(model, step);
    CHECK_FALSE(simulation.statistics().overstiff);
    simulation.advance(static_cast<std::uint64_t>(0.1 / step) + 64);
    const std::optional<Overstiff> worst = simulation.statistics().overstiff;
    REQUIRE(worst);
    CHECK(worst->block == 1);
    CHECK(worst->time > 0.0);
    CHECK(worst->used > 1.0);
}
