#include "lsdem/motion/leaving.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <sstream>

#include "lsdem/motion/simulation.hpp"
#include "lsdem/time_step.hpp"
#include "tests/support/heaps.hpp"
#include "tests/support/models.hpp"
#include "tests/support/motion.hpp"
#include "tests/support/relative.hpp"

using namespace musim::lsdem;
using namespace musim::lsdem::tests;

namespace {

/// Wood of another form and restitution, its stiffness an eightieth, so that falls take few steps.
Stone soft_wood(const Vector3& size, double restitution = 0.3) {
    Stone stone = stiffened(wood(), 1.0 / 80.0);
    stone.size = size;
    stone.restitution = restitution;
    return stone;
}

Model make_boxes(const Stone& stone) {
    Model model = make_model(wood());
    model.shapes[0] = make_box_shape(stone.size, {3, 3, 3});
    model.materials[0] = model.ground.material = make_material(stone);
    return model;
}

/// A block that turns about its lower edge at 1.5 times the rate that just overturns it: 2 (1 − cos α) p² of a rigid block [Housner63].
Model make_pushed_block(const Stone& stone) {
    Model model = make_boxes(stone);
    const double b = stone.size.x(), h = stone.size.z(), p = std::sqrt(1.5 * kGravity / std::hypot(b, h));
    const double rate = 1.5 * p * std::sqrt(2.0 * (1.0 - h / std::hypot(b, h)));
    Block block = make_block(stone, {0.0, 0.0, 0.5 * h});
    block.velocity = {0.5 * rate * h, 0.0, 0.5 * rate * b};
    block.angular_velocity = {0.0, rate, 0.0};
    model.blocks.push_back(block);
    return model;
}

double default_step(const Model& model) { return 0.8 * compute_critical_time_step(model); }

double tilt_of(const Simulation& simulation) {
    return std::acos(std::clamp(simulation.orientation(0).toRotationMatrix()(2, 2), -1.0, 1.0));
}

/// Largest opening of the balance, and largest rise of the mechanical energy above its least so far, over the energy put in [-].
struct Kept {
    double open = 0.0, gained = 0.0;
};
Kept watch_energy(Simulation& simulation, double duration) {
    const Energy start = simulation.energy();
    double open = 0.0, gained = 0.0, least = start.mechanical(), released = 0.0;
    while (simulation.time() < duration && !simulation.divergence()) {
        simulation.advance(8);
        const Energy now = simulation.energy();
        open = std::max(open, std::abs(now.balance() - start.balance()));
        gained = std::max(gained, now.mechanical() - least);
        least = std::min(least, now.mechanical());
        released = std::max(released, start.gravitational - now.gravitational);
    }
    const double put_in = start.kinetic + released;
    return {open / put_in, gained / put_in};
}

const Vector3 kSizes[] = {wood().size, {0.02, 0.02, 0.02}, {0.01, 0.01, 0.04}, {0.01, 0.01, 0.08}, {0.04, 0.04, 0.01}};

}  // namespace

TEST_CASE("a block that is pushed over lands, in steps that its base allows") {
    for (const Vector3& size : kSizes) {
        CAPTURE(size.transpose());
        const Model model = make_pushed_block(soft_wood(size));
        Simulation s(model, default_step(model));
        const Kept kept = watch_energy(s, 0.4);
        REQUIRE_FALSE(s.divergence());
        // on a face, the slab on its top
        CHECK(s.orientation(0).toRotationMatrix().row(2).cwiseAbs().maxCoeff() > 0.99);
        CHECK(tilt_of(s) > 1.5);
        CHECK(kept.open < 1e-2);
        CHECK(kept.gained < 1e-3);
        CHECK_FALSE(s.statistics().overstiff);
    }
}

TEST_CASE("steps are divided before the side lands, and not before the block falls") {
    const Model model = make_pushed_block(soft_wood({0.01, 0.01, 0.08}));
    Simulation s(model, default_step(model));
    while (!s.statistics().leaving && s.time() < 1.0) s.advance(1);
    const std::optional<Leaving> left = s.statistics().leaving;
    REQUIRE(left);
    CHECK(left->block == 0);
    CHECK(left->time == s.time());
    CHECK(left->substeps == 8);
    CHECK(tilt_of(s) > std::acos(0.78));
    CHECK(tilt_of(s) < kPi / 4.0);
    const Statistics then = s.statistics();
    CHECK(then.substeps == then.steps);
    s.advance(100);
    CHECK(s.statistics().steps == then.steps + 100);
    CHECK(s.statistics().substeps == then.substeps + 800);
    CHECK(s.time() == static_cast<double>(then.steps + 100) * s.time_step());
}

// Touching within a step leaves (ωh)²/4 open, parting adds (ωh)²/4 − 2ζωh; the step keeps the first below 9.1e-3, the second below 8e-4.
TEST_CASE("a block that lands flat on any face keeps its balance, and gains nothing at any restitution") {
    for (const double restitution : {0.05, 0.3, 0.8, 0.95, 1.0}) {
        for (const Vector3& size : kSizes) {
            for (Eigen::Index face = 0; face < 3; ++face) {
                CAPTURE(restitution);
                CAPTURE(size.transpose());
                CAPTURE(face);
                const Stone stone = soft_wood(size, restitution);
                Model model = make_boxes(stone);
                const Vector3 axis = face == 0 ? Vector3::UnitY() : Vector3::UnitX();
                const Quaternion turned(Eigen::AngleAxisd(face == 2 ? 0.0 : 0.5 * kPi, axis));
                model.blocks.push_back(make_block(stone, {0.0, 0.0, 0.53 * size[face] + 0.0021}, turned));
                model.blocks[0].velocity.z() = -0.9;
                Simulation s(model, default_step(model));
                const Kept kept = watch_energy(s, 0.012);
                CHECK(kept.open < 1e-2);
                CHECK(kept.gained < 1e-3);
            }
        }
    }
}

