#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <sstream>

#include "lsdem/finite_turn.hpp"
#include "lsdem/motion/simulation.hpp"
#include "lsdem/rotation.hpp"
#include "lsdem/time_step.hpp"
#include "tests/support/models.hpp"
#include "tests/support/motion.hpp"

using namespace musim::lsdem;
using namespace musim::lsdem::tests;

namespace {

/// Rate of an angle A (1 − cos(2π t/T))/2, which begins and ends at nothing.
BaseComponent there_and_back(double angle, double period) {
    const double omega = 2.0 * kPi / period;
    return sample_velocity(period, 4000, [=](double t) { return 0.5 * angle * omega * std::sin(omega * t); });
}

/// A ground that has been turned by θ before the start, and stands.
void turn_before(Model& model, const Vector3& angle) {
    for (int axis = 0; axis < 3; ++axis)
        model.ground.motion.turn[static_cast<std::size_t>(axis)] = {-2.0, 0.5, {0.0, 2.0 * angle[axis], 0.0}};
}

/// Moves that turn about all axes at once by as much as a radian.
BaseComponents make_large_motion() {
    BaseComponents motion;
    motion.shift[0] = there_and_back(0.02, 0.05);
    motion.shift[2] = there_and_back(-0.01, 0.04);
    motion.turn[0] = there_and_back(0.5, 0.06);
    motion.turn[1] = there_and_back(-0.9, 0.05);
    motion.turn[2] = there_and_back(1.1, 0.07);
    motion.pivot = {0.3, -0.2, 0.1};
    return motion;
}

/// Two blocks on a ground that rocks about an edge, with some friction to slide by.
Model make_rocked_column() {
    Model model = make_resting_column(wood(), 2);
    model.blocks[1].position.x() += 0.0011;
    model.ground.motion.turn[1] = there_and_back(0.12, 0.11);
    model.ground.motion.turn[2] = there_and_back(0.08, 0.05);
    model.ground.motion.pivot = {0.01, 0.0, 0.0};
    return model;
}

}  // namespace

// The positions differ by the rounding of coordinates, 1e-16 of a height of 0.1 m and so 1e-9 of an overlap, which contacts amplify.
TEST_CASE("a scene on a turned ground under turned gravity is the scene itself") {
    Model upright = make_resting_column(wood(), 3);
    upright.blocks[1].position += Vector3(0.0011, -0.0023, 0.0);
    upright.blocks[2].position += Vector3(-0.0007, 0.0031, 0.0);
    upright.ground.motion.shift[0] = constant_acceleration(0.7 * kGravity, 1.0);
    const Vector3 angle(0.4, -0.7, 0.3);
    const Quaternion turn = turn_by(angle);
    Model turned = upright;
    turn_before(turned, angle);
    turned.gravity = turn * upright.gravity;
    for (Block& block : turned.blocks) {
        block.position = turn * block.position;
        block.orientation = turn * block.orientation;
    }
    const Vector3 along = turn * Vector3::UnitX();
    for (int axis = 0; axis < 3; ++axis)
        turned.ground.motion.shift[static_cast<std::size_t>(axis)] = constant_acceleration(0.7 * kGravity * along[axis], 1.0);
    const double step = 0.8 * compute_critical_time_step(upright);
    Simulation a(upright, step), b(turned, step);
    const auto steps = static_cast<std::uint64_t>(0.03 / step);
    advance(a, steps);
    advance(b, steps);
    double moved = 0.0, difference = 0.0;
    for (std::size_t i = 0; i < 3; ++i) {
        const Vector3 from_base = a.position(i) - a.base().displacement;
        moved = std::max(moved, (from_base - upright.blocks[i].position).norm());
        difference = std::max(difference, (from_base - turn.conjugate() * (b.position(i) - b.base().displacement)).norm());
        difference = std::max(difference, wood().size.z() * rotation_vector(a.orientation(i), turn.conjugate() * b.orientation(i)).norm());
    }
    REQUIRE(moved > 0.05 * wood().size.x());
    CHECK(difference < 1e-6 * moved);
    CHECK((a.base_reaction() - turn.conjugate() * b.base_reaction()).norm() < 1e-4 * a.base_reaction().norm());
    CHECK(b.energy().base_work == relative(a.energy().base_work, 1e-6));
}

