#include "lsdem/scene/detail/overlap.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "lsdem/solid/basic_solids.hpp"
#include "tests/support/solids.hpp"

using namespace musim::lsdem;
using namespace musim::lsdem::detail;

namespace {

Body make_box(const Vector3& size, const Vector3& center, const Quaternion& turn = Quaternion::Identity()) {
    return {0.5 * size, center, turn.toRotationMatrix(), false, false};
}

Body make_ball(double radius, const Vector3& center) { return {Vector3::Constant(radius), center, Matrix3::Identity(), true, false}; }

Quaternion turn_about(const Vector3& axis, double angle) { return Quaternion(Eigen::AngleAxisd(angle, axis.normalized())); }

}  // namespace

TEST_CASE("the overlap of two boxes is the depth of the shallowest way out") {
    const Body a = make_box({2.0, 2.0, 2.0}, Vector3::Zero());
    CHECK(compute_overlap(a, make_box({2.0, 2.0, 2.0}, {1.9, 0.5, 0.0})) == doctest::Approx(0.1));
    CHECK(compute_overlap(a, make_box({2.0, 2.0, 2.0}, {2.25, 0.0, 0.0})) == doctest::Approx(-0.25));
    CHECK(compute_overlap(a, make_box({2.0, 2.0, 2.0}, {2.0, 0.0, 0.0})) == 0.0);
    // a cube turned by 45° about z reaches √2 along x
    const double reach = std::numbers::sqrt2;
    CHECK(compute_overlap(a, make_box({2.0, 2.0, 2.0}, {1.0 + reach - 0.03, 0.0, 0.0},
                                      turn_about(Vector3::UnitZ(), std::numbers::pi / 4))) == doctest::Approx(0.03));
}

TEST_CASE("two boxes that only the cross product of edges separates do not overlap") {
    // both stand on an edge, the edges crossed at right angles with a gap of 0.1 between them along z
    const double quarter = std::numbers::pi / 4;
    const Body lower = make_box({2.0, 2.0, 2.0}, Vector3::Zero(), turn_about(Vector3::UnitX(), quarter));
    const double gap = 0.1;
    const Body upper = make_box({2.0, 2.0, 2.0}, {0.0, 0.0, 2.0 * std::numbers::sqrt2 + gap}, turn_about(Vector3::UnitY(), quarter));
    CHECK(compute_overlap(lower, upper) == doctest::Approx(-gap));
}

TEST_CASE("balls overlap balls and boxes by their distance") {
    CHECK(compute_overlap(make_ball(1.0, Vector3::Zero()), make_ball(0.5, {0.0, 1.4, 0.0})) == doctest::Approx(0.1));
    const Body box = make_box({2.0, 2.0, 2.0}, Vector3::Zero());
    CHECK(compute_overlap(box, make_ball(0.5, {0.0, 0.0, 1.3})) == doctest::Approx(0.2));
    // beside a corner the boxes around both meet, the bodies do not
    CHECK(compute_overlap(make_ball(0.5, {1.4, 1.4, 0.0}), box) == doctest::Approx(0.5 - std::hypot(0.4, 0.4)));
    CHECK(compute_overlap(make_ball(0.5, {0.0, 0.0, 0.9}), box) == doctest::Approx(0.6));
}

