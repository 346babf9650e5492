#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <random>

#include "lsdem/motion/simulation.hpp"
#include "lsdem/time_step.hpp"
#include "tests/support/heaps.hpp"
#include "tests/support/models.hpp"
#include "tests/support/motion.hpp"
#include "tests/support/relative.hpp"

using namespace musim::lsdem;
using namespace musim::lsdem::tests;

TEST_CASE("a block falls freely along the exact parabola") {
    const Stone stone = wood();
    Model model = make_model(stone);
    model.ground.present = false;
    model.blocks.push_back(make_block(stone, {0.0, 0.0, 1.0}));
    model.blocks[0].velocity = {0.3, -0.2, 1.0};
    Simulation s(model, 1e-5);
    s.advance(20000);
    const double t = s.time();
    const Vector3 exact = model.blocks[0].position + model.blocks[0].velocity * t + 0.5 * model.gravity * t * t;
    // leapfrog is exact for a constant acceleration: 20000 roundings of 1e-16
    CHECK((s.position(0) - exact).norm() < 20000 * 1e-16);
    CHECK((s.velocity(0) - model.blocks[0].velocity - model.gravity * t).norm() < 20000 * 1e-15);
}

namespace {

struct Momenta {
    Vector3 linear = Vector3::Zero(), angular = Vector3::Zero();
    double scale_linear = 0.0, scale_angular = 0.0;  ///< sums of the magnitudes
};

Momenta measure_momenta(const Simulation& s) {
    Momenta sum;
    for (std::size_t i = 0; i < s.model().blocks.size(); ++i) {
        const Block& block = s.model().blocks[i];
        const Vector3 inertia = block.mass * s.model().shapes[block.shape].inertia_over_mass;
        const Quaternion q = s.orientation(i);
        const Vector3 p = block.mass * s.velocity(i), orbital = s.position(i).cross(p);
        const Vector3 spin = q * inertia.cwiseProduct(q.conjugate() * s.angular_velocity(i));
        sum.linear += p;
        sum.angular += orbital + spin;
        sum.scale_linear += p.norm();
        sum.scale_angular += orbital.norm() + spin.norm();
    }
    return sum;
}

}  // namespace

TEST_CASE("blocks that tumble into each other keep linear and angular momentum to rounding") {
    const Model model = make_tumbling_cloud(wood(), 3);
    Simulation s(model, 0.8 * compute_critical_time_step(model));
    const Momenta start = measure_momenta(s);
    std::size_t most_contacts = 0;
    double worst_linear = 0.0, worst_angular = 0.0;
    for (int sample = 0; sample < 100; ++sample) {
        s.advance(50);
        const Momenta now = measure_momenta(s);
        worst_linear = std::max(worst_linear, (now.linear - start.linear).norm() / start.scale_linear);
        worst_angular = std::max(worst_angular, (now.angular - start.angular).norm() / start.scale_angular);
        most_contacts = std::max(most_contacts, s.statistics().contacts);
    }
    REQUIRE(most_contacts > 0);
    REQUIRE(s.energy().damping_loss > 0.0);
    // 20000 substeps, each rounding sums of forces far larger than the momenta they add: the square root of that times 1e-16, with room
    CHECK(worst_linear < 1e-12);
    CHECK(worst_angular < 1e-12);
}

TEST_CASE("the energy balance of a shaken and collapsing pile closes" * doctest::test_suite("slow")) {
    Model model = make_loose_pile(wood(), 4, 3);
    model.ground.motion.shift[0] = sample_velocity(0.4, 400, [](double t) { return 0.1 * std::sin(40.0 * t); });
    model.ground.motion.shift[2] = sample_velocity(0.4, 400, [](double t) { return 0.03 * std::sin(70.0 * t); });
    Simulation s(model, 0.2 * compute_critical_time_step(model));
    const double start = s.energy().balance();
    advance_to(s, 0.25);
    REQUIRE_FALSE(s.divergence().has_value());
    const Energy energy = s.energy();
    const double turnover = energy.friction_loss + energy.damping_loss;
    REQUIRE(turnover > 0.0);
    // 1 %: touching and parting within a step costs (ω0 dt)² of the energy of that contact, ω0 dt = 0.1 here for a whole face
    CHECK(std::abs(energy.balance() - start) < 0.01 * turnover);
}

