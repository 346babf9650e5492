#include <doctest/doctest.h>

#include <cmath>
#include <string>

#include "lsdem/motion/simulation.hpp"
#include "lsdem/time_step.hpp"
#include "tests/support/models.hpp"
#include "tests/support/motion.hpp"
#include "tests/support/relative.hpp"
#include "tests/support/round_bodies.hpp"

using namespace musim::lsdem;
using namespace musim::lsdem::tests;

namespace {

constexpr double kSlope = 20.0 * kPi / 180.0;            // of the plane [rad]
constexpr double kRollingOverlap = 0.005 * kBallRadius;  // of the body at rest, d [m]
constexpr double kWay = 3.0 * kBallRadius;               // how far it rolls [m]

/// Half width of the patch, a = sqrt(2Rd) [m].
const double kPatch = std::sqrt(2.0 * kBallRadius * kRollingOverlap);

struct Rolling {
    double acceleration = 0.0;   ///< 2x/t² at the end [m/s²]
    double creepage = 0.0;       ///< 1 − ωR/v, mean over the second half [-]
    double sideways = 0.0;       ///< |y|/x at the end [-]
    double friction_loss = 0.0;  ///< over the work of gravity [-]
    double closure = 0.0;        ///< error of the energy balance over the work of gravity [-]
};

/// Lets block 0 roll kWay down along x, which takes about sqrt(2·kWay/expected).
Rolling roll(const Model& model, double expected) {
    Simulation s(model, 0.2 * compute_critical_time_step(model));
    const double end = std::sqrt(2.0 * kWay / expected), start = s.energy().balance();
    advance_to(s, 0.5 * end);
    const double half_way = s.position(0).x();
    double turned = 0.0;
    while (s.time() < end) {
        turned += s.angular_velocity(0).y() * s.time_step();
        advance(s);
    }
    const Vector3 x = s.position(0);
    const double work = model.blocks[0].mass * kGravity * std::sin(kSlope) * x.x();
    return {2.0 * x.x() / (s.time() * s.time()), 1.0 - kBallRadius * turned / (x.x() - half_way), std::abs(x.y() / x.x()),
            s.energy().friction_loss / work, (s.energy().balance() - start) / work};
}

/// A sphere on a plate in inclined gravity, at its rest height.
Model make_rolling_sphere(double voxel, double spacing) {
    const double r = kBallRadius, mass = ball_mass(r), weight = mass * kGravity * std::cos(kSlope);
    Model model = make_empty_model(make_ball_material(weight / (kPi * r * kRollingOverlap * kRollingOverlap), 0.3, 1.0));
    model.gravity = tilted_gravity(kSlope);
    add_shape(model, make_sphere_shape(r, 400, voxel));
    add_block(model, 0, mass, {0.0, 0.0, r - sphere_shrinkage(r, voxel) - kRollingOverlap}, skew_orientation());
    add_plate(model, -0.5 * r, kWay + 0.5 * r, 0.8 * r, spacing, voxel);
    return model;
}

/// A drum on its side across a plate narrower than itself, its axis along y.
Model make_rolling_drum(double voxel, double spacing) {
    const double r = kBallRadius, height = 2.0 * r, width = 0.8 * height;
    Model model = make_empty_model({});
    add_shape(model, make_cylinder_shape(r, height, {48, 6, 7}, voxel));
    const double mass = kBallDensity * model.shapes[0].volume, weight = mass * kGravity * std::cos(kSlope);
    // a bed of width w: F = ∫K·δ dA = (4/3) K w a d
    model.materials[0] = make_ball_material(weight / (4.0 / 3.0 * width * kPatch * kRollingOverlap), 0.6, 1.0);
    model.gravity = tilted_gravity(kSlope);
    const Quaternion lying(Eigen::AngleAxisd(-0.5 * kPi, Vector3::UnitX())), turn(Eigen::AngleAxisd(0.3, Vector3::UnitY()));
    add_block(model, 0, mass, {0.0, 0.0, r - cylinder_shrinkage(r, voxel) - kRollingOverlap}, turn * lying);
    const std::size_t plate = add_plate(model, -0.5 * r, kWay + 0.5 * r, width, spacing, voxel);
    // across the way the patch is uniform: few rows do
    const NodeLattice few{static_cast<int>(std::ceil((kWay + r) / spacing)) + 1, 5, 2};
    Shape& shape = model.shapes[model.blocks[plate].shape];
    shape = make_grid_box_shape(2.0 * shape.half_extents, few, voxel);
    return model;
}

/// `share`: of gravity that friction takes, 2/7 or 1/3; `creepage` expected.
void check_rolling(const std::string& name, const Rolling& r, double expected, double share, double creepage) {
    INFO(name);
    // The body turns about a point that is higher than its lowest by up to d, and creeps: both change the share that friction takes. At the
    // start the springs of the patch first deform by (T/N)d, a part of the way.
    const double offset = kRollingOverlap / kBallRadius, start = share * std::tan(kSlope) * kRollingOverlap / kWay;
    CHECK(std::abs(r.acceleration / expected - 1.0) < share * (creepage + offset) + start);
    CHECK(std::abs(r.creepage - creepage) < offset);
    // friction only works against creep: T·γv
    CHECK(r.friction_loss < 2.0 * share * (creepage + offset));
    CHECK(std::abs(r.closure) < 1e-4);
}

}  // namespace

