#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <random>
#include <vector>

#include "lsdem/contact/overlap.hpp"
#include "lsdem/contact/overlap_contact.hpp"
#include "lsdem/solid/basic_solids.hpp"
#include "lsdem/solid/compound.hpp"
#include "lsdem/solid/convex_hull.hpp"
#include "lsdem/solid/solid_gap.hpp"
#include "tests/support/relative.hpp"

using namespace musim::lsdem;
using namespace musim::lsdem::tests;

namespace {

/// A solid and where it stands.
struct Stand {
    Solid solid;
    Placing place;

    PlacedSolid placed() const {
        PlacedSolid result;
        musim::lsdem::place(solid, place.rotation, place.position, result);
        return result;
    }
    Stand turned(const Vector3& by) const {
        return {solid, {Eigen::AngleAxisd(by.norm(), by.normalized()) * place.rotation, place.position}};
    }
    Stand shifted(const Vector3& by) const { return {solid, {place.rotation, place.position + by}}; }
};

struct Found {
    OverlapLoad load;
    ContactArea area;
    double energy = 0.0;
};
Found find(const Stand& a, const Stand& b) {
    const PlacedSolid first = a.placed(), second = b.placed();
    OverlapPieces pieces;
    pieces.cut(first, second);
    return {sum_load(pieces), find_contact_area(pieces, Vector3::Zero()), compute_overlap_energy(first, second, pieces)};
}
double energy_of(const Stand& a, const Stand& b) { return find(a, b).energy; }

Polyhedron box_piece(const Vector3& size, const Vector3& middle) {
    return moved(make_box_solid(size), {Matrix3::Identity(), middle}).pieces.front();
}

/// An L: a leg of 1 x 1 x 3 on the left of a foot of 1 x 1 x 1.
Solid make_l() { return make_compound(std::array{box_piece({1, 1, 3}, {0.5, 0.5, 1.5}), box_piece({1, 1, 1}, {1.5, 0.5, 0.5})}); }

/// A leg of 1 x 1 x 3 with feet on both sides.
Solid make_t() {
    return make_compound(
        std::array{box_piece({1, 1, 3}, {0.5, 0.5, 1.5}), box_piece({1, 1, 1}, {1.5, 0.5, 0.5}), box_piece({1, 1, 1}, {-0.5, 0.5, 0.5})});
}

/// Force and moment against central differences of the energy, as a part of the force; `step`: of the differences [m].
void check_gradient(const Stand& a, const Stand& b, double step, double tolerance) {
    const OverlapLoad load = find(a, b).load;
    REQUIRE(load.force.norm() > 0.0);
    for (int axis = 0; axis < 3; ++axis) {
        const Vector3 by = step * Vector3::Unit(axis);
        const double push = -(energy_of(a, b.shifted(by)) - energy_of(a, b.shifted(-by))) / (2.0 * step);
        CHECK(std::abs(load.force[axis] - push) < tolerance * load.force.norm());
        // about the second body's own origin
        const double twist = -(energy_of(a, b.turned(by)) - energy_of(a, b.turned(-by))) / (2.0 * step);
        const Vector3 moment = load.moment - b.place.position.cross(load.force);
        CHECK(std::abs(moment[axis] - twist) < tolerance * load.force.norm());
    }
}

Matrix3 turn(double angle, const Vector3& axis) { return Eigen::AngleAxisd(angle, axis.normalized()).toRotationMatrix(); }

}  // namespace

TEST_CASE("a box as a solid meets as the box") {
    const Vector3 half(0.2, 0.3, 0.5);
    const Solid solid = make_box_solid(2.0 * half);
    const Solid hull{{make_convex_hull(solid.pieces.front().corners)}};
    for (const double tilt : {0.0, 1e-6, 0.01, 0.3}) {
        const Matrix3 rotation = turn(tilt, {1.0, 0.3, 0.2});
        const Vector3 position(0.05, -0.02, 0.999);
        PlacedSolid box, as_solid, as_hull, other;
        place_box(half, Matrix3::Identity(), Vector3::Zero(), other);
        place_box(half, rotation, position, box);
        place(solid, rotation, position, as_solid);
        place(hull, rotation, position, as_hull);
        OverlapPieces pieces;
        const auto load_of = [&](const PlacedSolid& b) {
            pieces.cut(other, b);
            return sum_load(pieces);
        };
        const OverlapLoad expected = load_of(box);
        REQUIRE(expected.force.norm() > 0.0);
        for (const PlacedSolid* b : {&as_solid, &as_hull}) {
            const OverlapLoad load = load_of(*b);
            // depths are differences of coordinates: rounding over depth
            const double rounding = 64.0 * 2.2e-16 * half.norm() / expected.deepest;
            CHECK((load.force - expected.force).norm() <= rounding * expected.force.norm());
            CHECK((load.moment - expected.moment).norm() <= rounding * expected.force.norm());
        }
    }
}