TEST_CASE("what is held to the base moves with any point of it through finite turns") {
    const Stone stone = wood();
    Model model = make_model(stone);
    model.blocks.push_back(make_block(stone, {0.1, 0.2, 0.3}, turn_by({0.3, 0.2, 0.1})));
    model.blocks[0].fixed = model.blocks[0].with_base = true;
    model.ground.motion = make_large_motion();
    Simulation s(model, 1e-6);
    double away = 0.0, turned = 0.0, velocity = 0.0, fastest = 0.0;
    for (int sample = 0; sample < 50; ++sample) {
        s.advance(1003);  // never where a motion ends, and its acceleration jumps
        const BaseState base = s.base();
        away = std::max(away, (base.seen_from_base(s.position(0)) - model.blocks[0].position).norm());
        turned = std::max(turned, (base.turn.conjugate() * s.orientation(0)).angularDistance(model.blocks[0].orientation));
        // the block's velocity is that of the middle of the step before
        const Vector3 half_a_step = 0.5 * s.time_step() * base.acceleration_at(s.position(0));
        velocity = std::max(velocity, (s.velocity(0) - (base.velocity_at(s.position(0)) - half_a_step)).norm());
        fastest = std::max(fastest, s.velocity(0).norm());
        CHECK(s.angular_velocity(0) == base.turn_rates.velocity);
    }
    REQUIRE(fastest > 10.0);
    // 50,000 steps, each rounding places of 0.4 m: 1e-16 of them times the square root of the steps, with room
    CHECK(away < 1e-12);
    CHECK(turned < 1e-7);  // a distance of quaternions whose cosine is 1 to rounding
    // jerks over half a step
    CHECK(velocity < 1e-5 * fastest);
}

TEST_CASE("what is held to a base that moved before the start stays where it is on the base") {
    const Stone stone = wood();
    Model model = make_model(stone);
    model.blocks.push_back(make_block(stone, {0.1, 0.2, 0.3}));
    model.blocks[0].fixed = model.blocks[0].with_base = true;
    model.ground.motion = make_large_motion();
    model.ground.motion.shift[1] = {-0.01, 0.005, {0.0, 2.0, 1.0, 0.0}};
    Simulation s(model, 1e-5);
    REQUIRE(s.base().displacement.y() > 0.01);
    const Vector3 start = s.base().seen_from_base(s.position(0));
    for (int sample = 0; sample < 5; ++sample) {
        s.advance(500);
        CHECK((s.base().seen_from_base(s.position(0)) - start).norm() < 1e-12);
    }
}

// [Yim80]: once the block has left its base it turns about the edge that the base turns about, I φ″ = m g R sin(φ − α), whatever the base
// does; it leaves when the base pulls away, θ″ < p² sin(θ − α). The acceleration is one sine from rest, of 0.9 p² sin α at most: a base
// that is harder on it at first tips it over its other edge.
TEST_CASE("a block on a base that rocks about its edge leaves it and rocks by the equation of a block about an edge") {
    Stone stone = reference_wood();
    stone.friction = 10.0;
    const double b = stone.size.x(), h = stone.size.z(), alpha = std::atan(b / h), radius = 0.5 * std::hypot(b, h);
    const double p_squared = 0.75 * kGravity / radius;  // of a rectangle about its edge, m g R/I with I = 4/3 m R²
    const double angle = 0.5 * alpha, most = 0.9 * p_squared * std::sin(alpha), time = std::sqrt(2.0 * kPi * angle / most);
    const double omega = 2.0 * kPi / time;
    const auto base_angle = [&](double t) { return t < time ? angle * (t - std::sin(omega * t) / omega) / time : angle; };
    const auto base_rate = [&](double t) { return t < time ? angle / time * (1.0 - std::cos(omega * t)) : 0.0; };
    const auto base_acceleration = [&](double t) { return t < time ? most * std::sin(omega * t) : 0.0; };

    // the equation, by the midpoint rule, until the block lands
    const double dt = time / 200000.0;
    double t = 0.0;
    while (t < time && !(base_acceleration(t) < p_squared * std::sin(base_angle(t) - alpha))) t += dt;
    REQUIRE(t < 0.9 * time);
    double phi = base_angle(t), rate = base_rate(t), widest = 0.0;
    const double left_at = t;
    for (; phi >= base_angle(t) && t < 5.0 * time; t += dt) {
        const double fall = p_squared * std::sin(phi + 0.5 * dt * rate - alpha);
        phi += dt * (rate + 0.5 * dt * fall), rate += dt * fall;
        widest = std::max(widest, phi - base_angle(t + dt));
    }
    REQUIRE(t > left_at + 0.1 * time);
    REQUIRE(widest > 0.05 * angle);
    // joints bear over a length that goes with the cube root of 1/K, and so does what the block turns too far: extrapolated from K and 64 K
    const auto simulate_with = [&](double stiffening) {
        Model model = make_resting_column(stiffened(stone, stiffening), 1);
        model.ground.motion.turn[1] = sample_velocity(time, 4000, base_rate);
        model.ground.motion.pivot = {0.5 * b, 0.0, 0.0};
        Simulation s(model, 0.5 * compute_critical_time_step(model));
        double most_turned = 0.0;
        while (s.time() < t) {
            advance(s);
            most_turned = std::max(most_turned, rotation_vector(Quaternion::Identity(), s.orientation(0)).y() - base_angle(s.time()));
        }
        return most_turned;
    };
    const double soft = simulate_with(1.0), stiff = simulate_with(64.0);
    CHECK(stiff == relative(widest, 0.05));
    CHECK((4.0 * stiff - soft) / 3.0 == relative(widest, 0.02));
}

