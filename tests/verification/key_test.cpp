#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "lsdem/motion/simulation.hpp"
#include "lsdem/solid/compound.hpp"
#include "lsdem/time_step.hpp"
#include "tests/support/models.hpp"
#include "tests/support/motion.hpp"
#include "tests/support/solids.hpp"

using namespace musim::lsdem;
using namespace musim::lsdem::tests;

namespace {

constexpr double kKeyedWidth = 0.4, kKeyedDepth = 0.2, kKeyedHeight = 0.5,
                 kKeyHeight = 0.1;   // of the upper block, and height of the key [m]
constexpr double kKeyWidth = 0.1;    // [m]
constexpr double kKeyedSink = 1e-6;  // of the upper block at rest [m]

/// A block with a key on its top, held, and a block with a slot over it, without friction, in gravity that leans by `angle` along +x.
/// `keyed`: whether the key is there.
Model make_keyed_pair(double angle, bool keyed) {
    Model model;
    model.numerics.skip_rest = false;
    const double half = 0.5 * kKeyedWidth, depth = 0.5 * kKeyedDepth, key = 0.5 * kKeyWidth;
    const Polyhedron foot = make_box_piece({-half, -depth, -0.3}, {half, depth, 0.0});
    const Polyhedron tenon = make_box_piece({-key, -depth, 0.0}, {key, depth, kKeyHeight});
    // the slot is higher than the key, which bears by a side alone, and wider downhill, or a block that turns would jam
    const double roof = 1.2 * kKeyHeight;
    const std::array slotted{make_box_piece({-half, -depth, roof}, {half, depth, kKeyedHeight}),
                             make_box_piece({-half, -depth, 0.0}, {-key, depth, roof}),
                             make_box_piece({1.3 * key, -depth, 0.0}, {half, depth, roof})};
    model.shapes.push_back(make_solid_shape(keyed ? make_compound(std::array{foot, tenon}) : Solid{{foot}}));
    model.shapes.push_back(make_solid_shape(make_compound(slotted)));
    const double mass = 2400.0 * model.shapes[1].volume;
    const double stiffness = mass * kGravity / ((kKeyedWidth - kKeyWidth) * kKeyedDepth * kKeyedSink);
    model.materials.push_back({stiffness, 0.8 * stiffness, 0.0, 0.3, 0.0});
    model.ground.present = false;
    model.gravity = tilted_gravity(angle);
    for (std::size_t i = 0; i < 2; ++i) {
        Block block;
        block.shape = i;
        block.mass = i == 0 ? 2400.0 * model.shapes[0].volume : mass;
        block.fixed = i == 0;
        const Placing body = model.shapes[i].own.inverse();
        block.orientation = Quaternion(body.rotation);
        block.position = body.position;
        model.blocks.push_back(block);
    }
    return model;
}

/// Height of the centre of the upper block over its base [m].
double find_keyed_centre() { return make_keyed_pair(0.0, true).blocks[1].position.z(); }

/// Way and turn by which the upper block has left its place after `duration` [s]: along x [m], in all [rad].
struct LeftPlace {
    double way, turn;
};
LeftPlace let_keyed_go(const Model& model, double duration = 1.0) {
    Simulation s(model, 0.8 * compute_critical_time_step(model));
    const Vector3 start = s.position(1);
    const Matrix3 upright = s.orientation(1).toRotationMatrix();
    double turn = 0.0;
    while (s.time() < duration && turn < 0.05) {
        advance(s, 16);
        turn = std::acos(std::min(1.0, upright.row(2).dot(s.orientation(1).toRotationMatrix().row(2))));
    }
    return {s.position(1).x() - start.x(), turn};
}

}  // namespace

// Without friction the key bears all shear, Q = W sin θ. The upper block lifts when it turns about the lower edge of its base: the key then
// pushes at its upper edge, c above the base, and W cos θ · b/2 = W sin θ · (h − c), h the height of the centre.
TEST_CASE("a key carries shear until the block over it lifts") {
    const double h = find_keyed_centre(), limit = 0.5 * kKeyedWidth / (h - kKeyHeight);
    REQUIRE(limit > 1.2 * 0.5 * kKeyedWidth / h);
    // on a bed only a part x of the base, and as little of the key, bears at the end: x³ = 12 h N/(K w)
    const double edge = std::cbrt(12.0 * h * kKeyedSink / (kKeyedWidth * kKeyedWidth));
    REQUIRE(edge < 0.03);
    const LeftPlace below = let_keyed_go(make_keyed_pair(std::atan((1.0 - 2.0 * edge) * limit), true));
    CHECK(below.turn < edge);
    CHECK(std::abs(below.way) < edge * kKeyedWidth);
    CHECK(let_keyed_go(make_keyed_pair(std::atan((1.0 + 0.5 * edge) * limit), true)).turn >= 0.05);
    // without the key it slides at once, at g sin θ
    constexpr double kGentle = 0.05, kLooseTime = 0.5;
    const LeftPlace loose = let_keyed_go(make_keyed_pair(kGentle, false), kLooseTime);
    CHECK(loose.way == doctest::Approx(0.5 * kGravity * std::sin(kGentle) * kLooseTime * kLooseTime).epsilon(1e-3));
}