TEST_CASE("a wall that is shaken and stands takes whole steps") {
    Model model = make_running_bond(wood(), 1, 3, 5);
    model.ground.motion.shift[0] = sample_velocity(0.1, 100, [](double t) { return 0.05 * std::sin(190.0 * t); });
    Simulation s(model, default_step(model));
    s.advance(10000);
    REQUIRE(s.energy().friction_loss > 0.0);
    CHECK_FALSE(s.statistics().leaving);
    CHECK(s.statistics().substeps == s.statistics().steps);
}

// Uniform acceleration is exact in steps of any length, if each changes the velocity for half of the step before and half of its own.
TEST_CASE("a block in the air keeps to its parabola when steps are divided") {
    const Stone stone = wood();
    Model model = make_model(stone);
    model.blocks.push_back(make_block(stone, {0.0, 0.0, 0.5 * stone.size.z() + 1e-9}));
    model.blocks[0].velocity = {0.3, 0.0, 1.0};
    Simulation s(model, default_step(model));
    CHECK_FALSE(s.statistics().leaving);
    s.advance(5000);
    REQUIRE(s.statistics().leaving);
    const double t = s.time();
    CHECK(s.position(0).x() == relative(0.3 * t, 1e-12));
    CHECK(s.position(0).z() - model.blocks[0].position.z() == relative(t - 0.5 * kGravity * t * t, 1e-11));
    CHECK(s.velocity(0).z() == relative(1.0 - kGravity * t, 1e-11));
}

TEST_CASE("a fall at a sixteenth of the length has the same bits") {
    const auto fall = [](double length) {
        Stone stone = soft_wood(length * Vector3(0.01, 0.01, 0.08));
        stone.normal_stiffness *= length * length;
        stone.shear_stiffness *= length * length;
        const Model model = make_pushed_block(stone);
        Simulation s(model, default_step(model));
        s.advance(4000);
        REQUIRE(s.statistics().leaving);
        return s.kinematics();
    };
    const Kinematics large = fall(1.0), small = fall(1.0 / 16.0);
    CHECK(small.time == 0.25 * large.time);
    CHECK(Vector3(16.0 * small.position[0]) == large.position[0]);
    CHECK(small.orientation[0].coeffs() == large.orientation[0].coeffs());
    CHECK(Vector3(4.0 * small.velocity[0]) == large.velocity[0]);
}

TEST_CASE("a fall has the same bits when it is saved and restored on its way, and whatever the neighbor list holds") {
    const Model model = make_pushed_block(soft_wood({0.01, 0.01, 0.08}));
    Simulation whole(model, default_step(model)), renewed(model, default_step(model));
    const std::uint64_t steps = 4800;
    whole.advance(steps);
    REQUIRE(whole.statistics().leaving);
    const auto turns_at = static_cast<std::uint64_t>(std::llround(whole.statistics().leaving->time / whole.time_step()));
    for (const std::uint64_t at : {turns_at - 1, turns_at, turns_at + 1, turns_at + 700}) {
        Simulation before(model, default_step(model));
        before.advance(at);
        std::stringstream state;
        before.save(state);
        Simulation after = Simulation::restore(model, state);
        after.advance(steps - at);
        CHECK(after.state_hash() == whole.state_hash());
        CHECK(after.statistics().substeps == whole.statistics().substeps);
        CHECK(after.energy().balance() == whole.energy().balance());
    }
    for (std::uint64_t n = 0; n < steps; n += 8) renewed.renew_neighbors(), renewed.advance(8);
    CHECK(renewed.state_hash() == whole.state_hash());
}

TEST_CASE("a heap that falls has the same bits on one thread and on two") {
    const Model model = make_loose_pile(wood(), 8, 9);
    std::string hash;
    for (const int threads : {1, 2}) {
        Simulation s(model, default_step(model), threads);
        REQUIRE(s.threads() == threads);
        REQUIRE(s.statistics().leaving);
        s.advance(20);
        if (threads == 1) hash = s.state_hash();
        CHECK(s.state_hash() == hash);
    }
}

TEST_CASE("the number of halvings is that of the forms alone") {
    for (const Vector3& size : kSizes) {
        const Stone stone = soft_wood(size);
        Model upright = make_boxes(stone), lying = upright;
        upright.blocks.push_back(make_block(stone, {0.0, 0.0, 0.5 * size.z()}));
        lying.blocks.push_back(make_block(stone, {0.0, 0.0, 0.5 * size.x()}, tests::lying()));
        const int halvings = compute_landing_halvings(upright);
        CHECK(0.8 * compute_critical_time_step(upright) / (1 << halvings) < compute_critical_time_step(lying));
        for (const double length : {0.1, 0.37, 7.0}) {
            Model scaled = make_boxes(soft_wood(length * size));
            scaled.blocks.push_back(make_block(soft_wood(length * size), {0.0, 0.0, 0.0}));
            CHECK(compute_landing_halvings(scaled) == halvings);
        }
    }
    Model balls = make_model(wood());
    balls.shapes[0] = make_sphere_shape(0.01, 60, 0.001);
    balls.blocks.push_back(make_block(wood(), {0.0, 0.0, 0.01}));
    CHECK(compute_landing_halvings(balls) == 0);
    CHECK(compute_landing_halvings(make_model(wood())) == 0);
}