TEST_CASE("a long plate held by friction moves as any point of the base that carries it") {
    Stone stone = reference_wood();
    stone.friction = 50.0;
    stone.size = {0.02, 0.3, 0.01};
    Model model = make_resting_column(stone, 1);
    // slowly against its shear springs, about a point far away
    model.ground.motion.turn[2] = there_and_back(0.6, 0.4);
    model.ground.motion.turn[0] = there_and_back(0.02, 0.4);
    model.ground.motion.pivot = {0.4, 0.1, 0.0};
    Simulation s(model, 0.8 * compute_critical_time_step(model));
    const Vector3 tip(0.01, 0.15, 0.0);
    double away = 0.0, moved = 0.0;
    for (int sample = 1; sample <= 40; ++sample) {
        advance_to(s, 0.01 * sample);
        const Vector3 place = s.position(0) + s.orientation(0) * tip, start = model.blocks[0].position + tip;
        away = std::max(away, (s.base().seen_from_base(place) - start).norm());
        moved = std::max(moved, (place - start).norm());
    }
    REQUIRE(moved > 0.1);
    CHECK(away < 1e-4 * moved);
}

TEST_CASE("the energy balance closes with the couple of a base that turns") {
    const Model model = make_rocked_column();
    const double critical = compute_critical_time_step(model);
    double coarse = 0.0;
    for (const double part : {0.4, 0.2}) {
        Simulation s(model, part * critical);
        const double start = s.energy().balance();
        double work = 0.0, open = 0.0;
        for (int sample = 1; sample <= 50; ++sample) {
            advance_to(s, 0.002 * sample);
            work = std::max(work, std::abs(s.energy().base_work));
            open = std::max(open, std::abs(s.energy().balance() - start));
        }
        REQUIRE(work > 0.02 * wood().weight() * wood().size.x());
        CHECK(open < 1e-3 * work);
        if (part < 0.4) CHECK(open < 0.5 * coarse);
        coarse = open;
    }
}

// The weight's moment about the pivot is what the base bears.
TEST_CASE("the couple of the base about its pivot is the moment of the weight that it carries") {
    Model model = make_resting_column(wood(), 2);
    model.ground.motion.turn[1] = {0.0, 1.0, {0.0, 1e-9, 0.0}};
    model.ground.motion.pivot = {0.3, -0.1, 0.0};
    Simulation s(model, 0.8 * compute_critical_time_step(model));
    advance(s, 10);
    const Vector3 couple = (Vector3::Zero() - model.ground.motion.pivot).cross(Vector3(0.0, 0.0, 2.0 * wood().weight()));
    CHECK((s.base_couple() - couple).norm() < 1e-6 * couple.norm());
}

TEST_CASE("a turning ground gives the same bits to any number of threads, after a restart and in lengths of a power of four") {
    const Model model = make_rocked_column();
    const double step = 0.8 * compute_critical_time_step(model);
    Simulation whole(model, step);
    advance(whole, 4000);
    Simulation first(model, step);
    advance(first, 1500);
    std::stringstream state;
    first.save(state);
    Simulation second = Simulation::restore(model, state, 2);
    second.renew_neighbors();
    advance(second, 2500);
    CHECK(second.state_hash() == whole.state_hash());
    CHECK(second.energy().base_work == whole.energy().base_work);

    Stone large = wood();
    large.size *= 4.0;
    large.normal_stiffness *= 16.0;
    large.shear_stiffness *= 16.0;
    Model image = make_resting_column(large, 2);
    for (std::size_t i = 0; i < 2; ++i) image.blocks[i].position = 4.0 * model.blocks[i].position;
    image.ground.motion = model.ground.motion;
    for (BaseComponent& about : image.ground.motion.turn) {
        about.dt *= 2.0;
        for (double& rate : about.velocity) rate *= 0.5;
    }
    image.ground.motion.pivot *= 4.0;
    Simulation scaled(image, 2.0 * step);
    advance(scaled, 4000);
    for (std::size_t i = 0; i < 2; ++i) {
        CHECK(scaled.position(i) == Vector3(4.0 * whole.position(i)));
        CHECK(scaled.orientation(i).coeffs() == whole.orientation(i).coeffs());
    }
}
