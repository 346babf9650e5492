#include <doctest/doctest.h>

#include <cmath>
#include <cstdint>

#include "lsdem/contact_law.hpp"
#include "lsdem/motion/simulation.hpp"
#include "tests/support/models.hpp"
#include "tests/support/relative.hpp"
#include "tests/support/rocking.hpp"
#include "tests/support/round_bodies.hpp"

using namespace musim::lsdem;
using namespace musim::lsdem::tests;

namespace {

constexpr double kImpactVoxel = 0.05 * kBallRadius;  // [m]
constexpr double kSpacing = 0.03 * kBallRadius;      // of the plate's nodes [m]
constexpr double kDepth = 0.01 * kBallRadius;        // overlap that the stiffness is chosen for [m]
constexpr double kSteps = 400.0;                     // per elastic contact

/// By how much depth and duration of an impact may differ from a smooth bed, relative: the cap is not flat (d/R); a lattice of spacing s
/// sums a cap of radius a to (s/a)², a third of which reaches d and t ∝ K^(-1/3); the grid's sphere is bumpy by h²/(12R), against d.
double bed_tolerance(double radius, double spacing) {
    const double cap_squared = 2.0 * radius * kDepth;
    return kDepth / radius + spacing * spacing / cap_squared / 3.0 + kImpactVoxel * kImpactVoxel / (12.0 * radius * kDepth);
}

/// Stiffness per area for which a sphere of effective mass and radius sinks by kDepth [Pa/m].
double stiffness_for_depth(double mass, double radius, double speed) {
    return 3.0 * mass * speed * speed / (2.0 * kPi * radius * kDepth * kDepth * kDepth);
}

struct GridCollision {
    Model model;
    BedImpact bed;
    Vector3 normal;  ///< from block 1 to block 0
};

/// A sphere just above a plate, both grids; it is the plate's nodes that probe the sphere.
GridCollision make_plate_collision(double friction, double restitution, double speed, double stiffness) {
    GridCollision c{make_empty_model(make_ball_material(stiffness, friction, restitution)), {}, Vector3::UnitZ()};
    const double r = kBallRadius, mass = ball_mass(r);
    add_shape(c.model, make_sphere_shape(r, 400, kImpactVoxel));
    add_block(c.model, 0, mass, {0.013 * r, 0.021 * r, r - sphere_shrinkage(r, kImpactVoxel)}, skew_orientation());
    add_plate(c.model, -r, r, 2.0 * r, kSpacing, kImpactVoxel);
    const Interface law = make_interface(c.model.materials[0], mass, c.model.shapes[0].face_area);
    c.bed = {mass, r, law.normal_stiffness, law.normal_damping, speed};
    c.model.blocks[0].velocity.z() = -speed;
    return c;
}

/// Two spheres, the second at rest, along a line that is no grid's axis. Nodes of both are as dense as those of the plate.
GridCollision make_sphere_collision(double ratio, double friction, double restitution, double speed) {
    const double r0 = kBallRadius, r1 = ratio * r0, m0 = ball_mass(r0), m1 = ball_mass(r1);
    const double mass = m0 * m1 / (m0 + m1), radius = r0 * r1 / (r0 + r1);
    const double stiffness = stiffness_for_depth(mass, radius, speed);
    GridCollision c{make_empty_model(make_ball_material(stiffness, friction, restitution)), {}, Vector3(1.0, 2.0, 2.0) / 3.0};
    const auto nodes = [](double r) { return static_cast<std::size_t>(4.0 * kPi * r * r / (kSpacing * kSpacing)); };
    add_shape(c.model, make_sphere_shape(r0, nodes(r0), kImpactVoxel));
    add_shape(c.model, make_sphere_shape(r1, nodes(r1), kImpactVoxel));
    // the follower, whose grid is probed, is the higher one
    add_block(c.model, 0, m0, (r0 + r1 - sphere_shrinkage(r0, kImpactVoxel)) * c.normal);
    add_block(c.model, 1, m1, Vector3::Zero());
    const double face = std::min(c.model.shapes[0].face_area, c.model.shapes[1].face_area);
    const Interface law = make_interface(c.model.materials[0], mass, face);
    c.bed = {mass, radius, law.normal_stiffness, law.normal_damping, speed};
    c.model.blocks[0].velocity = -speed * c.normal;
    return c;
}

struct Rebound {
    double restitution = 0.0, depth = 0.0, duration = 0.0, balance = 0.0;  ///< [-], [m], [s], over the energy ½ m v²
    Vector3 velocity, other_velocity, spin, other_spin;
};

Rebound collide_grids(const GridCollision& c) {
    Simulation s(c.model, c.bed.duration() / kSteps);
    const double before = s.energy().balance();
    Rebound result;
    for (int i = 0; i < 4 * static_cast<int>(kSteps); ++i) {
        s.advance();
        if (s.statistics().contact_nodes > 0) result.duration += s.time_step();
    }
    REQUIRE(s.statistics().contact_nodes == 0);
    result.velocity = s.velocity(0), result.other_velocity = s.velocity(1);
    result.spin = s.angular_velocity(0), result.other_spin = s.angular_velocity(1);
    result.restitution = c.normal.dot(result.velocity - result.other_velocity) / c.bed.speed;
    const double height = 2.0 * c.model.shapes[c.model.blocks[1].shape].half_extents.z();
    result.depth = s.statistics().max_overlap_over_height * height;
    result.balance = (s.energy().balance() - before) / (0.5 * c.bed.mass * c.bed.speed * c.bed.speed);
    return result;
}

/// The material's e for which the bed gives a sphere on a plate the restitution `wanted` at this speed and stiffness.
double find_material_restitution(double wanted, double speed, double stiffness) {
    return bisect(1e-3, 1.0, 30, [&](double e) { return make_plate_collision(0.0, e, speed, stiffness).bed.restitution() > wanted; });
}

}  // namespace

