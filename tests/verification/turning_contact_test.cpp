#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "lsdem/motion/simulation.hpp"
#include "lsdem/time_step.hpp"
#include "tests/support/faces.hpp"
#include "tests/support/models.hpp"
#include "tests/support/motion.hpp"
#include "tests/support/relative.hpp"

// Boxes that meet resist turning about the direction in which they push each other (docs/theory/overlap_contact.md, "Friction").
using namespace musim::lsdem;
using namespace musim::lsdem::tests;

namespace {

/// A fixed plate below a block that is turned about the vertical by `twist`.
Model make_block_across(const Stone& stone, double rate, double twist = 0.25 * kPi) {
    Model model = make_model(stone);
    model.ground.present = false;
    const double side = 4.0 * stone.size.y();
    model.shapes.push_back(make_box_shape({side, side, stone.size.z()}, {5, 5, 5}));
    Block plate = make_block(stone, {0.0, 0.0, -0.5 * stone.size.z()});
    plate.shape = 1;
    plate.fixed = true;
    Block block = make_block(stone, {0.0, 0.0, 0.5 * stone.size.z() - stone.weight() / stone.normal_stiffness},
                             Quaternion(Eigen::AngleAxisd(twist, Vector3::UnitZ())));
    block.angular_velocity.z() = rate;
    model.blocks = {plate, block};
    return model;
}

/// A fixed block turned by 45° about x, and a beam whose middle lies across its upper edge.
Model make_beam_on_edge(const Stone& stone, double rate) {
    Model model = make_model(stone);
    model.ground.present = false;
    const double top = (stone.size.y() + stone.size.z()) / std::sqrt(8.0), aside = (stone.size.z() - stone.size.y()) / std::sqrt(8.0);
    Block edge = make_block(stone, {0.0, aside, -top}, Quaternion(Eigen::AngleAxisd(0.25 * kPi, Vector3::UnitX())));
    edge.fixed = true;
    Matrix3 lie;
    lie << 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 1.0, 0.0, 0.0;
    Block beam = make_block(stone, {0.0, 0.0, 0.5 * stone.size.x()}, Quaternion(lie));
    beam.angular_velocity.z() = rate;
    model.blocks = {edge, beam};
    return model;
}

/// Impulse of the normal force on a block since the start, as it would fall without [N·s].
double normal_impulse(const Simulation& simulation, const Stone& stone, std::size_t block) {
    return stone.mass() * (kGravity * simulation.time() + simulation.velocity(block).z());
}

}  // namespace

// Pressure is even: the couple is μ N times the mean distance of the face's points from its middle. Its springs take it up within
// sqrt(I/(K_s J)) = sqrt(m/k_s), here 1/100 of the time.
TEST_CASE("a block that spins across a plate is slowed by mu N times the mean distance of its face at any twist") {
    const Stone stone = wood();
    const double rate = 2.0, inertia = stone.mass() * stone.size.head<2>().squaredNorm() / 12.0;
    for (const double twist : {0.0, 0.3, 0.25 * kPi, 1.2}) {
        CAPTURE(twist);
        const Model model = make_block_across(stone, rate, twist);
        Simulation s(model, 0.1 * compute_critical_time_step(model));
        advance_to(s, 2.0e-3);
        REQUIRE(s.statistics().contacts == 1);
        const double lost = inertia * (rate - s.angular_velocity(1).z());
        const double expected = stone.friction * mean_distance(stone.size.x(), stone.size.y()) * normal_impulse(s, stone, 1);
        REQUIRE(s.angular_velocity(1).z() > 0.1 * rate);
        const double loading = std::sqrt(stone.mass() / stone.shear_stiffness) / s.time();
        CHECK(lost == relative(expected, 2.0 * loading));
    }
}

TEST_CASE("a beam that turns on an edge is slowed by mu N times a quarter of the edge") {
    const Stone stone = wood();
    const double rate = 5.0, length = stone.size.x();
    const double inertia = stone.mass() * stone.size.tail<2>().squaredNorm() / 12.0;
    Simulation s(make_beam_on_edge(stone, rate), 0.1 * compute_critical_time_step(make_beam_on_edge(stone, rate)));
    advance_to(s, 0.03);
    const double lost = inertia * (rate - s.angular_velocity(1).z());
    const double expected = stone.friction * 0.25 * length * normal_impulse(s, stone, 1);
    // its springs load in 0.16 ms, at first and after every bounce
    CHECK(lost == relative(expected, 5e-3));
}

