#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "tests/stability/scenes.hpp"
#include "tests/stability/table.hpp"
#include "tests/support/relative.hpp"

using namespace musim::lsdem;
using namespace musim::lsdem::tests;

TEST_SUITE("stability") {
    // [CundallStrack79]: a spring-slider driven between ±u0 dissipates 4 μN (u0 − μN/k_s) a cycle. The block is so heavy, in gravity so
    // weak, that it stands still while the base moves.
    TEST_CASE("cyclic shear dissipates the same loop a hundred times and does not ratchet") {
        constexpr double kHeavier = 1e9;
        constexpr int kCycles = 100;
        const Stone stone = reference_wood();
        Model model = make_model(stone);
        model.gravity.z() = -kGravity / kHeavier;
        model.blocks.push_back(make_block(stone, {0.0, 0.0, 0.5 * stone.size.z() - stone.weight() / stone.normal_stiffness}));
        model.blocks[0].mass *= kHeavier;
        model.blocks[0].rotation_locked = true;
        const double u0 = 1e-6, period = 4e-3, omega = 2.0 * kPi / period;
        model.ground.motion.shift[0] =
            sample_velocity(kCycles * period, 2000UL * kCycles, [=](double t) { return u0 * omega * std::cos(omega * t); });

        std::vector<double> loss;
        const Observation seen = observe(model, period / 4000.0, kCycles * period, kCycles,
                                         [&](const Simulation& now) { loss.push_back(now.energy().friction_loss); });
        // Closure and gain: discretization only. Drift: the first quarter of a cycle is not answered by another and leaves the block with a
        // momentum of μN/ω; μN/(ω M) times the 0.1 s that drift is measured over is 2e-10 of its edge
        check_sound("100 cycles of stick and slip", seen, {.closure = 1e-6, .gain = 1e-6, .drift = 1e-9, .overlap = 1e-3});

        const double limit = stone.friction * stone.weight(), loop = 4.0 * limit * (u0 - limit / stone.shear_stiffness);
        REQUIRE(loss.size() == kCycles + 1);
        // the first cycle starts from the middle; turning points fall within a step, (ω dt)²/8 = 3e-7, and within a chord of the
        // base, 1.2e-6
        for (std::size_t cycle = 2; cycle <= kCycles; ++cycle) CHECK(loss[cycle] - loss[cycle - 1] == relative(loop, 5e-6));
    }

    // [DenHartog31]: harmonic base motion beyond friction settles to a symmetric slip that comes back to its place every cycle.
    TEST_CASE("a block that slips to and fro on a shaken base comes back to its place every cycle") {
        constexpr int kCycles = 16, kTransient = 6;
        const Stone stone = reference_wood();
        Model model = make_lying_block(stone);
        const double period = 0.2, omega = 2.0 * kPi / period, amplitude = kGravity / omega;
        model.ground.motion.shift[0] =
            sample_velocity(kCycles * period, 400UL * kCycles, [=](double t) { return amplitude * std::cos(omega * t); });
        model.blocks[0].velocity.x() = amplitude;

        std::vector<double> place;
        const double step = period / std::ceil(period / default_time_step(model));
        const Observation seen = observe(model, step, kCycles * period, kCycles, [&](const Simulation& now) {
            place.push_back(now.position(0).x() - now.base().displacement.x());
        });
        check_sound("16 cycles of slip under 1 g at 5 Hz", seen, {.closure = 1e-6, .gain = 1e-9, .drift = 1e-6, .overlap = 1e-3});
        const auto [least, most] = std::minmax_element(place.begin() + kTransient, place.end());
        // the slip is 6.65 mm from end to end; what is left of the transient falls by half and more a cycle
        CHECK(*most - *least < 1e-6 * stone.size.x());
    }
}
