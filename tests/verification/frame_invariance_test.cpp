#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "lsdem/motion/simulation.hpp"
#include "lsdem/time_step.hpp"
#include "tests/support/models.hpp"
#include "tests/support/motion.hpp"

using namespace musim::lsdem;
using namespace musim::lsdem::tests;

namespace {

constexpr double kDuration = 0.03;  ///< [s]: slips, rocks and twists, but ends before rounding has grown by much

/// Three wood blocks, each shifted against the one below, so that they rock about both axes and twist.
Model make_crooked_column() {
    Model model = make_resting_column(wood(), 3);
    model.blocks[1].position += Vector3(0.0011, -0.0023, 0.0);
    model.blocks[2].position += Vector3(-0.0007, 0.0031, 0.0);
    return model;
}

/// Largest difference of the blocks' positions relative to the base, over the largest displacement; `turn` takes the second to the first.
double compare_motions(const Model& first, const Model& second, const Matrix3& turn) {
    const double step = 0.8 * compute_critical_time_step(first);
    const auto steps = static_cast<std::uint64_t>(kDuration / step);
    Simulation a(first, step), b(second, step);
    a.advance(steps);
    b.advance(steps);
    double difference = 0.0, moved = 0.0;
    for (std::size_t i = 0; i < first.blocks.size(); ++i) {
        const Vector3 from_base = a.position(i) - a.base().displacement;
        difference = std::max(difference, (from_base - turn * (b.position(i) - b.base().displacement)).norm());
        moved = std::max(moved, (from_base - first.blocks[i].position).norm());
    }
    REQUIRE(moved > 0.05 * wood().size.x());
    return difference / moved;
}

}  // namespace

// Rounding (1e-16 m in a height of 0.1 m, 1e-9 of an overlap) is all that may differ; contacts that open and close amplify it.
TEST_CASE("an accelerated base and a body force give the same relative motion") {
    Model shaken = make_crooked_column(), pushed = make_crooked_column();
    const double acceleration = 0.7 * kGravity;
    shaken.ground.motion.shift[0] = constant_acceleration(acceleration, 2.0 * kDuration);
    pushed.gravity.x() = -acceleration;
    // the scheme follows a constant acceleration exactly
    CHECK(compare_motions(shaken, pushed, Matrix3::Identity()) < 1e-7);
}

TEST_CASE("turning everything by 90 degrees about the vertical turns the motion") {
    const Matrix3 turn = (Matrix3() << 0.0, 1.0, 0.0, -1.0, 0.0, 0.0, 0.0, 0.0, 1.0).finished();  // turned back to original
    Model original = make_crooked_column();
    original.gravity.x() = -0.7 * kGravity;
    Model other = original;
    const Stone stone = turned(wood());
    other.shapes[0] = make_box_shape(stone.size, make_node_lattice(stone.size, stone.nodes_per_face));
    other.gravity = turn.transpose() * original.gravity;
    for (Block& block : other.blocks) block.position = turn.transpose() * block.position;
    CHECK(compare_motions(original, other, turn) < 1e-7);
}

TEST_CASE("a mirror image moves as the mirror image") {
    const Matrix3 mirror = Vector3(-1.0, 1.0, 1.0).asDiagonal();
    Model original = make_crooked_column();
    original.gravity.x() = -0.7 * kGravity;
    Model other = original;
    other.gravity = mirror * original.gravity;
    for (Block& block : other.blocks) block.position = mirror * block.position;
    CHECK(compare_motions(original, other, mirror) < 1e-7);
}