// [ChungOoi11], normal impacts: of a sphere on a plane, of two equal and of two unequal spheres.
TEST_CASE("an elastic sphere rebounds from a plate at its own speed, in the time of a bed of springs") {
    const double speed = 0.1;
    const GridCollision c = make_plate_collision(0.3, 1.0, speed, stiffness_for_depth(ball_mass(kBallRadius), kBallRadius, speed));
    const Rebound r = collide_grids(c);
    const double within = bed_tolerance(kBallRadius, kSpacing);
    CHECK(r.depth / c.bed.depth() == relative(1.0, within));
    CHECK(r.duration / c.bed.duration() == relative(1.0, within + 2.0 / kSteps));
    // The lattice of nodes lies unevenly about the axis by up to a spacing in a cap of 0.14 R: slopes of the grid's sphere, h/(2R) at a
    // node, over the 70 nodes of the cap. What goes into spin and sideways is second order in that.
    const double slope = 0.5 * kImpactVoxel / kBallRadius;
    CHECK(r.restitution == relative(1.0, slope * slope));
    CHECK(std::hypot(r.velocity.x(), r.velocity.y()) < slope * speed);
    CHECK(r.spin.norm() * kBallRadius < slope * speed);
    // leapfrog: a touch falls anywhere in a step, (ω dt)² of the energy
    CHECK(std::abs(r.balance) < std::pow(kPi / kSteps, 2.0));
}

TEST_CASE("two elastic spheres, equal or not, exchange momentum in the time of a bed of springs") {
    const double speed = 0.1;
    for (const double ratio : {1.0, 1.5}) {
        const GridCollision c = make_sphere_collision(ratio, 0.3, 1.0, speed);
        const Rebound r = collide_grids(c);
        const double within = bed_tolerance(c.bed.radius, kSpacing);
        const double slope = 0.5 * kImpactVoxel / kBallRadius;
        CHECK(r.depth / c.bed.depth() == relative(1.0, within));
        CHECK(r.duration / c.bed.duration() == relative(1.0, within + 2.0 / kSteps));
        CHECK(r.restitution == relative(1.0, slope * slope));
        // v₀' = v₀·(m₀ − m₁)/(m₀ + m₁)
        const double m0 = c.model.blocks[0].mass, m1 = c.model.blocks[1].mass;
        const Vector3 expected = -speed * (m0 - m1) / (m0 + m1) * c.normal;
        CHECK((r.velocity - expected).norm() < slope * speed);
        // rounding of some 10⁵ node forces
        CHECK((m0 * r.velocity + m1 * r.other_velocity + m0 * speed * c.normal).norm() < 1e-10 * m0 * speed);
    }
}