TEST_CASE("a box of two, three and eight parts meets as the box") {
    const Vector3 size(0.4, 0.6, 1.0);
    std::vector<std::vector<Polyhedron>> cuts(3);
    cuts[0] = {box_piece({0.25, 0.6, 1.0}, {-0.075, 0, 0}), box_piece({0.15, 0.6, 1.0}, {0.125, 0, 0})};
    for (const double z : {-0.35, 0.0, 0.4}) {
        const double height = z < -0.3 ? 0.3 : z > 0.3 ? 0.2 : 0.5, middle = z < -0.3 ? -0.35 : z > 0.3 ? 0.4 : 0.05;
        cuts[1].push_back(box_piece({0.4, 0.6, height}, {0, 0, middle}));
    }
    for (int c = 0; c < 8; ++c) {
        const Vector3 sign((c & 1) != 0 ? 1 : -1, (c & 2) != 0 ? 1 : -1, (c & 4) != 0 ? 1 : -1);
        cuts[2].push_back(box_piece(0.5 * size, 0.25 * sign.cwiseProduct(size)));
    }
    const Stand whole{make_box_solid(size), {}};
    for (const auto& parts : cuts) {
        const Solid compound = make_compound(parts);
        for (const double tilt : {0.0, 1e-3, 0.2}) {
            const Placing place{turn(tilt, {0.4, 1.0, 0.1}), {0.03, 0.05, 0.998}};
            const Stand other{make_box_solid({0.7, 0.5, 1.0}), place};
            const Found found = find({compound, {}}, other), expected = find(whole, other);
            REQUIRE(expected.load.force.norm() > 0.0);
            const double size_of_force = expected.load.force.norm();
            CHECK((found.load.force - expected.load.force).norm() <= 1e-12 * size_of_force);
            CHECK((found.load.moment - expected.load.moment).norm() <= 1e-12 * size_of_force);
            CHECK(found.energy == relative(expected.energy, 1e-9));
            CHECK(found.area.area == relative(expected.area.area, 1e-9));
            CHECK((found.area.arm - expected.area.arm).norm() <= 1e-9);
        }
    }
}

// [vanDerHavenFragkopoulosElliott23] the force is minus the gradient of the energy; central differences of an energy with a continuous
// slope are off by step/depth
TEST_CASE("force and moment are minus the gradient of the energy for solids of any form") {
    const Solid drum = make_drum(0.5, 0.8, 24, 0.5), cone = make_drum(0.5, 0.8, 9, 0.3);
    const Solid block = make_box_solid({1.0, 1.0, 1.0});
    SUBCASE("drums") {
        check_gradient({drum, {}}, {drum, {turn(0.01, {1, 2, 0.3}), {0.03, 0.02, 0.79}}}, 1e-6, 1e-4);
        check_gradient({drum, {}}, {cone, {turn(1.57, {0, 1, 0.1}), {0.1, 0.02, 0.8}}}, 1e-6, 1e-4);
    }
    SUBCASE("a block in the notch of an L, of which both faces and the inner edge are touched") {
        check_gradient({make_l(), {}}, {block, {turn(0.004, {0.2, 1, 0.3}), {1.497, 0.51, 1.496}}}, 1e-6, 1e-4);
    }
    SUBCASE("a T on its head, and legs across") {
        check_gradient({make_t(), {}}, {make_l(), {turn(0.3, {0, 0, 1}), {0.1, 0.2, 2.99}}}, 1e-6, 1e-4);
        check_gradient({make_t(), {}}, {block, {turn(0.01, {1, 0.5, 0.3}), {1.496, 0.4, 1.497}}}, 1e-6, 1e-4);
    }
}