TEST_CASE("solids overlap solids, boxes and balls by the depth of the shallowest way out") {
    const Solid drum = make_drum(0.5, 1.0, 24, 0.5);
    const auto make_solid_body = [&](const Vector3& center, const Quaternion& turn = Quaternion::Identity()) {
        return Body{{0.51, 0.51, 0.5}, center, turn.toRotationMatrix(), false, false, &drum};
    };
    const double inner = 0.5 * std::cos(std::numbers::pi / 24.0);  // from the axis to a flat
    const Body a = make_solid_body({1.0, 2.0, 3.0});
    CHECK(compute_overlap(a, make_solid_body({1.0, 2.0, 3.9})) == doctest::Approx(0.1));
    CHECK(compute_overlap(make_solid_body({1.0 + 2.0 * inner + 0.2, 2.0, 3.0}), a) == doctest::Approx(-0.2));
    CHECK(compute_overlap(a, make_box({1.0, 1.0, 1.0}, {1.0 + inner + 0.5 - 0.03, 2.0, 3.0})) == doctest::Approx(0.03));
    CHECK(compute_overlap(make_ball(0.5, {1.0, 2.0, 3.75}), a) == doctest::Approx(0.25));
    CHECK(compute_overlap(make_ball(0.5, {1.5 * inner + 1.0, 2.0, 3.0}), a) == doctest::Approx(0.5 - 0.5 * inner));
    // lying on a flat
    const Body lying = make_solid_body({0.0, 0.0, inner - 0.01}, turn_about(Vector3::UnitY(), std::numbers::pi / 2));
    CHECK(compute_depth_in_ground(lying) == doctest::Approx(0.01));
    CHECK(compute_depth_in_ground(make_ball(0.5, {0.0, 0.0, 0.75})) == doctest::Approx(-0.25));
    CHECK(compute_depth_in_ground(make_box({1.0, 1.0, 2.0}, {0.0, 0.0, 0.9})) == doctest::Approx(0.1));
}

TEST_CASE("boxes as solids overlap as deep as boxes") {
    std::mt19937_64 random(1);
    std::uniform_real_distribution<double> share(-1.0, 1.0);
    for (int i = 0; i < 200; ++i) {
        Body a = make_box({1.0, 0.6, 0.8}, Vector3::Zero(), Quaternion(musim::lsdem::tests::draw_rotation(random)));
        Body b = make_box({0.7, 0.9, 0.5}, 0.7 * Vector3(share(random), share(random), share(random)),
                          Quaternion(musim::lsdem::tests::draw_rotation(random)));
        const double of_boxes = compute_overlap(a, b);
        const Solid solid = make_box_solid(2.0 * a.half);
        a.solid = &solid;
        const double of_solids = compute_overlap(a, b);
        CHECK((of_boxes > 0.0) == (of_solids > 0.0));
        if (of_boxes > 0.0) CHECK(of_solids == doctest::Approx(of_boxes).epsilon(1e-13));
    }
}

TEST_CASE("the deepest overlap among many bodies is found, touching ones and fixed pairs are not overlaps") {
    std::vector<Body> bodies;
    for (int i = 0; i < 20; ++i) {
        for (int j = 0; j < 20; ++j) bodies.push_back(make_box({0.1, 0.2, 0.3}, {0.1 * i, 0.2 * j, 0.15}));
    }
    CHECK_FALSE(find_deepest_overlap(bodies));

    bodies[137].center.x() += 0.002;
    bodies[250].center.z() += 0.05;
    bodies[250].center.y() -= 0.007;
    const auto overlap = find_deepest_overlap(bodies);
    REQUIRE(overlap);
    CHECK(overlap->first == 249);
    CHECK(overlap->second == 250);
    CHECK(overlap->depth == doctest::Approx(0.007));

    for (Body& body : bodies) body.fixed = true;
    CHECK_FALSE(find_deepest_overlap(bodies));
}

TEST_CASE("a body much larger than the others is compared with all of them") {
    std::vector<Body> bodies{make_box({100.0, 100.0, 1.0}, {0.0, 0.0, -0.5})};
    for (int i = 0; i < 100; ++i) bodies.push_back(make_box({0.1, 0.1, 0.1}, {0.4 * i, 0.0, 0.05}));
    CHECK_FALSE(find_deepest_overlap(bodies));
    bodies[77].center.z() -= 0.01;
    const auto overlap = find_deepest_overlap(bodies);
    REQUIRE(overlap);
    CHECK(overlap->first == 0);
    CHECK(overlap->second == 77);
}

TEST_CASE("the tolerance follows the size of the blocks") {
    for (const double scale : {1.0, 1.0 / 107.0, 1e6}) {
        CAPTURE(scale);
        const Vector3 size = Vector3(1.0, 2.0, 3.0) * scale;
        const auto overlaps_by = [&](double fraction) {
            const Vector3 place(size.x() * (1.0 - fraction), 0.0, 0.0);
            return find_deepest_overlap({make_box(size, Vector3::Zero()), make_box(size, place)}).has_value();
        };
        CHECK_FALSE(overlaps_by(0.5 * kTouchingTolerance));
        CHECK(overlaps_by(2.0 * kTouchingTolerance));
    }
}
