#include "lsdem/loads.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <sstream>

#include "lsdem/motion/settling_simulation.hpp"
#include "lsdem/time_step.hpp"
#include "tests/support/models.hpp"
#include "tests/support/motion.hpp"
#include "tests/support/relative.hpp"

using namespace musim::lsdem;
using namespace musim::lsdem::tests;

namespace {

/// A column of wood at rest.
Model make_column(std::size_t count) { return make_resting_column(reference_wood(), count); }

/// An actuator that pushes block `block` along x on its left face, at `height` above its bottom, by `way`.
Load make_push(const Stone& stone, std::size_t block, double height, double way, double rise) {
    return {.block = block,
            .point = {-0.5 * stone.size.x(), 0.0, height - 0.5 * stone.size.z()},
            .displacement = way,
            .stiffness = 1e-4 * stone.normal_stiffness,
            .rise = rise};
}

double safe_step(const Model& model) { return 0.5 * compute_critical_time_step(model); }

/// Largest force of the first load until its whole is reached.
double find_largest_force(const Model& model) {
    Simulation s(model, safe_step(model));
    double largest = 0.0;
    while (s.time() < model.loads[0].rise) {
        advance(s, 16);
        largest = std::max(largest, s.loads()[0].force);
    }
    // energies close while it is pushed over or along
    const Energy energy = s.energy();
    CHECK(energy.load_work > 0.0);
    Simulation start(model, s.time_step());
    CHECK(std::abs(energy.balance() - start.energy().balance()) < 2e-3 * energy.load_work);
    return largest;
}

}  // namespace

// Elementary statics: of a block pushed at a height h the friction of its base gives way at μ W, or it turns about its edge at W b/(2 h).
TEST_CASE("a block pushed low slides at its friction, one pushed high tips at W b/(2 h)") {
    const Stone stone = reference_wood();
    Model low = make_column(1), high = make_column(1);
    low.loads = {make_push(stone, 0, 0.1 * stone.size.z(), 0.02 * stone.size.x(), 0.4)};
    // it has to be brought to the speed of the push, by no more than the dashpot has at that speed
    const Load& push = low.loads[0];
    const double slides_at = stone.friction * stone.weight(), drags = find_actuator_damping(low, push) * push.displacement / push.rise;
    const double largest = find_largest_force(low);
    CHECK(drags < 0.12 * slides_at);
    CHECK(largest > 0.995 * slides_at);
    CHECK(largest < slides_at + drags);

    const double height = 0.9 * stone.size.z(), tips_at = stone.weight() * stone.size.x() / (2.0 * height);
    high.loads = {make_push(stone, 0, height, 0.03 * stone.size.x(), 0.5)};
    const double borne = find_largest_force(high);
    // the base bears over a width beside the edge, which takes a third of it off the lever arm; the block has turned a little
    CHECK(borne < tips_at);
    CHECK(borne > 0.96 * tips_at);
}

TEST_SUITE("slow") {
    // Every joint of a column pushed at its top opens at the same force, n w b/(2 n H) of n blocks above it. Joints bear over a width
    // beside their edges, by which the limit is less: by a part that goes as K^(-1/3), see docs/validation/limit_loads.md.
    TEST_CASE("a column of ten pushed at its top bears W b/(2 H), as joints become stiff") {
        const auto find_limit = [](double factor) {
            const Stone stone = stiffened(reference_wood(), factor);
            Model model = make_resting_column(stone, 10);
            model.loads = {make_push(stone, 9, stone.size.z(), 0.08 * stone.size.x(), 0.8)};
            model.loads[0].stiffness /= factor;
            return find_largest_force(model) / (stone.weight() * stone.size.x() / (2.0 * stone.size.z()));
        };
        const double soft = find_limit(1.0), stiff = find_limit(8.0);
        CAPTURE(soft);
        CAPTURE(stiff);
        CHECK(soft < stiff);
        CHECK(stiff < 1.0);
        CHECK(2.0 * stiff - soft == relative(1.0, 0.02));
    }

}  // TEST_SUITE("slow")

