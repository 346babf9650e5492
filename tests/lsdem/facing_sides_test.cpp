#include "lsdem/facing_sides.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

#include "lsdem/motion/simulation.hpp"
#include "lsdem/solid/basic_solids.hpp"
#include "lsdem/solid/bearing_side.hpp"
#include "lsdem/time_step.hpp"

using namespace musim::lsdem;

namespace {

Model make_stones(const Solid& solid, bool ground, double friction = 0.6) {
    Model model;
    model.shapes.push_back(make_solid_shape(solid));
    Material stone;
    stone.normal_stiffness = 1e9, stone.shear_stiffness = 0.8e9, stone.friction = friction, stone.restitution = 0.3;
    model.materials.push_back(stone);
    model.ground.material = stone;
    model.ground.present = ground;
    model.gravity = {0.0, 0.0, -9.80665};
    return model;
}

Block& add(Model& model, const Vector3& position, const Quaternion& orientation = Quaternion::Identity()) {
    Block block;
    block.mass = 2400.0 * model.shapes[0].volume;
    block.position = position, block.orientation = orientation;
    return model.blocks.emplace_back(block);
}

std::size_t count(const std::vector<bool>& sides) { return static_cast<std::size_t>(std::count(sides.begin(), sides.end(), true)); }

constexpr double kInner = 0.925, kOuter = 1.075, kDepth = 0.4;

/// Half a circle of nine voussoirs between two that are held, of radius 1 m about a height [m].
Model make_arch(double height, bool ground, double friction = 0.6) {
    constexpr int kVoussoirs = 9;
    const double half = 0.5 * std::numbers::pi / kVoussoirs, c = std::cos(half), s = std::sin(half);
    const std::vector<Eigen::Vector2d> outline = {
        {kInner * c, -kInner * s}, {kOuter * c, -kOuter * s}, {kOuter * c, kOuter * s}, {kInner * c, kInner * s}};
    const Solid drawn = make_prism(outline, kDepth);
    const Matrix3 upright = Eigen::AngleAxisd(0.5 * std::numbers::pi, Vector3::UnitX()).toRotationMatrix();
    Model model = make_stones(moved(drawn, {upright, Vector3::Zero()}), ground, friction);
    const Placing own = model.shapes[0].own.inverse();
    for (int i = -1; i <= kVoussoirs; ++i) {
        const Quaternion turn(Eigen::AngleAxisd(-(2.0 * i + 1.0) * half, Vector3::UnitY()));
        add(model, turn * own.position + height * Vector3::UnitZ(), turn * Quaternion(own.rotation)).fixed = i < 0 || i == kVoussoirs;
    }
    return model;
}

/// Largest opening of the balance, over the energy put in [-].
double find_opening(Simulation& simulation, std::size_t steps) {
    const Energy start = simulation.energy();
    double open = 0.0, released = 0.0;
    for (std::size_t i = 0; i < steps && !simulation.divergence(); i += 8) {
        simulation.advance(8);
        const Energy now = simulation.energy();
        open = std::max(open, std::abs(now.balance() - start.balance()));
        released = std::max(released, start.gravitational - now.gravitational);
    }
    return open / (start.kinetic + released);
}

}  // namespace

TEST_CASE("voussoirs of an arch may bear on their joints only, whatever their other sides cost") {
    const Model arch = make_arch(0.0, false);
    const std::vector<std::vector<bool>> sides = find_facing_sides(arch);
    const std::vector<BearingSide> bearing = find_bearing_sides(*arch.shapes[0].solid);
    CHECK(sides.front().empty());  // held
    for (std::size_t i = 1; i + 1 < arch.blocks.size(); ++i) {
        REQUIRE(sides[i].size() == bearing.size());
        CHECK(count(sides[i]) == 2);
        for (std::size_t f = 0; f < bearing.size(); ++f) {
            if (sides[i][f]) CHECK(bearing[f].area() == doctest::Approx((kOuter - kInner) * kDepth).epsilon(1e-12));
        }
    }
    // a block before which nothing stands may bear on its extrados, whose springs are 2 · 1.075 sin(10°)/0.15 = 2.49 times as stiff
    Model alone = arch;
    alone.blocks = {arch.blocks[5]};
    CHECK(count(find_facing_sides(alone).front()) == 6);
    const double gain = compute_critical_time_step(arch) / compute_critical_time_step(alone);
    CHECK(gain > 1.2);
    CHECK(gain < std::sqrt(2.49) * 1.01);
}

TEST_CASE("an arch whose voussoirs are hit keeps its energy, and one that slides apart lands in substeps") {
    Model hit = make_arch(0.0, false);
    for (std::size_t i = 0; i < hit.blocks.size(); ++i) {
        if (!hit.blocks[i].fixed) hit.blocks[i].velocity = {i % 2 == 0 ? 0.2 : -0.2, 0.0, i % 3 == 0 ? 0.1 : -0.1};
    }
    Simulation stands(hit, 0.95 * compute_critical_time_step(hit));
    CHECK(find_opening(stands, 2000) < 1e-2);
    CHECK_FALSE(stands.divergence());
    CHECK_FALSE(stands.statistics().leaving);

    const Model slippery = make_arch(1.5, true, 0.02);
    Simulation falls(slippery, 0.8 * compute_critical_time_step(slippery));
    CHECK(find_opening(falls, static_cast<std::size_t>(1.2 / falls.time_step())) < 1e-2);
    CHECK_FALSE(falls.divergence());
    REQUIRE(falls.statistics().leaving);
    CHECK(falls.statistics().leaving->substeps > 1);
}

TEST_CASE("drums may bear on their ends, and on sides that come down within the turn of a block in place") {
    Model column = make_stones(make_drum(0.25, 0.4, 24, 0.25), true);
    for (int i = 0; i < 3; ++i) add(column, {0.0, 0.0, 0.4 * (i + 0.5)});
    const std::vector<std::vector<bool>> sides = find_facing_sides(column);
    CHECK(count(sides[0]) == 2);
    CHECK(count(sides[1]) == 2);
    CHECK(count(sides[2]) == 1);

    // on one of its flats: that, and two on either side at 15° and 30°
    Model lying = make_stones(make_drum(0.25, 0.4, 24, 0.25), true);
    const Quaternion over(Eigen::AngleAxisd(0.5 * std::numbers::pi, Vector3::UnitX()));
    const double half_flat = std::numbers::pi / 24.0;
    add(lying, {0.0, 0.0, 0.25}, over * Quaternion(Eigen::AngleAxisd(half_flat, Vector3::UnitZ())));
    const std::size_t down = count(find_facing_sides(lying)[0]);
    CHECK(down >= 5);
    CHECK(down <= 6);
}

TEST_CASE("a side that something stands before may bear, near and not far") {
    for (const double gap : {0.001, 0.25, 0.5}) {
        CAPTURE(gap);
        Model pair = make_stones(make_box_solid({0.4, 0.4, 0.4}), true);
        add(pair, {0.0, 0.0, 0.2});
        add(pair, {0.4 + gap, 0.0, 0.2});
        // the base, and the side towards the other within 0.77 of an edge
        CHECK(count(find_facing_sides(pair)[0]) == (gap < 0.308 ? 2 : 1));
    }
}