// The material's e holds for a whole face, whose stiffness and damping do not change during contact. Of a bed both grow with the cap, so
// that the loss falls with the speed, 1 − e ∝ v^(1/3) and K^(−1/6): see BedImpact.
TEST_CASE("a damped sphere loses what the dashpots of the bed take") {
    const double speed = 0.1, stiffness = stiffness_for_depth(ball_mass(kBallRadius), kBallRadius, speed);
    const double within = bed_tolerance(kBallRadius, kSpacing);
    const auto check = [&](double material, double v) {
        const GridCollision c = make_plate_collision(0.3, material, v, stiffness);
        const Rebound r = collide_grids(c);
        const double expected = c.bed.restitution(), loss = 1.0 - expected;
        // the loss to the accuracy of the bed; a dashpot that lags by half a step, of its share of the force, as of a block
        const Interface law = make_interface(c.model.materials[0], c.bed.mass, c.model.shapes[0].face_area);
        const double share = law.normal_damping * v / (law.normal_stiffness * c.bed.depth());
        CHECK(std::abs(r.restitution - expected) < within * loss + share * kPi / (2.0 * kSteps));
    };
    for (const double material : {0.02, 0.1, 0.3, 0.5, 0.8}) check(material, speed);
    check(0.1, 0.5 * speed);
    check(0.1, 1.25 * speed);
}

// A firm sphere touches a single node, a spring-dashpot of the node's share of the face: ζ falls with the root of that share, and with it
// all loss. The rebound knows the node's area, but neither the stiffness nor the speed [SchwagerPoeschel07].
TEST_CASE("a sphere that lands on a single node rebounds by the node's share of the damping") {
    const double r = kBallRadius, mass = ball_mass(r), speed = 0.1, material = 0.3, voxel = 0.02 * r;
    for (const double spacing : {r, 0.25 * r}) {
        for (const double depth : {1e-5 * r, 1e-6 * r}) {
            const double area = spacing * spacing;
            // ½ m v² = ½ K A d²
            Model model = make_empty_model(make_ball_material(mass * speed * speed / (area * depth * depth), 0.0, material));
            add_shape(model, make_sphere_shape(r, 1, voxel));
            add_block(model, 0, mass, {0.0, 0.0, r}, skew_orientation());
            model.blocks[0].velocity.z() = -speed;
            // an even number of spacings across: a node in the middle
            add_plate(model, -1.0 * r, r, 2.0 * r, spacing, voxel);
            const double zeta = compute_damping_ratio(material) * std::sqrt(area / model.shapes[0].face_area);
            const double duration = kPi * depth / speed;
            Simulation s(model, duration / kSteps);
            // the grid's sphere is smaller by up to h²/(4R)
            s.advance(static_cast<std::uint64_t>(3.0 * kSteps + voxel * voxel / (4.0 * r) / speed / s.time_step()));
            REQUIRE(s.statistics().contact_nodes == 0);
            const double measured = s.velocity(0).norm() / speed, expected = compute_restitution(zeta);
            // Half a step of lag in the dashpot's share 2ζ of the force. The normal of a grid leans by up to β = h/(2R): the push then
            // passes the centre at Rβ, which spins the sphere and leaves 1 + 3.5β² of its mass to the rebound.
            const double lean = 0.5 * voxel / r;
            CHECK(std::abs(measured - expected) < 2.0 * zeta * kPi / (2.0 * kSteps) + 3.5 * lean * lean * (1.0 + expected));
        }
    }
}

