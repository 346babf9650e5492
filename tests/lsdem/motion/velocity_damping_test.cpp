#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <stdexcept>
#include <string>

#include "lsdem/detail/instructions.hpp"
#include "lsdem/motion/simulation.hpp"
#include "lsdem/time_step.hpp"
#include "tests/support/heaps.hpp"
#include "tests/support/models.hpp"
#include "tests/support/motion.hpp"
#include "tests/support/relative.hpp"

using namespace musim::lsdem;
using namespace musim::lsdem::tests;

namespace {

/// The papers' rate for wood, c_v = 0.002 at their step [1/s].
constexpr double kDampingRate = 192.0;

/// One block in free flight that spins about a principal axis, without gravity.
Model make_flight() {
    Model model = make_model(wood());
    model.gravity.setZero();
    model.ground.present = false;
    Block block = make_block(wood(), Vector3::Zero(), Quaternion(Eigen::AngleAxisd(0.7, Vector3(1.0, 2.0, 3.0).normalized())));
    block.velocity = {0.3, -0.2, 0.1};
    block.angular_velocity = block.orientation * Vector3(0.0, 0.0, 5.0);
    model.blocks.push_back(block);
    model.velocity_damping = kDampingRate;
    return model;
}

}  // namespace

// dv/dt = −αv:  v = v0·exp(−αt),  x = v0·(1 − exp(−αt))/α
TEST_CASE("velocity and spin of a free block decay exponentially, whatever the time step") {
    const Model model = make_flight();
    const Block& start = model.blocks.front();
    for (const double step : {1e-5, 3e-5, 1e-4, 1e-3}) {
        CAPTURE(step);
        Simulation s(model, step);
        advance_to(s, 0.03);
        const double decay = std::exp(-kDampingRate * s.time());
        // as many roundings as steps, 3000 at most, each of 1e-16
        CHECK((s.velocity(0) - decay * start.velocity).norm() < 1e-12 * decay * start.velocity.norm());
        CHECK((s.angular_velocity(0) - decay * start.angular_velocity).norm() < 1e-12 * decay * start.angular_velocity.norm());
        // the midpoint rule for the path: (α dt)²/24
        const double error = kDampingRate * step * kDampingRate * step / 24.0;
        CHECK((s.position(0) - (1.0 - decay) / kDampingRate * start.velocity).norm() <
              (error + 1e-12) * start.velocity.norm() / kDampingRate);
        // exp(−2αt) of the kinetic energy is left, the rest is in the energy balance
        const Energy energy = s.energy();
        const double before = Simulation(model, step).energy().kinetic;
        CHECK(energy.kinetic == relative(decay * decay * before, 1e-11));
        CHECK(energy.preparation_loss == relative(before - energy.kinetic, 1e-11));
    }
}

TEST_CASE("a falling block reaches the terminal velocity g/alpha, whatever the time step") {
    Model model = make_flight();
    model.gravity.z() = -kGravity;
    for (const double step : {1e-5, 1e-3, 1.0 / kDampingRate}) {
        CAPTURE(step);
        Simulation s(model, step);
        const double start = s.energy().balance();
        advance_to(s, 40.0 / kDampingRate);
        // exp(−40) is 4e-18: only rounding is left
        CHECK((s.velocity(0) - Vector3(0.0, 0.0, -kGravity / kDampingRate)).norm() < 1e-12 * kGravity / kDampingRate);
        CHECK(s.energy().balance() - start == doctest::Approx(0.0).scale(s.energy().preparation_loss).epsilon(1e-12));
    }
}

// The energy balance of elastic oscillations closes but for rounding; so it must with damping, and when its rate changes. Overlaps of 2e-9
// m and more are differences of places 0.2 m away, known to 4e-17 m: 1e-8 of the energy, and some more after hundreds of steps.
TEST_CASE("the energy balance closes while a column settles, and when the damping changes or ends") {
    Stone stone = wood();
    stone.restitution = 1.0;
    Model model = make_resting_column(stone, 5);
    for (Block& block : model.blocks) block.velocity.z() = -2e-4;
    model.velocity_damping = 10.0 * kDampingRate;
    Simulation s(model, 0.2 * compute_critical_time_step(model));
    const double start = s.energy().balance();
    const auto error = [&] { return std::abs(s.energy().balance() - start) / s.energy().preparation_loss; };
    for (const double rate : {3.0 * kDampingRate, 30.0 * kDampingRate, 0.0}) {
        s.advance(500);
        CHECK(error() < 1e-7);
        s.set_velocity_damping(rate);
        CHECK(s.velocity_damping() == rate);
        CHECK(error() < 1e-7);
    }
    const double lost = s.energy().preparation_loss;
    s.advance(500);
    CHECK(error() < 1e-7);
    CHECK(s.energy().preparation_loss == lost);
}

