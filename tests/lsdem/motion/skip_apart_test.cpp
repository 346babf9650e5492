#include <doctest/doctest.h>

#include <algorithm>
#include <sstream>

#include "lsdem/motion/settling_simulation.hpp"
#include "lsdem/time_step.hpp"
#include "tests/support/heaps.hpp"
#include "tests/support/models.hpp"
#include "tests/support/motion.hpp"

using namespace musim::lsdem;
using namespace musim::lsdem::tests;

namespace {

/// Runs a model with and without passing over pairs that are apart, and compares all bits on the way.
void check_same_bits(Model model, int looks, std::uint64_t steps_between) {
    const double dt = 0.8 * compute_critical_time_step(model);
    model.numerics.skip_apart = true;
    Simulation skipping(model, dt, 1);
    model.numerics.skip_apart = false;
    Simulation looking(model, dt, 1);
    std::size_t most_apart = 0, most_touching = 0;
    for (int look = 0; look < looks; ++look) {
        skipping.advance(steps_between);
        looking.advance(steps_between);
        CAPTURE(look);
        REQUIRE_FALSE(looking.divergence());
        REQUIRE(skipping.state_hash() == looking.state_hash());
        const Energy a = skipping.energy(), b = looking.energy();
        CHECK(a.friction_loss == b.friction_loss);
        CHECK(a.damping_loss == b.damping_loss);
        CHECK(a.elastic_normal == b.elastic_normal);
        const Statistics statistics = skipping.statistics();
        most_apart = std::max(most_apart, statistics.apart);
        most_touching = std::max(most_touching, statistics.contacts);
        CHECK(looking.statistics().apart == 0);
        CHECK(statistics.contacts == looking.statistics().contacts);
        CHECK(statistics.max_overlap_over_height == looking.statistics().max_overlap_over_height);
    }
    // both have happened
    CHECK(most_apart > model.blocks.size() / 8);
    CHECK(most_touching > model.blocks.size() / 16);
}

}  // namespace

TEST_CASE("passing over pairs that are apart changes no bit of a shaken wall of unequal blocks") {
    Model model = shortened(make_running_bond(wood(), 3, 8, 8), 0.01);
    model.ground.motion.shift[0] = velocity_step(1.0);
    check_same_bits(model, 40, 100);
}

TEST_CASE("passing over pairs that are apart changes no bit of blocks that collide at all angles") {
    check_same_bits(make_tumbling_cloud(wood(), 4), 40, 250);
}

TEST_CASE("passing over pairs that are apart changes no bit of a pile") { check_same_bits(make_loose_pile(wood(), 3, 3), 40, 800); }

TEST_CASE("a saved state knows which pairs are apart and goes on to the same bits") {
    Model model = shortened(make_running_bond(wood(), 3, 8, 8), 0.01);
    model.ground.motion.shift[0] = velocity_step(1.0);
    Simulation straight(model, 0.8 * compute_critical_time_step(model), 1);
    straight.advance(1500);
    REQUIRE(straight.statistics().apart > model.blocks.size() / 8);
    std::stringstream file;
    straight.save(file);
    Simulation restored = Simulation::restore(model, file, 2);
    CHECK(restored.statistics().apart == straight.statistics().apart);
    straight.advance(1500);
    restored.advance(1500);
    CHECK(restored.state_hash() == straight.state_hash());
}

TEST_CASE("a block let go beside others is not passed over for what it was apart before") {
    const Stone stone = wood();
    Model model = make_resting_column(stone, 2);
    Block parked = make_block(stone, model.blocks[1].position + Vector3(0.0, 0.0, 1.001 * stone.size.z()));
    parked.fixed = true;
    model.blocks.push_back(parked);
    const double dt = 0.8 * compute_critical_time_step(model);
    SettlingSimulation settling(Simulation(model, dt, 1), 0.0);
    const Simulation& s = settling.state();
    settling.advance(200);
    REQUIRE(s.statistics().apart == 1);
    const Vector3 top = s.position(1) + Vector3(0.0, 0.0, stone.size.z());
    settling.release({{.block = 2, .position = top}});
    settling.advance(4000);
    CHECK(s.position(2).z() > s.position(1).z() + 0.99 * stone.size.z());
    CHECK(s.statistics().apart == 0);
}
