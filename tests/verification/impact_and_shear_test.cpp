#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <cstdint>

#include "lsdem/contact_law.hpp"
#include "lsdem/motion/simulation.hpp"
#include "lsdem/time_step.hpp"
#include "tests/support/models.hpp"
#include "tests/support/motion.hpp"
#include "tests/support/relative.hpp"

using namespace musim::lsdem;
using namespace musim::lsdem::tests;

namespace {

/// Speed after over speed before of a block that hits the ground flat, at `steps` time steps per undamped contact duration.
double measure_restitution(double restitution, double steps, double speed) {
    Stone stone = wood();
    stone.restitution = restitution;
    Model model = make_model(stone);
    model.gravity.setZero();
    model.blocks.push_back(make_block(stone, {0.0, 0.0, 0.5 * stone.size.z() + 1e-9}));
    model.blocks[0].velocity.z() = -speed;
    const double duration = kPi * std::sqrt(stone.mass() / stone.normal_stiffness);
    Simulation s(model, duration / steps);
    s.advance(static_cast<std::uint64_t>(3.0 * steps + 1e-9 / speed / s.time_step()));
    REQUIRE(s.base_reaction().norm() == 0.0);
    return s.velocity(0).z() / speed;
}

}  // namespace

// [SchwagerPoeschel07]: the spring-dashpot whose force is never attractive.
TEST_CASE("an impact has the coefficient of restitution that was asked for") {
    for (const double e : {0.3, 0.5, 0.7, 0.9, 1.0}) {
        CAPTURE(e);
        const double coarse = measure_restitution(e, 200.0, 0.05), fine = measure_restitution(e, 800.0, 0.05);
        // the dashpot force lags by half a step: of its share 2ζ of the force, a phase π/(2·200)
        const double zeta = compute_damping_ratio(e);
        CHECK(std::abs(coarse - e) < 2.0 * zeta * kPi / 400.0 + 1e-4);
        CHECK(std::abs(fine - e) < 2.0 * zeta * kPi / 1600.0 + 1e-5);
    }
}

TEST_CASE("restitution does not depend on the speed of impact") {
    for (const double e : {0.3, 0.7}) {
        // the instant of touch falls anywhere within a step, of which there are 800
        CHECK(measure_restitution(e, 800.0, 0.5) == relative(measure_restitution(e, 800.0, 0.005), 3e-3));
    }
}

// Two equal blocks: m_eff = m/2 makes the same coefficient.
TEST_CASE("two blocks that collide part with the coefficient of restitution") {
    for (const double e : {0.3, 0.7}) {
        Stone stone = wood();
        stone.restitution = e;
        Model model = make_model(stone);
        model.gravity.setZero();
        model.ground.present = false;
        model.blocks.push_back(make_block(stone, Vector3::Zero()));
        model.blocks.push_back(make_block(stone, {0.0, 0.0, stone.size.z() + 1e-9}));
        model.blocks[1].velocity.z() = -0.05;
        const double step = kPi * std::sqrt(0.5 * stone.mass() / stone.normal_stiffness) / 400.0;
        Simulation s(model, step);
        s.advance(1200);
        CHECK((s.velocity(1).z() - s.velocity(0).z()) / 0.05 == relative(e, 2.0 * kPi / 800.0));
    }
}

// A dropped block: successive heights in the ratio e².
TEST_CASE("a dropped block bounces to e squared of its height") {
    Stone stone = wood();
    stone.restitution = 0.7;
    Model model = make_model(stone);
    const double drop = 2e-3;
    model.blocks.push_back(make_block(stone, {0.0, 0.0, 0.5 * stone.size.z() + drop}));
    const double contact = kPi * std::sqrt(stone.mass() / stone.normal_stiffness);
    Simulation s(model, contact / 200.0);
    double height = drop;
    for (int bounce = 0; bounce < 4; ++bounce) {
        CAPTURE(bounce);
        const auto rising = [](const Simulation& now) { return now.velocity(0).z(); };
        find_crossing(s, 1.0, rising);
        find_crossing(s, 1.0, rising);
        const double next = s.position(0).z() - 0.5 * stone.size.z();
        // e to the half step of the dashpot, and gravity within the contact against the speed: g t_c/v
        const double speed = std::sqrt(2.0 * kGravity * height);
        CHECK(next / height == relative(0.49, 2.0 * kPi / 400.0 + kGravity * contact / speed));
        height = next;
    }
}

