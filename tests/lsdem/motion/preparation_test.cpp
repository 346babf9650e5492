#include <doctest/doctest.h>

#include <cmath>
#include <stdexcept>
#include <utility>
#include <vector>

#include "lsdem/motion/settling_simulation.hpp"
#include "lsdem/time_step.hpp"
#include "tests/support/models.hpp"

using namespace musim::lsdem;
using namespace musim::lsdem::tests;

namespace {

/// A column whose upper block is held high above it; the ground shakes along x.
Model make_held_column(const Stone& stone) {
    Model model = make_resting_column(stone, 2);
    model.blocks[1].fixed = true;
    model.blocks[1].position.z() += 10.0 * stone.size.z();
    model.ground.motion.shift[0] = {.start = 0.0, .dt = 1e-3, .velocity = {0.0, 0.05, -0.05, 0.05, 0.0}};
    return model;
}

Release put_on_top(const Stone& stone, double gap, double speed) {
    return {.block = 1, .position = {0.0, 0.0, 1.5 * stone.size.z() + gap}, .velocity = {0.0, 0.0, -speed}};
}

}  // namespace

TEST_CASE("a held block that is let go falls from where it was put, at its speed") {
    const Stone stone = wood();
    Model model = make_held_column(stone);
    model.ground.motion.shift[0] = {};
    const double dt = 1e-5, gap = 0.5 * stone.size.z(), speed = 0.1;
    SettlingSimulation settling(Simulation(model, dt), 0.0);
    const Simulation& s = settling.state();
    settling.advance(100);
    const Vector3 held = s.position(1);
    CHECK(held == model.blocks[1].position);
    settling.release({put_on_top(stone, gap, speed)});
    const double balance = s.energy().balance();
    CHECK(s.velocity(1).z() == doctest::Approx(-speed).epsilon(1e-12));
    settling.advance(1000);
    const double t = 1000.0 * dt;
    // leapfrog is exact in free flight
    CHECK(s.position(1).z() == doctest::Approx(1.5 * stone.size.z() + gap - speed * t - 0.5 * kGravity * t * t).epsilon(1e-12));
    CHECK(s.velocity(1).z() == doctest::Approx(-speed - kGravity * t).epsilon(1e-12));
    // and the energy balance has taken it in, but for what shorter steps in the air change: ½ m v(−½)·v(+½) = ½ m (v² − (g dt/2)²)
    const double of_step = 0.125 * stone.weight() * kGravity * dt * dt;
    CHECK(std::abs(s.energy().balance() - balance) < of_step + 1e-12 * stone.weight() * stone.size.z());
    CHECK_FALSE(s.divergence().has_value());
}

TEST_CASE("a released block comes to rest on the one below, and the ground bears both") {
    const Stone stone = wood();
    SettlingSimulation settling(Simulation(make_held_column(stone), 0.8 * compute_critical_time_step(make_held_column(stone))), 192.0);
    const Simulation& s = settling.state();
    settling.release({put_on_top(stone, 0.0, 0.01)});
    settling.advance(40000);
    CHECK(s.base_reaction().z() == doctest::Approx(2.0 * stone.weight()).epsilon(1e-6));
    // the base stands while a specimen is prepared
    CHECK(s.base().displacement == Vector3::Zero());
    CHECK(s.base().velocity == Vector3::Zero());
    const std::vector<ContactForce> forces = s.contact_forces();
    REQUIRE(forces.size() == 2);
    CHECK(forces[0].leader == 0);
    CHECK(forces[0].follower == 1);
    CHECK(forces[0].force.z() == doctest::Approx(-stone.weight()).epsilon(1e-6));
    CHECK_FALSE(forces[1].follower.has_value());
    CHECK(forces[1].force.z() == doctest::Approx(2.0 * stone.weight()).epsilon(1e-6));
}

TEST_CASE("when preparation ends, time, energy balance and motion begin and contacts keep what they hold") {
    const Stone stone = wood();
    const double dt = 0.8 * compute_critical_time_step(make_held_column(stone));
    SettlingSimulation settling(Simulation(make_held_column(stone), dt), 192.0);
    settling.release({put_on_top(stone, 0.0, 0.01)});
    settling.advance(40000);
    const Vector3 place = settling.state().position(1);
    const double elastic = settling.state().energy().elastic_normal;
    Simulation s = std::move(settling).finish();
    CHECK(s.time() == 0.0);
    CHECK(s.statistics().steps == 0);
    CHECK(s.energy().preparation_loss == 0.0);
    CHECK(s.energy().damping_loss == 0.0);
    CHECK(s.energy().friction_loss == 0.0);
    CHECK(s.energy().gravitational == 0.0);
    CHECK(s.energy().elastic_normal == elastic);
    CHECK(s.position(1) == place);
    CHECK(s.velocity_damping() == 0.0);
    for (const std::size_t block : {0U, 1U}) CHECK_FALSE(s.has_fallen(block));
    const double balance = s.energy().balance();
    s.advance(static_cast<std::uint64_t>(2.5e-3 / dt));
    CHECK(s.base().displacement.x() > 0.0);
    CHECK(s.energy().base_work > 0.0);
    CHECK(std::abs(s.energy().balance() - balance) < 1e-3 * s.energy().base_work);
}

TEST_CASE("only held blocks can be released, once, in a state that makes sense") {
    const Stone stone = wood();
    SettlingSimulation s(Simulation(make_held_column(stone), 1e-6), 192.0);
    const Release good = put_on_top(stone, 0.1, 0.0);
    CHECK_THROWS_AS(s.release({{.block = 0}}), std::invalid_argument);
    CHECK_THROWS_AS(s.release({{.block = 7}}), std::invalid_argument);
    CHECK_THROWS_AS(s.release({good, good}), std::invalid_argument);
    Release bad = good;
    bad.position.x() = std::nan("");
    CHECK_THROWS_AS(s.release({bad}), std::invalid_argument);
    bad = good;
    bad.orientation.w() = 2.0;
    CHECK_THROWS_AS(s.release({bad}), std::invalid_argument);
    CHECK_NOTHROW(s.release({good}));
    CHECK_THROWS_AS(s.release({good}), std::invalid_argument);
    CHECK_THROWS_AS(SettlingSimulation(Simulation(make_held_column(stone), 1e-6), -1.0), std::invalid_argument);
}
