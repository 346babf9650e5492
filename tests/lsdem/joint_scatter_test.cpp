#include "lsdem/joint_scatter.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "lsdem/contact_law.hpp"
#include "lsdem/model_hash.hpp"
#include "lsdem/motion/simulation.hpp"
#include "lsdem/time_step.hpp"
#include "tests/support/heaps.hpp"
#include "tests/support/models.hpp"
#include "tests/support/motion.hpp"
#include "tests/support/relative.hpp"

using namespace musim::lsdem;
using namespace musim::lsdem::tests;

namespace {

/// Deviates of the joints of each of `count` blocks with the one `apart` places behind it.
std::vector<double> draw_chain(std::size_t count, std::size_t apart, std::uint64_t seed) {
    std::vector<double> deviates;
    for (std::size_t i = 0; i < count; ++i) deviates.push_back(draw_joint_deviate(seed, i, i + apart));
    return deviates;
}

double mean_product(const std::vector<double>& a, const std::vector<double>& b) {
    double sum = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
    return sum / static_cast<double>(a.size());
}

Model make_scattered_wall() {
    Model model = make_running_bond(wood(), 8, 12, 9);
    model.scatter = {.friction = 0.1, .seed = 5};
    model.ground.motion.shift[0] = velocity_step(1.0);
    return model;
}

}  // namespace

// The normal law cut off at ±c has the variance 1 − 2cφ(c)/(2Φ(c) − 1): 1 − 8·1.338e-4/0.99994 = 0.99893 at c = 4.
TEST_CASE("deviates of joints are normal, cut off at four, and independent of each other") {
    constexpr std::size_t kCount = 40000;
    // five standard errors: 1/sqrt(n) of a mean, sqrt(2/n) of a variance, 1/sqrt(n) of a product of two that are independent
    const double error = 5.0 / std::sqrt(static_cast<double>(kCount));
    const std::vector<double> ones(kCount, 1.0), next = draw_chain(kCount, 1, 1), second = draw_chain(kCount, 2, 1);
    CHECK(std::abs(mean_product(next, ones)) < error);
    CHECK(std::abs(mean_product(next, next) - 0.99893) < std::sqrt(2.0) * error);
    double largest = 0.0;
    for (const double z : next) largest = std::max(largest, std::abs(z));
    CHECK(largest <= kMostJointDeviates);
    CHECK(largest > 3.5);  // of 40,000 some 19 lie beyond 3.5

    CHECK(std::abs(mean_product(next, second)) < error);
    CHECK(std::abs(mean_product(next, draw_chain(kCount, 1, 2))) < error);
    std::vector<double> on_ground;
    for (std::size_t i = 0; i < kCount; ++i) on_ground.push_back(draw_joint_deviate(1, i, std::nullopt));
    CHECK(std::abs(mean_product(on_ground, ones)) < error);
    CHECK(std::abs(mean_product(next, on_ground)) < error);
    // joints around a square
    std::vector<double> around;
    for (std::size_t i = 0; i < kCount; ++i)
        around.push_back(draw_joint_deviate(1, i, i + 1) * draw_joint_deviate(1, i + 1, i + 3) * draw_joint_deviate(1, i + 2, i + 3) *
                         draw_joint_deviate(1, i, i + 2));
    CHECK(std::abs(mean_product(around, ones)) < error);
}

TEST_CASE("the friction of a joint is the same whichever of its blocks is named first") {
    Model model = make_running_bond(wood(), 2, 3, 4);
    const double mean = find_joint_of_blocks(model, 3, 7).friction;
    CHECK(mean == wood().friction);
    model.scatter = {.friction = 0.2, .seed = 3};
    for (std::size_t a = 0; a < model.blocks.size(); ++a) {
        for (std::size_t b = 0; b < a; ++b) {
            const double friction = find_joint_of_blocks(model, a, b).friction;
            CHECK(friction == find_joint_of_blocks(model, b, a).friction);
            CHECK(friction == wood().friction * (1.0 + 0.2 * draw_joint_deviate(3, a, b)));
            CHECK(friction > 0.0);
        }
        CHECK(find_joint_of_blocks(model, a, std::nullopt).friction == wood().friction * (1.0 + 0.2 * draw_joint_deviate(3, a, {})));
    }
}