namespace {

/// A block so heavy, in gravity so weak, that the base moves under it while it stands still: a displacement-controlled shear test.
Model make_shear_test(const Stone& stone) {
    constexpr double kHeavier = 1e9;
    Model model = make_model(stone);
    model.gravity.z() = -kGravity / kHeavier;
    model.blocks.push_back(make_block(stone, {0.0, 0.0, 0.5 * stone.size.z() - stone.weight() / stone.normal_stiffness}));
    model.blocks[0].mass *= kHeavier;
    model.blocks[0].rotation_locked = true;
    return model;
}

constexpr double kShearStep = 1e-6;  ///< [s]; the block's own period is 0.1 s and more

}  // namespace

// [CundallStrack79]: a spring-slider driven between ±u0 dissipates 4 μN (u0 − μN/k_s) a cycle.
TEST_CASE("cyclic shear dissipates the area of the spring-slider's loop") {
    Stone stone = reference_wood();
    stone.restitution = 1.0;
    Model model = make_shear_test(stone);
    const double u0 = 1e-6, quarter = 1e-3;
    // triangle: out to +u0, back to −u0, out again
    model.ground.motion.shift[0] = {0.0, 1e-9, {u0 / quarter}};
    const double v = u0 / quarter;
    BaseComponent triangle{0.0, 1e-8, {}};
    const auto samples = static_cast<std::size_t>(std::llround(9.0 * quarter / triangle.dt));
    for (std::size_t k = 0; k < samples; ++k) {
        const double phase = static_cast<double>(k) * triangle.dt / quarter;
        triangle.velocity.push_back(phase < 1.0 || (phase >= 3.0 && phase < 5.0) || phase >= 7.0 ? v : -v);
    }
    model.ground.motion.shift[0] = triangle;
    Simulation s(model, kShearStep);
    advance_to(s, 5.0 * quarter);
    const Energy before = s.energy();
    advance_to(s, 9.0 * quarter);
    const double loss = s.energy().friction_loss - before.friction_loss;
    const double work = s.energy().base_work - before.base_work;
    // the corners of the triangle are cut within a base sample of 10 ns in 1 ms, twice a cycle: 2e-5 of u0
    CHECK(loss == relative(0.2624732e-6, 4e-5));
    CHECK(work == relative(loss, 1e-4));
}

TEST_CASE("shear below the friction limit is elastic and comes back to zero") {
    const Stone stone = reference_wood();
    Model model = make_shear_test(stone);
    const double limit = stone.friction * stone.weight() / stone.shear_stiffness, time = 1e-3;
    model.ground.motion.shift[0] = sample_velocity(2.0 * time, 2000, [&](double t) {
        return 0.9 * limit * kPi / time * (t < time ? 0.5 : -0.5) * std::abs(std::sin(kPi * t / time));
    });
    Simulation s(model, kShearStep);
    advance_to(s, time);
    const double most = s.base_reaction().x();
    advance_to(s, 2.0 * time);
    CHECK(most == relative(0.9 * stone.friction * stone.weight(), 1e-5));
    // what slips is the work less what springs take up: a rounding of the latter in each of 2000 steps
    CHECK(std::abs(s.energy().friction_loss) < 2000 * 1e-16 * 0.5 * most * most / stone.shear_stiffness);
    CHECK(std::abs(s.base_reaction().x()) < 1e-5 * most);
}

TEST_CASE("a circular slip path keeps friction at its limit and against the motion") {
    const Stone stone = reference_wood();
    Model model = make_shear_test(stone);
    const double radius = 1e-6, period = 4e-3, omega = 2.0 * kPi / period;
    model.ground.motion.shift[0] = sample_velocity(2.0 * period, 4000, [=](double t) { return -radius * omega * std::sin(omega * t); });
    model.ground.motion.shift[1] = sample_velocity(2.0 * period, 4000, [=](double t) { return radius * omega * std::cos(omega * t); });
    Simulation s(model, kShearStep);
    advance_to(s, period);
    const double limit = stone.friction * stone.weight(), lag = limit / stone.shear_stiffness / radius;
    for (int i = 0; i < 20; ++i) {
        advance_to(s, period * (1.0 + 0.05 * i));
        const Eigen::Vector2d force = s.base_reaction().head<2>(), motion = s.base().velocity.head<2>().normalized();
        CHECK(force.norm() == relative(limit, 1e-6));
        // the block is dragged along, with its spring a little behind: by the angle (μN/k_s)/radius
        CHECK(force.normalized().dot(motion) > std::cos(1.5 * lag + omega * s.time_step()));
    }
}
