#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "lsdem/contact/overlap.hpp"
#include "lsdem/motion/simulation.hpp"
#include "lsdem/solid/basic_solids.hpp"
#include "lsdem/solid/compound.hpp"
#include "lsdem/solid/convex_hull.hpp"
#include "lsdem/time_step.hpp"
#include "tests/support/models.hpp"
#include "tests/support/motion.hpp"
#include "tests/support/relative.hpp"
#include "tests/support/solids.hpp"

using namespace musim::lsdem;
using namespace musim::lsdem::tests;

namespace {

/// The block of a stone as a box, as the hull of its corners, and as a compound of two halves.
struct DrawnForm {
    std::string name;
    Shape shape;
};
std::vector<DrawnForm> make_drawn_forms(const Stone& stone) {
    const Vector3& size = stone.size;
    const Solid box = make_box_solid(size);
    const Vector3 low = -0.5 * size, high = 0.5 * size;
    const std::array halves{make_box_piece(low, {0.1 * size.x(), high.y(), high.z()}),
                            make_box_piece({0.1 * size.x(), low.y(), low.z()}, high)};
    return {{"box", make_box_shape(size, make_node_lattice(size, stone.nodes_per_face))},
            {"polyhedron", make_solid_shape(Solid{{make_convex_hull(box.pieces.front().corners)}})},
            {"two halves", make_solid_shape(make_compound(halves))}};
}

Model with_form(Model model, const DrawnForm& form) {
    model.shapes[0] = form.shape;
    return model;
}

/// A block that stands on another, slides and rocks on it under a pulse of the base.
Model make_shaken_pair(const Stone& stone) {
    Model model = make_resting_column(stone, 2);
    model.ground.motion.shift[0] = full_sine(0.8 * kGravity, 0.06);
    return model;
}

}  // namespace

TEST_CASE("blocks drawn as polyhedra and compounds move as boxes do") {
    const Stone stone = wood();
    const std::vector<DrawnForm> forms = make_drawn_forms(stone);
    std::vector<std::vector<Vector3>> way(forms.size());
    std::vector<std::vector<ContactForce>> forces(forms.size());
    for (std::size_t f = 0; f < forms.size(); ++f) {
        const Model model = with_form(make_shaken_pair(stone), forms[f]);
        Simulation s(model, 0.5 * compute_critical_time_step(make_shaken_pair(stone)));
        for (int k = 0; k < 100; ++k) {
            advance(s, 160);
            way[f].push_back(s.position(1));
            if (k == 50) forces[f] = s.contact_forces();
        }
    }
    double reach = 0.0;
    for (const Vector3& x : way[0]) reach = std::max(reach, (x - way[0][0]).norm());
    REQUIRE(reach > 0.05 * stone.size.x());
    for (std::size_t f = 1; f < forms.size(); ++f) {
        CAPTURE(forms[f].name);
        double apart = 0.0;
        for (std::size_t k = 0; k < way[f].size(); ++k) apart = std::max(apart, (way[f][k] - way[0][k]).norm());
        MESSAGE(forms[f].name << ": " << apart / stone.size.x() << " of the width apart after a way of " << reach / stone.size.x());
        CHECK(apart < 1e-9 * stone.size.x());
        // forces are stiffness times depth, and depths of a part in 1e5 of the size have lost as many digits
        REQUIRE(forces[f].size() == forces[0].size());
        for (std::size_t c = 0; c < forces[0].size(); ++c) {
            CHECK((forces[f][c].force - forces[0][c].force).norm() < 1e-7 * forces[0][c].force.norm());
        }
    }
}

