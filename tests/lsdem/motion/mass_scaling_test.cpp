#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <sstream>
#include <string>
#include <utility>

#include "lsdem/detail/instructions.hpp"
#include "lsdem/motion/settling_simulation.hpp"
#include "lsdem/time_step.hpp"
#include "tests/support/heaps.hpp"
#include "tests/support/models.hpp"
#include "tests/support/relative.hpp"

using namespace musim::lsdem;
using namespace musim::lsdem::tests;

namespace {

/// About the frequency parameter of these blocks: they tip and come to rest soonest, see choose_damping_rate [1/s].
constexpr double kRate = 20.0;

constexpr double kStride = 4.0;

/// A pyramid of three layers whose blocks differ in height by up to a hundredth and hang that far above each other: they fall, meet on
/// edges and corners, tip and lean.
Model make_dropped_pyramid(const Stone& stone = wood()) {
    Model model = make_model(stone);
    const double height = stone.size.z();
    for (int layer = 0; layer < 3; ++layer) {
        for (int i = 0; i + layer < 3; ++i) {
            const double x = 1.25 * stone.size.x() * (i + 0.5 * layer), y = 0.125 * stone.size.y() * (i % 2);
            Block block = make_block(stone, {x, y, (layer + 0.5) * height + 0.015625 * (layer + 1) * height});
            block.height_offset = 0.0078125 * height * ((i + 2 * layer) % 3 - 1);
            model.blocks.push_back(block);
        }
    }
    return model;
}

SettlingSimulation begin(const Model& model, Inertia inertia, int threads = 1) {
    return {Simulation(model, kStride * 0.8 * compute_critical_time_step(model), threads), kRate, inertia};
}

double liveliest(const Simulation& s) {
    double speed = 0.0;
    for (std::size_t i = 0; i < s.model().blocks.size(); ++i) speed = std::max(speed, s.velocity(i).norm());
    return speed;
}

std::string save_state(const Simulation& s) {
    std::ostringstream out;
    s.save(out);
    return out.str();
}

/// Wood sixteen times as large: of the same density, with overlaps in proportion, so that times go with the root of the length.
Stone large_wood() {
    Stone stone = wood();
    stone.size *= 16.0;
    stone.normal_stiffness *= 256.0;
    stone.shear_stiffness *= 256.0;
    return stone;
}

}  // namespace

TEST_CASE("blocks with mass scaling come to rest in steps in which with their own they do not") {
    const Model pyramid = make_dropped_pyramid();
    double weight = 0.0;
    for (const Block& block : pyramid.blocks) weight += block.mass * kGravity;

    SettlingSimulation settling = begin(pyramid, Inertia::as_stable);
    const Simulation& s = settling.state();
    settling.advance(60000);
    REQUIRE_FALSE(s.divergence().has_value());
    CHECK(s.base_reaction().z() == relative(weight, 1e-6));
    CHECK(liveliest(s) < 1e-6 * std::sqrt(kGravity * wood().size.z()));

    SettlingSimulation own_inertia = begin(pyramid, Inertia::own);
    own_inertia.advance(60000);
    const Simulation& own = own_inertia.state();
    CHECK((own.divergence().has_value() || liveliest(own) > 1e-3 * std::sqrt(kGravity * wood().size.z())));
}

// Of n blocks the contact below block i, from 0, carries n − i weights: an overlap of (n − i) m g/k_n, whatever inertia they had on their
// way.
TEST_CASE("a column with mass scaling stands as deep as its springs say") {
    const Stone stone = wood();
    constexpr std::size_t kBlocks = 6;
    Model column = make_resting_column(stone, kBlocks);
    for (Block& block : column.blocks) block.position.z() += 1e-3 * stone.size.z();
    SettlingSimulation settling = begin(column, Inertia::as_stable);
    const Simulation& s = settling.state();
    settling.advance(40000);
    REQUIRE_FALSE(s.divergence().has_value());
    double height = 0.0;
    const double unit = stone.weight() / stone.normal_stiffness;
    for (std::size_t i = 0; i < kBlocks; ++i) {
        height += stone.size.z() - static_cast<double>(kBlocks - i) * unit;
        // heights are known to their rounding
        CHECK(std::abs(s.position(i).z() + 0.5 * stone.size.z() - height) < 1e-3 * unit);
    }
}