TEST_CASE("the energy balance of a pile that is damped as it collapses closes" * doctest::test_suite("one-thread")) {
    Model model = make_loose_pile(wood(), 2, 2);
    model.velocity_damping = 20.0;
    Simulation s(model, 0.1 * compute_critical_time_step(model));
    const double start = s.energy().balance();
    advance_to(s, 0.15);
    REQUIRE_FALSE(s.divergence().has_value());
    const Energy energy = s.energy();
    REQUIRE(energy.preparation_loss > 0.2 * energy.damping_loss);
    const double turnover = energy.friction_loss + energy.damping_loss + energy.preparation_loss;
    // as without damping: touching and parting within a step costs (ω0 dt)², 1e-2
    CHECK(std::abs(energy.balance() - start) < 0.01 * turnover);
}

TEST_CASE("damping steadies a run at the step that is critical without it") {
    // x'' + αx' + ω²x = 0 by this scheme is stable up to (ω dt)² = 2 α dt coth(α dt/2), which is 4 or more
    Stone stone = wood();
    stone.restitution = 1.0;
    Model model = make_resting_column(stone, 5);
    model.blocks.back().velocity.z() = -1e-3;
    for (const double damping_per_step : {0.01, 0.3, 1.0}) {
        CAPTURE(damping_per_step);
        const double step = 0.99 * compute_critical_time_step(model);
        model.velocity_damping = damping_per_step / step;
        Simulation s(model, step);
        s.advance(20000);
        CHECK_FALSE(s.divergence().has_value());
        CHECK(s.velocity(4).norm() < 1e-8);
    }
}

TEST_CASE("wide and plain instructions damp with the same bits, and so do any number of threads") {
    Model pile = make_loose_pile(wood(), 2, 2);
    pile.velocity_damping = 20.0;
    std::string plain;
    for (const auto most : {musim::lsdem::detail::Instructions::plain, musim::lsdem::detail::Instructions::avx512}) {
        musim::lsdem::detail::limit_instructions(most);
        Simulation s(pile, 0.5 * compute_critical_time_step(pile));
        s.advance(5000);
        const std::string outcome = s.state_hash() + std::to_string(s.energy().preparation_loss);
        if (most == musim::lsdem::detail::Instructions::plain) plain = outcome;
        CHECK(outcome == plain);
    }
    Model bond = make_running_bond(wood(), 4, 12, 9);
    bond.velocity_damping = kDampingRate;
    REQUIRE(bond.blocks.size() > 400);
    Simulation one(bond, 0.8 * compute_critical_time_step(bond), 1), two(bond, one.time_step(), 2);
    one.advance(50);
    two.advance(50);
    REQUIRE(two.threads() == 2);
    CHECK(one.state_hash() == two.state_hash());
    CHECK(one.energy().preparation_loss == two.energy().preparation_loss);
}

TEST_CASE("time is passed over only without damping, when being slow means being at rest") {
    Model model = make_resting_column(wood(), 2);
    model.numerics.skip_rest = true;
    const double step = 0.5 * compute_critical_time_step(model);
    // drops by 1e-9 of its height; the most damping there can be: it falls at g·dt
    for (Block& block : model.blocks) block.position.z() += 1e-9 * wood().size.z();
    model.velocity_damping = 1.0 / step;
    Simulation s(model, step);
    s.advance(20000);
    CHECK(s.statistics().skipped == 0);
    CHECK(s.base_reaction().z() == relative(2.0 * wood().weight(), 1e-6));
    s.set_velocity_damping(0.0);
    s.advance(20000);
    CHECK(s.statistics().skipped > 0);
}

TEST_CASE("a damping rate that is negative, not a number or above one per step is refused") {
    Model model = make_flight();
    Simulation s(model, 1e-4);
    for (const double rate : {-1.0, std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(), 1.1e4}) {
        CAPTURE(rate);
        CHECK_THROWS_AS(s.set_velocity_damping(rate), std::invalid_argument);
        model.velocity_damping = rate;
        CHECK_THROWS_AS(Simulation(model, 1e-4), std::invalid_argument);
    }
    CHECK(s.velocity_damping() == kDampingRate);
}