// A block tips when gravity leans by more than b/h. On a bed it tips a little earlier, as only a part of the base bears at the end.
TEST_CASE("a box tips at b over h, whatever it is drawn as") {
    Stone stone = stiffened(wood(), 0.125);
    stone.friction = 2.0;
    const double b = stone.size.x(), h = stone.size.z(), limit = b / h;
    // a part x of the base bears where x³ = 12 (h/2) N/(K w), K w = k_n/b
    const double edge = std::cbrt(6.0 * h * stone.weight() * b / stone.normal_stiffness) / b;
    REQUIRE(edge < 0.04);
    for (const DrawnForm& form : make_drawn_forms(stone)) {
        CAPTURE(form.name);
        const auto tips = [&](double part) {
            Model model = with_form(make_resting_column(stone, 1), form);
            model.gravity = tilted_gravity(std::atan(part * limit));
            Simulation s(model, 0.8 * compute_critical_time_step(model));
            while (s.time() < 0.5 && std::abs(tilt_about_y(s)) < 0.5) advance(s, 16);
            return std::abs(tilt_about_y(s)) >= 0.5;
        };
        CHECK_FALSE(tips(1.0 - 2.0 * edge));
        CHECK(tips(1.0 + 0.5 * edge));
    }
}

// Flat faces push along their normal; sides within the overlap are as near as the face over a strip as wide as the overlap is deep.
TEST_CASE("the push of boxes drawn as polyhedra is along the face at overlaps of 1e-8 to 1e-3 of the edge") {
    const Solid cube = make_box_solid({1.0, 1.0, 1.0});
    const Solid hull{{make_convex_hull(cube.pieces.front().corners)}};
    const Solid halves =
        make_compound(std::array{make_box_piece({-0.5, -0.5, -0.5}, {0.2, 0.5, 0.5}), make_box_piece({0.2, -0.5, -0.5}, {0.5, 0.5, 0.5})});
    std::mt19937_64 random(3);
    std::uniform_real_distribution<double> off(-0.7, 0.7);
    for (const Solid* solid : {&hull, &halves}) {
        for (double overlap = 1e-8; overlap < 2e-3; overlap *= 10.0) {
            for (int i = 0; i < 20; ++i) {
                const Matrix3 world = draw_rotation(random);
                const Vector3 shift(off(random), off(random), 1.0 - overlap);
                PlacedSolid a, b;
                place(*solid, world, Vector3::Zero(), a);
                place(hull, world, world * shift, b);
                OverlapPieces pieces;
                pieces.cut(a, b);
                const OverlapLoad found = sum_load(pieces);
                const double share = (1.0 - std::abs(shift.x())) * (1.0 - std::abs(shift.y()));
                const Vector3 normal = world.col(2);
                const double least = std::min(1.0 - std::abs(shift.x()), 1.0 - std::abs(shift.y()));
                const double tolerance = 1.5 * (overlap / least + 1e-15 / overlap);  // the strip, and rounding over depth
                CHECK(found.force.cross(normal).norm() < tolerance * found.force.norm());
                CHECK(std::abs(found.force.dot(normal) / (share * overlap) - 1.0) < tolerance);
            }
        }
    }
}

namespace {

/// Largest drift of a stack of two blocks over its second half of so many seconds, as a part of their height.
double measure_hour_drift(const DrawnForm& form, const Stone& stone, double duration) {
    Model model = with_form(make_resting_column(stone, 2), form);
    model.gravity = tilted_gravity(std::atan(0.2 * stone.size.x() / stone.size.z()));
    Simulation s(model, 0.8 * compute_critical_time_step(model));
    advance_to(s, 0.5 * duration);
    const std::array start{s.position(0), s.position(1)};
    advance_to(s, duration);
    return std::max((s.position(0) - start[0]).norm(), (s.position(1) - start[1]).norm()) / stone.size.z();
}

}  // namespace

TEST_SUITE("slow") {
    TEST_CASE("a stack drawn as polyhedra, or as compounds, does not drift in an hour") {
        // so soft that an hour has few steps: the stack sinks by four thousandths of a block
        Stone stone{{1.0, 1.2, 1.5}, 2400.0, 0.0, 0.0, 0.6, 0.3, 0.1};
        stone.normal_stiffness = 2.0 * stone.weight() / (4e-3 * stone.size.z());
        stone.shear_stiffness = 0.8 * stone.normal_stiffness;
        for (const DrawnForm& form : make_drawn_forms(stone)) {
            const double drift = measure_hour_drift(form, stone, 3600.0);
            MESSAGE(form.name << " drifts by " << drift << " of its height");
            CHECK(drift < 1e-9);
        }
    }
}
