#include <doctest/doctest.h>

#include <string>
#include <vector>

#include "lsdem/detail/instructions.hpp"
#include "lsdem/motion/simulation.hpp"
#include "lsdem/time_step.hpp"
#include "tests/support/heaps.hpp"
#include "tests/support/models.hpp"
#include "tests/support/motion.hpp"

using namespace musim::lsdem;
using namespace musim::lsdem::tests;

namespace {

/// Two blocks that fall onto an edge and onto each other; their turns are rational, so that no function of a library rounds them.
Model make_falling_pair() {
    const Stone stone = wood();
    Model model = make_model(stone);
    const Quaternion about_x(12.0 / 13.0, 5.0 / 13.0, 0.0, 0.0), about_y(15.0 / 17.0, 0.0, 8.0 / 17.0, 0.0);
    model.blocks.push_back(make_block(stone, {0.0, 0.0, 0.024}, about_x));
    model.blocks.push_back(make_block(stone, {0.001, 0.002, 0.064}, about_y));
    for (Block& block : model.blocks) block.velocity.z() = -1.0;
    return model;
}

}  // namespace

TEST_CASE("one and two and three and four threads give the same bits") {
    const Stone stone = wood();
    Model model = make_running_bond(stone, 8, 12, 9);
    REQUIRE(model.blocks.size() >= 800);
    model.ground.motion.shift[0] = velocity_step(1.0);
    const double step = 0.8 * compute_critical_time_step(model);
    std::string expected;
    for (int threads = 1; threads <= 4; ++threads) {
        CAPTURE(threads);
        Simulation s(model, step, threads);
        CHECK(s.threads() == threads);
        s.advance(300);
        REQUIRE(s.energy().friction_loss > 0.0);
        REQUIRE(s.statistics().rebuilds > 1);
        if (threads == 1) expected = s.state_hash();
        CHECK(s.state_hash() == expected);
    }
}

TEST_CASE("wide and plain instructions give the same bits" * doctest::test_suite("one-thread")) {
    using musim::lsdem::detail::Instructions;
    Model model = make_running_bond(wood(), 2, 3, 4);
    model.ground.motion.shift[0] = velocity_step(1.0);
    const Model pile = make_loose_pile(wood(), 2, 2);
    Model by_nodes = model;
    by_nodes.numerics.face_contact = FaceContact::nodes;
    Model uneven = shortened(model, 0.01);
    for (const Model* scene :
         {static_cast<const Model*>(&model), &pile, static_cast<const Model*>(&by_nodes), static_cast<const Model*>(&uneven)}) {
        const double step = 0.8 * compute_critical_time_step(*scene);
        std::vector<std::string> hashes;
        for (const Instructions most : {Instructions::plain, Instructions::avx2, Instructions::avx512}) {
            musim::lsdem::detail::limit_instructions(most);
            // all this machine has, unless it is limited
            if (most == Instructions::plain) REQUIRE(musim::lsdem::detail::active_instructions() == Instructions::plain);
            Simulation s(*scene, step);
            s.advance(6000);
            hashes.push_back(s.state_hash());
        }
        CHECK(hashes[0] == hashes[1]);
        CHECK(hashes[0] == hashes[2]);
    }
}

// Numbers that other machines, compilers and instructions have to find again. They change with the arithmetic of a step alone; who changes
// that on purpose writes the new ones here.
TEST_CASE("small scenes have the pinned state after 400 steps, with any instructions" * doctest::test_suite("one-thread")) {
    using musim::lsdem::detail::Instructions;
    struct Pinned {
        Model model;
        const char* state;
    };
    Model wall = make_running_bond(wood(), 2, 3, 4);
    wall.ground.motion.shift[0] = velocity_step(1.0);
    Model by_nodes = wall;
    by_nodes.numerics.face_contact = FaceContact::nodes;
    for (const Pinned& scene :
         {Pinned{wall, "fc5fff17b28006ca"}, Pinned{by_nodes, "e41a914ae9f49e09"}, Pinned{make_falling_pair(), "63838277e9d24987"}}) {
        for (const Instructions most : {Instructions::plain, Instructions::avx2, Instructions::avx512}) {
            CAPTURE(static_cast<int>(most));
            musim::lsdem::detail::limit_instructions(most);
            // a power of two: no rounding of the step's own
            Simulation s(scene.model, 0x1p-17);
            s.advance(400);
            CHECK(s.energy().friction_loss > 0.0);
            CHECK(s.state_hash() == std::string(scene.state));
        }
    }
}

TEST_CASE("blocks of unequal height give the same bits with one and with two threads, wide and plain") {
    using musim::lsdem::detail::Instructions;
    Model model = shortened(make_running_bond(wood(), 4, 10, 8), 0.01);
    model.ground.motion.shift[0] = velocity_step(1.0);
    const double step = 0.8 * compute_critical_time_step(model);
    const auto hash = [&](int threads) {
        Simulation s(model, step, threads);
        CHECK(s.threads() == threads);
        s.advance(300);
        REQUIRE(s.energy().friction_loss > 0.0);
        return s.state_hash();
    };
    const std::string expected = hash(1);
    CHECK(hash(2) == expected);
    musim::lsdem::detail::limit_instructions(Instructions::plain);
    CHECK(hash(2) == expected);
    musim::lsdem::detail::limit_instructions(Instructions::avx512);
}

TEST_CASE("the state hash sees one bit of one block") {
    Model model = make_resting_column(wood(), 4);
    const Simulation original(model, 1e-6);
    CHECK(original.state_hash() == Simulation(model, 1e-6).state_hash());
    CHECK(original.state_hash().size() == 16);
    model.blocks[2].position.x() = 1e-300;
    CHECK(Simulation(model, 1e-6).state_hash() != original.state_hash());
}

TEST_CASE("stepping in one go or one by one gives the same bits") {
    const Model model = make_running_bond(wood(), 2, 2, 3);
    const double step = 0.8 * compute_critical_time_step(model);
    Simulation at_once(model, step), one_by_one(model, step);
    at_once.advance(500);
    for (int n = 0; n < 500; ++n) {
        one_by_one.advance();
        // looking does not change anything
        (void)one_by_one.energy();
        (void)one_by_one.kinematics();
    }
    CHECK(at_once.state_hash() == one_by_one.state_hash());
}
