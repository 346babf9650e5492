#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "lsdem/motion/simulation.hpp"
#include "lsdem/time_step.hpp"
#include "tests/support/faces.hpp"
#include "tests/support/heaps.hpp"
#include "tests/support/models.hpp"
#include "tests/support/motion.hpp"
#include "tests/support/relative.hpp"
#include "tests/support/round_bodies.hpp"

using namespace musim::lsdem;
using namespace musim::lsdem::tests;

// The box as a grid against the box in closed form. A trilinear grid is exact where the distance is linear: on a flat face farther than a
// voxel from its edges. Along the edges it is rounded, outwards of the body by up to 0.3 voxels.
namespace {

constexpr double kPaperVoxel = 0.65e-3;  ///< [Harmon23], of wood at 1:107 [m]

Shape as_grid(const Vector3& size, const NodeLattice& lattice, double voxel) { return make_grid_box_shape(size, lattice, voxel); }
Shape as_box(const Vector3& size, const NodeLattice& lattice, double /*voxel*/) { return make_box_shape(size, lattice); }

using MakeShape = Shape (*)(const Vector3&, const NodeLattice&, double);

/// Block 1 upright on block 0, which is held or stands on the ground; block 0 is narrower by `inset` on every side [m].
Model make_stack(MakeShape make, const Stone& stone, double inset) {
    Model model = make_model(stone);
    const NodeLattice lattice = make_node_lattice(stone.size, stone.nodes_per_face);
    const Vector3 narrow = stone.size - Vector3(2.0 * inset, 2.0 * inset, 0.0);
    model.shapes = {make(narrow, lattice, kPaperVoxel), make(stone.size, lattice, kPaperVoxel)};
    add_block(model, 0, stone.density * narrow.prod(), {0.0, 0.0, 0.5 * stone.size.z()});
    add_block(model, 1, stone.mass(), {0.0, 0.0, 1.5 * stone.size.z()});
    return model;
}

constexpr double kOverlap = 1e-6;  ///< of the height [-]

/// Stiffness of the interface between the two blocks over that of a whole face, from the force at an overlap of a millionth of the height.
double interface_stiffness(MakeShape make, const Stone& stone, double inset) {
    Model model = make_stack(make, stone, inset);
    const double overlap = kOverlap * stone.size.z();
    model.ground.present = false;
    model.gravity.setZero();
    model.blocks[1].position.z() -= overlap;
    const Simulation s(model, 0.5 * compute_critical_time_step(model));
    return s.contact_force(1).z() / overlap / stone.normal_stiffness;
}

}  // namespace

TEST_CASE("a grid block carries like a box where the nodes below it stand a voxel inside its edges") {
    const Stone stone = reference_wood();
    const double inset = 1.01 * kPaperVoxel;
    const double area = (stone.size.x() - 2.0 * inset) * (stone.size.y() - 2.0 * inset) / stone.face_area();
    // the overlap, 1e-6 of the height, comes from heights: rounding 1e-16/1e-6, some ten of it
    CHECK(interface_stiffness(as_grid, stone, inset) == relative(area, 1e-9));
    const Vector3 narrow = stone.size - Vector3(2.0 * inset, 2.0 * inset, 0.0);
    CHECK(interface_stiffness(as_box, stone, inset) ==
          relative(flat_stiffness(narrow, kOverlap * stone.size.z(), 1) / stone.face_area(), 1e-9));
}

// Blocks that share their edges: nodes on the edge of the rounded grid do not touch, so the interface is softer, by the share of the
// outermost cells at most. A box in closed form loses what its sides are nearer to than its face.
TEST_CASE("grid blocks stacked edge on edge lose at most the cells on their edges") {
    for (const int nodes : {44, 176, 440}) {
        Stone stone = reference_wood();
        stone.nodes_per_face = nodes;
        const NodeLattice lattice = make_node_lattice(stone.size, nodes);
        const double spacing = std::min(stone.size.x() / (lattice.nx - 1), stone.size.y() / (lattice.ny - 1));
        // rows that stand within a voxel of an edge
        const double lost = 1.0 + std::floor(kPaperVoxel / spacing);
        const double inner = (1.0 - (2.0 * lost - 1.0) / (lattice.nx - 1)) * (1.0 - (2.0 * lost - 1.0) / (lattice.ny - 1));
        const double grid = interface_stiffness(as_grid, stone, 0.0);
        CHECK(grid > inner * (1.0 - 1e-9));
        CHECK(grid < 1.0 + 1e-9);
        CHECK(interface_stiffness(as_box, stone, 0.0) ==
              relative(flat_stiffness(stone.size, kOverlap * stone.size.z(), 2) / stone.face_area(), 1e-9));
    }
}