// Far from the ground and without weight, two blocks that touch drift along: nothing pushes them but what they are given, which was at
// rest.
TEST_CASE("inertia is added at rest: momenta stay, velocities fall, and the energy balance knows") {
    const Stone stone = wood();
    Model model = make_model(stone);
    model.gravity.setZero();
    const double speed = 0.1 * std::sqrt(kGravity * stone.size.z());
    for (const double side : {-1.0, 1.0}) {
        Block block = make_block(stone, {0.0, 0.0, (10.0 + 0.5000001 * side) * stone.size.z()});
        block.velocity = {speed, 0.0, -0.01 * side * speed};
        block.angular_velocity.z() = speed / stone.size.x();
        model.blocks.push_back(block);
    }
    SettlingSimulation settling = begin(model, Inertia::as_stable);
    const Simulation& s = settling.state();
    const double start = s.energy().mechanical();
    settling.advance(20);
    const auto sum_of_speeds = [&] { return s.velocity(0).x() + s.velocity(1).x(); };
    const double slowed = sum_of_speeds();
    CHECK(slowed > 0.0);
    CHECK(slowed < 1.2 * speed);
    CHECK(s.angular_velocity(0).z() * stone.size.x() == relative(0.5 * slowed, 1e-3));
    settling.advance(100);
    CHECK(sum_of_speeds() == relative(slowed * std::exp(-100.0 * kRate * s.time_step()), 1e-3));
    CHECK(s.energy().mechanical() < 0.5 * start);
    CHECK(std::abs(s.energy().balance() - start) < 0.01 * start);
}

// While contacts last, what dampers, damping and mass scaling take is all that is lost.
TEST_CASE("the energy balance closes with mass scaling, and when it ends") {
    Stone stone = wood();
    stone.restitution = 1.0;
    // so heavy that no contact opens, also where mass scaling pushes on
    Model model = make_resting_column(stone, 5, false, 100.0 * kGravity);
    for (Block& block : model.blocks) block.velocity.z() = -2e-4;
    SettlingSimulation settling = begin(model, Inertia::as_stable);
    const Simulation& s = settling.state();
    const double start = s.energy().balance();
    for (int look = 0; look < 20; ++look) {
        settling.advance(37);
        CHECK(std::abs(s.energy().balance() - start) < 1e-5 * std::abs(s.energy().preparation_loss));
    }
    CHECK(std::move(settling).finish().energy().preparation_loss == 0.0);
}

TEST_CASE("in the steps of a run hardly anything is added, and motion is that of own inertia") {
    // one block that falls on the ground upright: a bounce, of contact times that its own mass sets
    Model model = make_model(wood());
    model.blocks.push_back(make_block(wood(), {0.0, 0.0, 0.501 * wood().size.z()}));
    const double dt = 0.1 * compute_critical_time_step(model);
    SettlingSimulation own(Simulation(model, dt), kRate), added(Simulation(model, dt), kRate, Inertia::as_stable);
    for (SettlingSimulation* s : {&own, &added}) s->advance(20000);
    CHECK(own.state().state_hash() == added.state().state_hash());
}

TEST_CASE("a preparation with mass scaling goes on from a saved state to the same bits, with any number of threads") {
    const Model pyramid = make_dropped_pyramid();
    SettlingSimulation whole = begin(pyramid, Inertia::as_stable), relay = begin(pyramid, Inertia::as_stable);
    for (const std::uint64_t steps : {1U, 50U, 333U, 64U, 1000U, 700U}) {
        std::istringstream in(save_state(relay.state()));
        relay = SettlingSimulation(Simulation::restore(pyramid, in));
        whole.advance(steps);
        relay.advance(steps);
        CHECK(save_state(relay.state()) == save_state(whole.state()));
    }
    CHECK(whole.state().statistics().rebuilds > 2);

    const Model bond = make_running_bond(wood(), 8, 12, 9);
    std::string alone;
    for (const int threads : {1, 2, 3}) {
        SettlingSimulation settling = begin(bond, Inertia::as_stable, threads);
        const Simulation& s = settling.state();
        REQUIRE(s.threads() == threads);
        settling.advance(200);
        if (threads == 1) alone = save_state(s);
        CHECK(save_state(s) == alone);
    }
}

TEST_CASE("wide and plain instructions add the same inertia") {
    std::string plain;
    for (const auto most : {musim::lsdem::detail::Instructions::plain, musim::lsdem::detail::Instructions::avx512}) {
        musim::lsdem::detail::limit_instructions(most);
        SettlingSimulation settling = begin(make_dropped_pyramid(), Inertia::as_stable);
        const Simulation& s = settling.state();
        settling.advance(3000);
        if (plain.empty()) plain = s.state_hash();
        CHECK(s.state_hash() == plain);
    }
}

TEST_CASE("mass scaling has no size of its own: sixteen times as large is the same to the bit") {
    const Model small = make_dropped_pyramid(), large = make_dropped_pyramid(large_wood());
    SettlingSimulation settling_a = begin(small, Inertia::as_stable);
    const Simulation& a = settling_a.state();
    SettlingSimulation settling_b(Simulation(large, 4.0 * a.time_step()), 0.25 * kRate, Inertia::as_stable);
    const Simulation& b = settling_b.state();
    REQUIRE(b.time_step() == kStride * 0.8 * compute_critical_time_step(large));
    settling_a.advance(3000);
    settling_b.advance(3000);
    for (std::size_t i = 0; i < small.blocks.size(); ++i) {
        CHECK(b.position(i) == 16.0 * a.position(i));
        CHECK(b.orientation(i).coeffs() == a.orientation(i).coeffs());
    }
}