namespace {

/// Oblique impact of a sphere on a plate at 1 m/s downwards: tangential speed and spin that its surface takes up.
void check_gross_sliding(double friction, double wanted, double tangential_speed, double spin_speed) {
    const double speed = 1.0, stiffness = stiffness_for_depth(ball_mass(kBallRadius), kBallRadius, speed);
    const double material = wanted < 1.0 ? find_material_restitution(wanted, speed, stiffness) : 1.0;
    GridCollision c = make_plate_collision(friction, material, speed, stiffness);
    c.model.blocks[0].velocity.x() = tangential_speed;
    c.model.blocks[0].angular_velocity.y() = spin_speed / kBallRadius;
    // slip v_t − Rω that lasts through the contact
    REQUIRE(tangential_speed - spin_speed >= 3.5 * friction * (1.0 + wanted) * speed);
    const Rebound r = collide_grids(c);
    const double push = friction * (1.0 + wanted) * speed, spun = r.spin.y() * kBallRadius - spin_speed;
    // friction's arm is shorter than R by up to d; its impulse is off by the push of a normal that leans by twice the grid's slope h/(2R),
    // averaged over the nodes of the cap, and by that of the restitution
    const double cap_nodes = 2.0 * kPi * kBallRadius * kDepth / (kSpacing * kSpacing);
    const double lean = kImpactVoxel / kBallRadius / std::sqrt(cap_nodes);
    const double within = kDepth / kBallRadius + lean / friction + bed_tolerance(kBallRadius, kSpacing) * (1.0 - wanted);
    CHECK(std::abs(r.velocity.x() - (tangential_speed - push)) < within * push);
    CHECK(std::abs(spun - 2.5 * push) < within * 2.5 * push);
    CHECK(std::abs(r.velocity.y()) < within * push);
}

}  // namespace

// [ChungOoi11], gross sliding: v_t' = v_t − μ(1 + e)v_n, R ω' = 2.5 μ(1 + e)v_n; 2.46 and 1.35 m/s for μ = 0.3, e = 0.8, v_t = 3 v_n.
TEST_CASE("a sphere that strikes a plate obliquely slides through the contact and takes up spin") {
    check_gross_sliding(0.3, 0.8, 3.0, 0.0);
    check_gross_sliding(0.3, 1.0, 3.0, 0.0);
}

TEST_CASE("a spinning sphere that strikes a plate is thrown sideways by its spin") {
    check_gross_sliding(0.3, 0.8, 0.0, -3.0);
    check_gross_sliding(0.3, 1.0, 1.0, -2.0);
}

// The same relations for two bodies, by the impulse P = m_eff(1 + e)v_n: each takes μP sideways and spins up by 2.5 μP/(m R), both the same
// way.
TEST_CASE("unequal spheres that meet obliquely share friction's impulse and spin") {
    const double speed = 1.0, friction = 0.3;
    GridCollision c = make_sphere_collision(1.5, friction, 1.0, speed);
    const Vector3 side = c.normal.cross(Vector3::UnitX()).normalized();
    // while they touch, for 2.8 d/v, they pass each other by 3 v: started by half of that behind, they are aligned half way
    const double passed = 1.5 * speed * c.bed.duration(), apart = c.model.blocks[0].position.norm();
    c.model.blocks[0].position = std::sqrt(apart * apart - passed * passed) * c.normal - passed * side;
    c.model.blocks[0].velocity += 3.0 * speed * side;
    const Rebound r = collide_grids(c);
    const double m0 = c.model.blocks[0].mass, m1 = c.model.blocks[1].mass, impulse = 2.0 * friction * c.bed.mass * speed;
    const Vector3 axis = c.normal.cross(side);
    const double slowed = (3.0 * speed - r.velocity.dot(side)) * m0 / impulse, dragged = r.other_velocity.dot(side) * m1 / impulse;
    const double spun = r.spin.dot(axis) * m0 * kBallRadius / (2.5 * impulse);
    const double other_spun = r.other_spin.dot(axis) * m1 * 1.5 * kBallRadius / (2.5 * impulse);
    // The line of centres turns to both sides by passed/apart: of the impulses that this exchanges, the damped half is second order. The
    // arm of friction is shorter by up to d, and the nodes of the smaller cap meet slopes of the grid that do not cancel.
    const double turn = passed / apart, cap_nodes = 2.0 * kPi * c.bed.radius * kDepth / (kSpacing * kSpacing);
    const double lean = kImpactVoxel / kBallRadius / std::sqrt(cap_nodes);
    const double within = turn + kDepth / kBallRadius + lean / friction;
    CHECK(slowed == relative(1.0, within));
    CHECK(dragged == relative(1.0, within));
    CHECK(spun == relative(1.0, within));
    CHECK(other_spun == relative(1.0, within));
}