TEST_CASE("a force grows in proportion to time, stays, and does work as far as its block slides") {
    const Stone stone = reference_wood();
    Model model = make_column(1);
    const double whole = 1.25 * stone.friction * stone.weight();
    model.loads = {{.point = {0.0, 0.0, -0.4 * stone.size.z()}, .force = whole, .start = 0.01, .rise = 0.02}};
    Simulation s(model, safe_step(model));
    advance_to(s, 0.005);
    CHECK(s.loads()[0].force == 0.0);
    CHECK(s.loads()[0].displacement == 0.0);
    advance_to(s, 0.02);
    CHECK(s.loads()[0].force == relative(0.5 * whole, 1e-2));
    advance_to(s, 0.05);
    CHECK(s.loads()[0].force == whole);
    const double before = s.energy().load_work, from = s.loads()[0].displacement, speed = s.velocity(0).x();
    advance_to(s, 0.1);
    CHECK(s.energy().load_work - before == relative(whole * (s.loads()[0].displacement - from), 1e-9));
    // F - μ W accelerates it; the block rocks on its springs by what a hundredth allows for
    CHECK(s.velocity(0).x() - speed == relative(0.05 * (whole - stone.friction * stone.weight()) / stone.mass(), 0.01));
}

TEST_CASE("an actuator ends where it goes, holds there, and its block is at rest") {
    const Stone stone = reference_wood();
    Model model = make_column(1);
    const double way = 0.02 * stone.size.x();
    model.loads = {make_push(stone, 0, 0.1 * stone.size.z(), way, 0.05)};
    Simulation s(model, safe_step(model));
    advance_to(s, 0.1);
    // but for what the friction that is left bends it by
    const double bends = stone.friction * stone.weight() / model.loads[0].stiffness;
    CHECK(std::abs(s.loads()[0].displacement - way) <= bends);
    CHECK(s.velocity(0).norm() < 1e-6 * way / 0.05);
}

TEST_CASE("loads wait while a structure comes to rest, and time at rest is passed over until they begin") {
    Model model = make_column(3);
    model.loads = {{.block = 2, .force = 0.1 * reference_wood().weight(), .start = 0.1, .rise = 0.01}};
    const double dt = safe_step(model);
    const auto settled = [&](bool skip) {
        Model own = model;
        own.numerics.skip_rest = skip;
        SettlingSimulation settling(Simulation(own, dt), 500.0);
        settling.advance(20000);
        return std::move(settling).finish();
    };
    Simulation skips = settled(true), looks = settled(false);
    CHECK(skips.loads()[0].force == 0.0);
    const auto steps = static_cast<std::uint64_t>(0.12 / dt);
    advance(skips, steps);
    advance(looks, steps);
    CHECK(skips.statistics().skipped > 0);
    CHECK(skips.loads()[0].force == model.loads[0].force);
    // time that is passed over leaves out rounding only
    CHECK((skips.position(2) - looks.position(2)).norm() < 1e-9 * reference_wood().size.x());
}

TEST_CASE("a simulation with loads goes on from its saved state with the same bits, for any number of threads") {
    const Stone stone = reference_wood();
    Model model = make_column(4);
    model.loads = {make_push(stone, 3, 0.9 * stone.size.z(), 0.02 * stone.size.x(), 0.02),
                   {.block = 1, .direction = Vector3::UnitY(), .force = 0.1 * stone.weight(), .rise = 0.03}};
    const double dt = safe_step(model);
    Simulation whole(model, dt, 2);
    advance(whole, 700);
    std::stringstream state;
    whole.save(state);
    Simulation rest = Simulation::restore(model, state, 1);
    advance(whole, 700);
    advance(rest, 700);
    CHECK(rest.state_hash() == whole.state_hash());
    CHECK(rest.energy().load_work == whole.energy().load_work);
    CHECK(rest.loads()[0].force == whole.loads()[0].force);
    Model other = model;
    other.loads[0].displacement *= 2.0;
    state.clear(), state.seekg(0);
    CHECK_THROWS_AS(Simulation::restore(other, state, 1), std::runtime_error);
}

TEST_CASE("an actuator asks for shorter steps as it becomes stiffer, and a step of that length is stable") {
    const Stone stone = reference_wood();
    Model model = make_column(1);
    const double free = compute_critical_time_step(model);
    model.loads = {make_push(stone, 0, 0.5 * stone.size.z(), 0.01 * stone.size.x(), 0.01)};
    const double soft = compute_critical_time_step(model);
    CHECK(soft <= free);
    CHECK(soft > 0.85 * free);
    model.loads[0].stiffness = 100.0 * stone.normal_stiffness;
    const double stiff = compute_critical_time_step(model);
    // of the actuator alone: (ω dt/2)² + ω dt = 1 with its critical dashpot
    const double alone = 2.0 * (std::sqrt(2.0) - 1.0) * std::sqrt(stone.mass() / model.loads[0].stiffness);
    CHECK(stiff < alone);
    CHECK(stiff > 0.8 * alone);
    Simulation s(model, 0.99 * stiff);
    advance(s, 5000);
    CHECK(std::isfinite(s.loads()[0].force));
}