TEST_CASE("bodies that change places get the same load with the opposite sign, to the last bit") {
    const Stand a{make_l(), {}}, b{make_drum(0.5, 0.8, 24, 0.5), {turn(0.02, {1, 2, 0.3}), {1.6, 0.5, 1.395}}};
    const Found ab = find(a, b), ba = find(b, a);
    REQUIRE(ab.load.force.norm() > 0.0);
    CHECK(ab.load.force == -ba.load.force);
    CHECK(ab.load.moment == -ba.load.moment);
    CHECK(ab.area.area == ba.area.area);
}

TEST_CASE("solids four times as large have sixty-four times the load, to the last bit") {
    const auto scaled = [](const Stand& s) -> Stand {
        return {stretched(s.solid, Vector3::Constant(4.0)), {s.place.rotation, 4.0 * s.place.position}};
    };
    const Stand a{make_t(), {}}, b{make_drum(0.5, 0.8, 24, 0.4), {turn(0.02, {1, 2, 0.3}), {1.4, 0.5, 1.395}}};
    const Found one = find(a, b), four = find(scaled(a), scaled(b));
    REQUIRE(one.load.force.norm() > 0.0);
    CHECK(four.load.force == 64.0 * one.load.force);
    CHECK(four.load.moment == 256.0 * one.load.moment);
    CHECK(four.energy == 256.0 * one.energy);
}

TEST_CASE("the force on a block in a notch is continuous when it slides along the faces and over the inner edge") {
    const Stand l{make_l(), {}};
    const double depth = 1e-3;
    // the block's edge goes through the inner edge of the L: no step changes the force by more than its share of the path
    Vector3 before = Vector3::Zero();
    for (int i = -200; i <= 200; ++i) {
        const double s = 2.0 * depth * i / 200.0;
        const Stand block{make_box_solid({1.0, 0.8, 1.0}), {turn(0.01 * s, {0, 1, 0}), {1.5 - s, 0.5, 1.5 - depth + 0.3 * s}}};
        const Vector3 force = find(l, block).load.force;
        if (i > -200) CHECK((force - before).norm() < 3.0 * 0.8 * 0.01 * depth);
        before = force;
    }
}

TEST_CASE("a hull of 400 faces lies on the ground as its lowest faces bear") {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> even(-1.0, 1.0);
    std::vector<Vector3> points;
    while (points.size() < 202) {
        const Vector3 x(even(random), even(random), even(random));
        if (x.norm() > 0.1) points.push_back(x.normalized());
    }
    const Solid hull{{make_convex_hull(points)}};
    REQUIRE(hull.pieces.front().faces.size() == 400);
    const double lowest = -find_reach(hull, -Vector3::UnitZ());
    PlacedSolid ground, body;
    place_half_space(Matrix3::Identity(), Vector3::Zero(), 2.0, ground);
    place(hull, Matrix3::Identity(), {0.0, 0.0, -lowest - 0.05}, body);
    OverlapPieces pieces;
    pieces.cut(ground, body);
    // a slab with room on all sides instead of the half space
    PlacedSolid slab;
    place_box({4.0, 4.0, 1.0}, Matrix3::Identity(), {0.0, 0.0, -1.0}, slab);
    const OverlapLoad on_ground = sum_load(pieces);
    pieces.cut(slab, body);
    const OverlapLoad on_slab = sum_load(pieces);
    CHECK(on_ground.force.z() > 0.0);
    CHECK((on_ground.force - on_slab.force).norm() < 1e-12 * on_slab.force.norm());
    CHECK((on_ground.moment - on_slab.moment).norm() < 1e-12 * on_slab.force.norm());
}

TEST_CASE("the gap of faces is that between boxes that face each other, and no more than the distance of others") {
    const Solid block = make_box_solid({1.0, 1.0, 1.0});
    CHECK(find_gap_of_faces(block, block, {Matrix3::Identity(), {0.2, 0.1, 1.25}}) == doctest::Approx(0.25).epsilon(1e-14));
    CHECK(find_gap_of_faces(block, block, {Matrix3::Identity(), {0.2, 0.1, 0.75}}) == doctest::Approx(-0.25).epsilon(1e-14));
    // corner over corner: the nearest points are apart by the diagonal of what the coordinates leave
    CHECK(find_gap_of_faces(block, block, {Matrix3::Identity(), {1.3, 1.4, 1.0}}) <= std::hypot(0.3, 0.4));
    // of an L the notch is empty
    CHECK(find_gap_of_faces(make_l(), block, {Matrix3::Identity(), {1.75, 0.5, 1.75}}) == doctest::Approx(0.25).epsilon(1e-14));
}
