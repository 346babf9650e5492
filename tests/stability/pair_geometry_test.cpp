#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <random>

#include "lsdem/motion/simulation.hpp"
#include "lsdem/scene/detail/overlap.hpp"
#include "tests/stability/scenes.hpp"

using namespace musim::lsdem;
using namespace musim::lsdem::tests;

namespace {

/// Depth to which the two blocks of a model overlap, negative when they are apart [m]: separating axes, independent of the kernel.
double measure_depth(const Model& model) {
    const auto body = [&](std::size_t i) {
        return detail::Body{model.shapes[0].half_extents, model.blocks[i].position, model.blocks[i].orientation.toRotationMatrix()};
    };
    return detail::compute_overlap(body(0), body(1));
}

/// Moves the second block along `direction` until the two overlap by `depth` [m].
void place_at_depth(Model& model, const Vector3& direction, double depth) {
    double inside = 0.0, outside = 2.0 * model.shapes[0].half_extents.norm() + std::abs(depth);
    for (int halving = 0; halving < 50; ++halving) {
        const double middle = 0.5 * (inside + outside);
        model.blocks[1].position = middle * direction;
        (measure_depth(model) > depth ? inside : outside) = middle;
    }
}

/// Numbers of random pairs of equal boxes that carry a force although apart, and none although they overlap.
struct PairCount {
    int apart = 0, ghosts = 0, touching = 0, missed = 0;
    double widest_ghost = 0.0, deepest_missed = 0.0;  ///< [smallest edge]
};

PairCount count_pairs(double deepest) {
    constexpr int kPairs = 5000;
    const Stone stone = wood();
    Model model = make_model(stone);
    model.gravity.setZero();
    model.ground.present = false;
    model.blocks.assign(2, make_block(stone, Vector3::Zero()));
    std::mt19937 random(5);
    std::uniform_real_distribution<double> even(-1.0, 1.0);
    std::normal_distribution<double> normal;
    PairCount count;
    for (int pair = 0; pair < kPairs; ++pair) {
        for (Block& block : model.blocks) block.orientation = random_orientation(random);
        const Vector3 direction = Vector3(normal(random), normal(random), normal(random)).normalized();
        place_at_depth(model, direction, deepest * even(random) * stone.size.x());
        const double depth = measure_depth(model) / stone.size.x();
        const bool pushes = Simulation(model, 1e-6).contact_force(0).norm() > 0.0;
        ++(depth < 0.0 ? count.apart : count.touching);
        if (depth < 0.0 && pushes) ++count.ghosts, count.widest_ghost = std::max(count.widest_ghost, -depth);
        if (depth > 0.0 && !pushes) ++count.missed, count.deepest_missed = std::max(count.deepest_missed, depth);
    }
    MESSAGE("within " << deepest << " of an edge: " << count.ghosts << " of " << count.apart << " pairs apart push, at gaps up to "
                      << count.widest_ghost << "; " << count.missed << " of " << count.touching
                      << " pairs that overlap do not, at depths up to " << count.deepest_missed);
    REQUIRE(count.apart > kPairs / 3);
    REQUIRE(count.touching > kPairs / 3);
    return count;
}

}  // namespace

// Most random pairs meet edge to edge or corner to face.
TEST_SUITE("stability") {
    TEST_CASE("boxes that do not touch exert no force") {
        for (const double deepest : {1e-6, 0.02, 0.3}) CHECK(count_pairs(deepest).ghosts == 0);
    }

    TEST_CASE("boxes that overlap push each other apart") {
        for (const double deepest : {1e-6, 0.02, 0.3}) CHECK(count_pairs(deepest).missed == 0);
    }
}