// Elementary dynamics: a = g (sin θ − μ cos θ), with the friction of its own joint.
TEST_CASE("a block on an incline slides at the friction of its own joint") {
    const double angle = 45.0 * kPi / 180.0;
    for (const std::uint64_t seed : {1U, 2U, 3U}) {
        CAPTURE(seed);
        Model model = make_lying_block(reference_wood());
        model.scatter = {.friction = 0.15, .seed = seed};
        model.gravity = tilted_gravity(angle);
        const double friction = find_joint_of_blocks(model, 0, std::nullopt).friction;
        REQUIRE(std::abs(friction / reference_wood().friction - 1.0) > 0.01);
        Simulation s(model, 0.25 * compute_critical_time_step(model));
        advance_to(s, 0.05);
        const double v0 = s.velocity(0).x(), t0 = s.time();
        advance_to(s, 0.15);
        const double expected = kGravity * (std::sin(angle) - friction * std::cos(angle));
        // what is left of the vertical ringing after 50 ms changes friction by less than 1e-6, as without scatter
        CHECK(std::abs((s.velocity(0).x() - v0) / (s.time() - t0) - expected) < 1e-6 * kGravity);
    }
}

TEST_CASE("joints that scatter give the same bits with one and two threads, and after a restart") {
    const Model model = make_scattered_wall();
    const double step = 0.8 * compute_critical_time_step(model);
    Simulation one(model, step, 1), two(model, step, 2);
    CHECK(two.threads() == 2);
    one.advance(150);
    std::stringstream state;
    one.save(state);
    one.advance(150);
    two.advance(300);
    CHECK(one.energy().friction_loss > 0.0);
    CHECK(one.state_hash() == two.state_hash());
    Simulation restarted = Simulation::restore(model, state);
    restarted.advance(150);
    CHECK(restarted.state_hash() == one.state_hash());

    // the scatter changes the motion
    Model even = model;
    even.scatter = {};
    Simulation other(even, step, 1);
    other.advance(300);
    CHECK(other.energy().friction_loss != one.energy().friction_loss);
}

TEST_CASE("a model's hash knows its scatter, and no seed of none") {
    Model model = make_running_bond(wood(), 2, 3, 4);
    const auto hash = [&](const JointScatter& scatter) {
        model.scatter = scatter;
        return hash_model(model, 1e-6);
    };
    const std::uint64_t none = hash({});
    CHECK(hash({.friction = 0.0, .seed = 7}) == none);
    CHECK(hash({.friction = 0.1, .seed = 7}) != none);
    CHECK(hash({.friction = 0.1, .seed = 8}) != hash({.friction = 0.1, .seed = 7}));
    CHECK(hash({.friction = 0.2, .seed = 7}) != hash({.friction = 0.1, .seed = 7}));
}

// λ_L = 1/16, λ_t = 1/4, λ_k = λ_L²: every factor is a power of two.
TEST_CASE("a wall whose joints scatter and its model at 1:16 move alike to the last bit") {
    Model prototype = make_running_bond(wood(), 2, 3, 4);
    prototype.scatter = {.friction = 0.1, .seed = 5};
    Stone small = wood();
    small.size /= 16.0;
    small.normal_stiffness /= 256.0;
    small.shear_stiffness /= 256.0;
    Model model = make_running_bond(small, 2, 3, 4);
    model.scatter = prototype.scatter;
    prototype.ground.motion.shift[0] = velocity_step(1.0);
    model.ground.motion.shift[0] = velocity_step(0.25);
    Simulation large(prototype, 0x1p-17), scaled(model, 0x1p-19);
    large.advance(400);
    scaled.advance(400);
    CHECK(large.energy().friction_loss > 0.0);
    bool same = true;
    for (std::size_t i = 0; i < prototype.blocks.size(); ++i) same = same && large.position(i) == 16.0 * scaled.position(i);
    CHECK(same);
}

TEST_CASE("a scatter that would leave a joint without friction is refused") {
    Model model = make_running_bond(wood(), 2, 3, 4);
    for (const double friction : {-0.1, 0.25, std::nan("")}) {
        model.scatter.friction = friction;
        CHECK_THROWS_AS(Simulation(model, 1e-6), std::invalid_argument);
    }
}