// A block pushed over the edge of a fixed one tips, falls, hits the ground and comes to rest there.
TEST_CASE("a block that slides off an edge falls to the ground and stays there") {
    const Stone stone = wood();
    Model model = make_model(stone);
    Block table = make_block(stone, {0.0, 0.0, 0.5 * stone.size.z()});
    table.fixed = true;
    model.blocks.push_back(table);
    model.blocks.push_back(make_block(stone, {0.0, 0.0, 1.5 * stone.size.z()}));
    model.blocks[1].velocity.x() = 0.45;
    Simulation s(model, 0.2 * compute_critical_time_step(model));
    const double start = s.energy().balance();
    advance_to(s, 0.8);
    REQUIRE_FALSE(s.divergence().has_value());
    const double thin = stone.size.x();
    // on one of its faces on the ground, beside the table; within the overlap of its weight
    CHECK(s.position(1).x() > thin);
    CHECK(s.position(1).z() > 0.499 * thin);
    CHECK(s.position(1).z() < 0.501 * stone.size.z());
    CHECK(s.velocity(1).norm() < 1e-3);
    CHECK(s.base_reaction().z() == relative(stone.weight(), 1e-3));
    // nothing tunnels: a fall of H at 1 m/s presses k v² of an edge node, 2 % of the height at most
    CHECK(s.statistics().max_overlap_over_height < 0.02);
    const double steps = s.time_step() * std::sqrt(stone.normal_stiffness / stone.mass());
    CHECK(std::abs(s.energy().balance() - start) < steps * steps * s.energy().damping_loss);
}

TEST_CASE("blocks that collide sideways bounce off each other and do not pass through") {
    const Stone stone = wood();
    Model model = make_model(stone);
    model.gravity.setZero();
    model.ground.present = false;
    model.blocks.push_back(make_block(stone, Vector3::Zero()));
    model.blocks.push_back(make_block(stone, {1.5 * stone.size.x(), 0.0, 0.0}));
    model.materials[0].restitution = 1.0;
    model.blocks[0].velocity.x() = 0.8;
    Simulation s(model, 0.2 * compute_critical_time_step(model));
    const double energy = s.energy().kinetic;
    advance_to(s, 0.03);
    // equal masses exchange their velocities; who touches when within a step costs (ω0 dt)² of the energy
    const double steps = s.time_step() * std::sqrt(2.0 * stone.normal_stiffness * stone.size.z() / stone.size.x() / stone.mass());
    CHECK(s.position(1).x() - s.position(0).x() > stone.size.x());
    CHECK(s.velocity(1).x() == relative(0.8, steps * steps));
    CHECK(s.velocity(0).x() + s.velocity(1).x() == relative(0.8, 1e-12));
    CHECK(s.energy().kinetic == relative(energy, steps * steps));
}

namespace {

struct Collision {
    double error = 0.0;    ///< largest error of the energy balance over the energy
    double overlap = 0.0;  ///< largest, over the height
};

/// Two blocks that meet at 0.5 m/s, turned at random.
Collision collide(const Stone& stone, std::uint32_t seed, double fraction_of_limit) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> even(-1.0, 1.0);
    const double apart = 1.05 * stone.size.norm();
    Model model = make_model(stone);
    model.gravity.setZero();
    model.ground.present = false;
    model.blocks.push_back(make_block(stone, Vector3::Zero(), random_orientation(random)));
    const double y = 0.3 * apart * even(random), z = 0.3 * apart * even(random);
    model.blocks.push_back(make_block(stone, {apart, y, z}, random_orientation(random)));
    model.blocks[1].velocity.x() = -0.5;
    Simulation s(model, fraction_of_limit * compute_critical_time_step(model));
    const double energy = s.energy().kinetic;
    Collision collision;
    // looked at as often, whatever the step
    const auto between = static_cast<std::uint64_t>(std::llround(20.0 / fraction_of_limit));
    while (s.time() < 0.08 && !s.divergence()) {
        s.advance(between);
        collision.error = std::max(collision.error, std::abs(s.energy().balance() / energy - 1.0));
    }
    collision.overlap = s.statistics().max_overlap_over_height;
    return collision;
}

}  // namespace

// Corner, edge and face contacts of every kind, one pair at a time.
TEST_CASE("two blocks that collide at random neither gain energy nor pass into each other") {
    int collisions = 0;
    double worst = 0.0, deepest = 0.0;
    for (std::uint32_t seed = 0; seed < 40; ++seed) {
        const Collision collision = collide(wood(), seed, 0.8);
        collisions += collision.overlap > 0.0 ? 1 : 0;
        worst = std::max(worst, collision.error);
        deepest = std::max(deepest, collision.overlap);
    }
    REQUIRE(collisions > 30);
    // of (ω dt)², with the ω of a corner or an edge, far below that of a face: 7e-6 at worst in 400 pairs
    CHECK(worst < 1e-5);
    // a corner stops the energy ½ (m/2) v² within d: (√3 + 1)/16 K d⁴ = 0.7 mJ, 1.1 % of the height; a slanted one deeper
    CHECK(deepest < 0.02);
}

TEST_CASE("the energy balance of colliding blocks closes with the square of the step") {
    Stone stone = wood();
    stone.restitution = 1.0;
    stone.friction = 0.0;
    // in substeps from the start, since both blocks are in the air: of a corner that is many steps in contact
    double errors[2] = {0.0, 0.0};
    for (std::uint32_t seed = 0; seed < 10; ++seed) {
        errors[0] += collide(stone, seed, 0.8).error / 10.0;
        errors[1] += collide(stone, seed, 0.2).error / 10.0;
    }
    CHECK(errors[0] == relative(16.0 * errors[1], 0.05));
}