namespace {

/// A stack on the ground that a half-sine of 1.5 g makes slide on both interfaces.
struct Slid {
    double lower = 0.0, upper = 0.0;  ///< of the blocks against the base [m]
    double tilt = 0.0;                ///< of the upper one [rad]
};

Slid slide_stack(MakeShape make) {
    Stone stone = reference_wood();
    // low blocks, which slide rather than rock
    stone.size = {stone.size.z(), stone.size.y(), stone.size.x()};
    stone.normal_stiffness *= stone.size.x() / stone.size.z();
    stone.shear_stiffness *= stone.size.x() / stone.size.z();
    stone.friction = 0.18;
    Model model = make_stack(make, stone, 3.0 * kPaperVoxel);
    model.ground.material.friction = 0.3;
    model.materials[0].friction = 0.3;
    model.materials.push_back(model.materials[0]);
    model.materials[1].friction = 0.18;
    model.blocks[1].material = 1;
    const double duration = 0.04;
    model.ground.motion.shift[0] = half_sine(1.0 * kGravity, duration);
    Simulation s(model, 0.5 * compute_critical_time_step(model));
    advance_to(s, 2.0 * duration);
    const double base = s.base().displacement.x();
    return {s.position(0).x() - base, s.position(1).x() - base, tilt_about_y(s, 1)};
}

}  // namespace

TEST_CASE("a shaken stack of grid blocks slides as far as one of boxes") {
    const Slid grid = slide_stack(as_grid), box = slide_stack(as_box);
    REQUIRE(std::abs(box.lower) > 1e-3);
    REQUIRE(std::abs(box.upper - box.lower) > 1e-3);
    // Slip depends on friction and weight, not on how the springs are laid out: that only changes how the blocks lean while they slide, by
    // (μ H/b)² of the load. Nodes of the lower block that pass under the edge of the upper one enter whole in a grid, clipped in a box.
    CHECK(grid.lower == relative(box.lower, 2e-3));
    CHECK(grid.upper == relative(box.upper, 2e-3));
}

// Newton: a = g (sin θ − μ cos θ); the nodes of the plate enter and leave under the block, one row at a time.
TEST_CASE("a grid block slides down a grid plate as Coulomb says") {
    const double angle = 40.0 * kPi / 180.0, friction = 0.63, expected = kGravity * (std::sin(angle) - friction * std::cos(angle));
    REQUIRE(expected == relative(1.571362, 1e-6));
    const Vector3 size(0.04, 0.02, 0.008);
    const double voxel = 0.5e-3, spacing = 1e-3, mass = 800.0 * size.prod(), weight = mass * kGravity * std::cos(angle);
    const double sink = 1e-6 * size.z();
    Model model = make_empty_model(make_ball_material(weight / (size.x() * size.y()) / sink, friction, 0.9));
    model.gravity = tilted_gravity(angle);
    add_block(model, add_shape(model, make_grid_box_shape(size, {41, 21, 9}, voxel)), mass, {0.0, 0.0, 0.5 * size.z() - sink});
    add_plate(model, -0.03, 0.05, 0.03, spacing, voxel);
    Simulation s(model, 0.5 * compute_critical_time_step(model));
    const double duration = 0.1;
    advance_to(s, 0.5 * duration);
    const double time_before = s.time(), speed_before = s.velocity(0).x();
    advance_to(s, duration);
    const double x = s.position(0).x(), measured = (s.velocity(0).x() - speed_before) / (s.time() - time_before);
    // At the start friction lags until its springs have given by μ·sink, for sqrt(2μ·sink/g); what the block gains by that, μ g cos θ times
    // it, stays, and sets it ringing by as much.
    const double gained = friction * kGravity * std::cos(angle) * std::sqrt(2.0 * friction * sink / kGravity);
    CHECK(measured == relative(expected, gained / (0.5 * duration) / expected));
    CHECK(std::abs(s.position(0).y()) < 1e-3 * x);
    CHECK(std::abs(tilt_about_y(s)) < 100.0 * sink / size.x());
}

// Corners meet faces, edges meet edges, nodes pass from one face's side to another's: whatever they do, the springs give back no more than
// they took.
TEST_CASE("grid blocks that collide at random create no energy") {
    for (const ContactNodes nodes : {ContactNodes::leader, ContactNodes::both}) {
        const Stone stone = reference_wood();
        Model model = make_tumbling_cloud(stone, 2);
        model.shapes[0] = make_grid_box_shape(stone.size, make_node_lattice(stone.size, stone.nodes_per_face), kPaperVoxel);
        model.numerics.contact_nodes = nodes;
        Simulation s(model, 0.2 * compute_critical_time_step(model));
        const double start = s.energy().balance();
        double most = 0.0;
        while (s.time() < 0.1) {
            advance(s, 50);
            most = std::max(most, s.energy().balance() / start - 1.0);
        }
        REQUIRE(s.energy().damping_loss > 0.1 * start);
        // contacts that touch and part within a step are booked to (ω dt)², and change faces: as of boxes, 1 % of the energy
        CHECK(most < 0.01);
    }
}
