#include <doctest/doctest.h>

#include <cstddef>

#include "lsdem/motion/simulation.hpp"
#include "lsdem/time_step.hpp"
#include "tests/support/heaps.hpp"
#include "tests/support/models.hpp"
#include "tests/support/motion.hpp"
#include "tests/support/relative.hpp"

using namespace musim::lsdem;
using namespace musim::lsdem::tests;

TEST_CASE("slip in one interface is booked under the block that carries it") {
    const Stone stone = reference_wood();
    // the block that is smooth slides on what is below it: interface k is led by block k, interface 0 by the ground
    for (std::size_t smooth = 0; smooth < 3; ++smooth) {
        CAPTURE(smooth);
        Model model = make_resting_column(stone, 3, true);
        Material ice = model.materials.front();
        ice.friction = 0.05;
        model.materials.push_back(ice);
        // of two materials the smaller friction holds: everything above is of ice too, but moves along
        for (std::size_t i = smooth; i < 3; ++i) model.blocks[i].material = 1;
        for (std::size_t i = smooth; i < 3; ++i) model.blocks[i].velocity.x() = 0.05;
        Simulation s(model, 0.5 * compute_critical_time_step(model));
        const double kinetic = 0.5 * static_cast<double>(3 - smooth) * stone.mass() * 0.05 * 0.05;
        advance_to(s, 0.05 / (0.05 * kGravity) * 1.5);
        const Losses losses = s.losses();
        const PairWork& there = smooth == 0 ? losses.ground : losses.block[smooth - 1];
        // what moved has stopped: its kinetic energy went into friction, but for what stays in the springs, μ²(mg)²/2k_s or 1e-6 of it
        CHECK(there.friction == relative(kinetic, 0.01));
        CHECK(losses.total().friction - there.friction < 0.01 * kinetic);
        CHECK(losses.total().friction == relative(s.energy().friction_loss, 1e-12));
    }
}

TEST_CASE("losses sum up to the energy balance's, keep what has left the list and are the same bits for any number of threads") {
    Model model = make_running_bond(wood(), 8, 12, 9);
    model.ground.motion.shift[0] = velocity_step(1.0);
    const double step = 0.8 * compute_critical_time_step(model);
    Losses one;
    for (const int threads : {1, 2}) {
        Simulation s(model, step, threads);
        Losses before = s.losses();
        CHECK(before.total().friction == 0.0);
        for (int look = 0; look < 3; ++look) {
            s.advance(30);
            const Losses now = s.losses();
            // friction dissipates, so no entry falls when the list is made anew, but for what turning in a step is off by
            const double off = 1e-9 * now.total().friction;
            for (std::size_t i = 0; i < now.block.size(); ++i) REQUIRE(now.block[i].friction > before.block[i].friction - off);
            REQUIRE(now.ground.friction > before.ground.friction - off);
            before = now;
        }
        REQUIRE(s.statistics().rebuilds > 1);
        const Energy energy = s.energy();
        // a few thousand terms, each rounded once
        CHECK(before.total().friction == relative(energy.friction_loss, 1e-12));
        CHECK(before.total().damping == relative(energy.damping_loss, 1e-12));
        if (threads == 1) one = before;
        for (std::size_t i = 0; i < one.block.size(); ++i) {
            CHECK(before.block[i].friction == one.block[i].friction);
            CHECK(before.block[i].damping == one.block[i].damping);
        }
        CHECK(before.ground.friction == one.ground.friction);
    }
}