// A thin tile, so that friction at its base does not move the pressure: what it loses of its momentum and of its spin together is μ times
// the impulse of the normal force.
TEST_CASE("a tile that slides and spins across a plate loses force and couple by one limit") {
    Stone stone = wood();
    stone.size.z() = 0.02 * stone.size.x();
    const double rate = 20.0, inertia = stone.mass() * stone.size.head<2>().squaredNorm() / 12.0;
    const double reach = mean_distance(stone.size.x(), stone.size.y());
    for (const double speed : {0.05, 0.15, 0.45}) {
        Model model = make_block_across(stone, rate);
        model.blocks[1].velocity.x() = speed;
        Simulation s(model, 0.1 * compute_critical_time_step(model));
        advance(s, 100);
        const double fell = normal_impulse(s, stone, 1), slower = s.velocity(1).x(), turns = s.angular_velocity(1).z();
        advance(s, 100);
        const double impulse = stone.friction * (normal_impulse(s, stone, 1) - fell);
        const double force = stone.mass() * (slower - s.velocity(1).x()) / impulse;
        const double couple = inertia * (turns - s.angular_velocity(1).z()) / (reach * impulse);
        CHECK(std::hypot(force, couple) == relative(1.0, 2e-3));
        CHECK(std::min(force, couple) > 0.1);
    }
}

// I = m e²/12 and J = A e²/12: the frequency is that of shear, sqrt(k_s/m).
TEST_CASE("a block stuck across a plate turns to and fro with the period of its shear springs and keeps its energy") {
    const Stone stone = wood();
    const double half = kPi * std::sqrt(stone.mass() / stone.shear_stiffness);
    // a hundredth of what makes it slide
    const double rate = 0.01 * stone.friction * kGravity * (half / kPi) / stone.size.y();
    const Model model = make_block_across(stone, rate);
    Simulation s(model, 0.05 * compute_critical_time_step(model));
    const auto spin = [](const Simulation& now) { return now.angular_velocity(1).z(); };
    const double first = find_crossing(s, half, spin), next = find_crossing(s, 2.0 * half, spin);
    // leapfrog shortens the period by (ω dt)²/24
    const double phase = kPi * s.time_step() / half;
    CHECK((next - first) / half == relative(1.0 - phase * phase / 24.0, 1e-6));
    // the first step counts as one that has turned: energy to phase²
    double fastest = 0.0;
    advance_to(s, 40.0 * half);
    while (s.time() < 42.0 * half) {
        advance(s);
        fastest = std::max(fastest, s.angular_velocity(1).z());
    }
    CHECK(fastest == relative(rate, 0.5 * phase * phase));
    CHECK(std::abs(s.energy().friction_loss) < 1e-6 * s.energy().kinetic);
}

TEST_CASE("a block across a plate that bears a couple from the start turns by it, and one that bears too much of it slides") {
    const Stone stone = wood();
    const double inertia = stone.mass() * stone.size.head<2>().squaredNorm() / 12.0;
    const double limit = stone.friction * stone.weight() * mean_distance(stone.size.x(), stone.size.y());
    Model model = make_block_across(stone, 0.0);
    const double step = 0.02 * compute_critical_time_step(model);
    model.preload = Simulation(model, step).preloads();
    REQUIRE(model.preload.size() == 1);
    for (const double part : {0.5, -0.5, 4.0}) {
        model.preload[0].couple = part * limit;
        Simulation s(model, step);
        // springs and forces are those of the pose: the couple that turns the block is the one it was given, or the limit
        const double held = std::min(part, 1.0) * limit;
        CHECK(s.preloads()[0].couple == relative(held, 1e-6));
        advance(s, 2);
        // about the direction in which each is pushed, both blocks get the same
        CHECK(inertia * s.angular_velocity(1).z() / (2.0 * step) == relative(held, 0.01));
    }
}