// Oracle of [ChungOoi11, Asmar02] and any textbook: (5/7) g sin θ while tan θ ≤ 3.5 μ. The patch of a bed creeps under traction (brush
// model): a node that enters sticks, τ = K_s γ x behind the front edge; sums over the patch give T/N = 4γR/a · K_s/K_n for a sphere.
TEST_CASE("a sphere rolls down a plate at five sevenths of gravity's pull") {
    const double expected = 5.0 / 7.0 * kGravity * std::sin(kSlope);
    REQUIRE(expected == relative(2.396584, 1e-6));
    const Model model = make_rolling_sphere(0.05 * kBallRadius, 0.03 * kBallRadius);
    const double creepage = 2.0 / 7.0 * std::tan(kSlope) * kPatch / (4.0 * kBallRadius);
    const Rolling r = roll(model, expected);
    check_rolling("sphere", r, expected, 2.0 / 7.0, creepage);
    // slopes of the grid, h/(2R) at a node, push it sideways and back
    CHECK(r.sideways < 0.5 * 0.05);
}

// (2/3) g sin θ; of a line of springs T/N = 3γR/a · K_s/K_n.
TEST_CASE("a drum rolls down a plate at two thirds of gravity's pull") {
    const double expected = 2.0 / 3.0 * kGravity * std::sin(kSlope);
    const Model model = make_rolling_drum(0.05 * kBallRadius, 0.015 * kBallRadius);
    const double creepage = std::tan(kSlope) / 3.0 * kPatch / (3.0 * kBallRadius);
    const Rolling r = roll(model, expected);
    check_rolling("drum", r, expected, 1.0 / 3.0, creepage);
    // the plate and the drum are symmetric about y = 0
    CHECK(r.sideways < 1e-3);
}

namespace {

/// The same bodies on the ground, felt with their own nodes: on the side of a drum every 0.02 R around, on a sphere every 0.03 R.
Model make_sphere_on_ground() {
    const double r = kBallRadius, mass = ball_mass(r), weight = mass * kGravity * std::cos(kSlope);
    Model model = make_empty_model(make_ball_material(weight / (kPi * r * kRollingOverlap * kRollingOverlap), 0.3, 1.0));
    model.ground.present = true;
    model.gravity = tilted_gravity(kSlope);
    add_shape(model, make_sphere_shape(r, 14000, 0.2 * r));
    add_block(model, 0, mass, {0.0, 0.0, r - kRollingOverlap}, skew_orientation());
    return model;
}

Model make_drum_on_ground() {
    const double r = kBallRadius, height = 2.0 * r;
    Model model = make_empty_model({});
    model.ground.present = true;
    add_shape(model, make_cylinder_shape(r, height, {314, 6, 5}, 0.2 * r));
    const double mass = kBallDensity * model.shapes[0].volume, weight = mass * kGravity * std::cos(kSlope);
    model.materials[0] = make_ball_material(weight / (4.0 / 3.0 * height * kPatch * kRollingOverlap), 0.6, 1.0);
    model.ground.material = model.materials[0];
    model.gravity = tilted_gravity(kSlope);
    const Quaternion lying(Eigen::AngleAxisd(-0.5 * kPi, Vector3::UnitX())), turn(Eigen::AngleAxisd(0.3, Vector3::UnitY()));
    add_block(model, 0, mass, {0.0, 0.0, r - kRollingOverlap}, turn * lying);
    return model;
}

}  // namespace

// Every quarter turn another body axis points down; a smooth surface must not notice.
TEST_CASE("a sphere and a drum roll down the ground on their own nodes") {
    const double sphere = 5.0 / 7.0 * kGravity * std::sin(kSlope), drum = 2.0 / 3.0 * kGravity * std::sin(kSlope);
    check_rolling("sphere on the ground", roll(make_sphere_on_ground(), sphere), sphere, 2.0 / 7.0,
                  2.0 / 7.0 * std::tan(kSlope) * kPatch / (4.0 * kBallRadius));
    check_rolling("drum on the ground", roll(make_drum_on_ground(), drum), drum, 1.0 / 3.0,
                  std::tan(kSlope) / 3.0 * kPatch / (3.0 * kBallRadius));
}
