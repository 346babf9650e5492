#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "lsdem/motion/simulation.hpp"
#include "lsdem/time_step.hpp"
#include "tests/support/models.hpp"
#include "tests/support/motion.hpp"
#include "tests/support/relative.hpp"
#include "tests/support/rocking.hpp"
#include "tests/support/round_bodies.hpp"

using namespace musim::lsdem;
using namespace musim::lsdem::tests;

namespace {

constexpr double kRadius = 0.01, kHeight = 0.06;  // of the drum, and half width and height of the box [m]
constexpr double kVoxel = 0.05 * kRadius;         // [m]
constexpr double kSink = 1e-6 * kRadius;          // of the standing body under its weight [m]

/// A body that turns about a point of its lower rim in a plane, without slip: θ̈ = −(m g r/I_o) sin(α − θ)  [Housner63].
struct Pendulum {
    double half_width = 0.0, height = 0.0;  ///< [m]
    double inertia_over_mass = 0.0;         ///< about the centre of mass [m²]

    double slenderness() const { return std::atan2(2.0 * half_width, height); }                              ///< α [rad]
    double radius() const { return std::hypot(half_width, 0.5 * height); }                                   ///< r [m]
    double squared_rate() const { return kGravity * radius() / (inertia_over_mass + radius() * radius()); }  ///< [1/s²]

    /// Time from rest at `tilt` [rad] to upright, fourth-order Runge-Kutta [s].
    double quarter_period(double tilt) const {
        const double p2 = squared_rate(), alpha = slenderness(), h = 1e-4 / std::sqrt(p2);
        const auto f = [&](double x) { return -p2 * std::sin(alpha - x); };
        double t = 0.0, x = tilt, w = 0.0;
        while (true) {
            const double a1 = f(x), b2 = w + 0.5 * h * a1, a2 = f(x + 0.5 * h * w), b3 = w + 0.5 * h * a2, a3 = f(x + 0.5 * h * b2);
            const double b4 = w + h * a3, a4 = f(x + h * b3), next = x + h / 6.0 * (w + 2.0 * b2 + 2.0 * b3 + b4);
            if (next < 0.0) return t + h * x / (x - next);
            x = next, t += h, w += h / 6.0 * (a1 + 2.0 * a2 + 2.0 * a3 + a4);
        }
    }

    /// Tilt from rest after `duration` [s] on a base with acceleration `base`(t) [g], leapfrog: θ̈ = −p²[sin(α − θ) − base·cos(α − θ)]
    /// [rad].
    template <class Base>
    double shaken_tilt(double duration, const Base& base) const {
        const double p2 = squared_rate(), alpha = slenderness(), h = duration / 20000.0;
        double x = 0.0, w = 0.0;
        for (int i = 0; i < 20000; ++i) {
            w += h * p2 * (base(h * i) * std::cos(alpha - x) - std::sin(alpha - x));
            if (w < 0.0) w = 0.0;
            x += h * w;
        }
        return x;
    }
};

Pendulum pendulum_of(const Shape& shape) { return {shape.half_extents.x(), 2.0 * shape.half_extents.z(), shape.inertia_over_mass.y()}; }

Shape make_drum() { return make_cylinder_shape(kRadius, kHeight, {60, 10, 8}, kVoxel); }

Shape make_grid_block() { return make_grid_box_shape({2.0 * kRadius, 2.0 * kRadius, kHeight}, {11, 11, 31}, kVoxel); }

/// One rough, elastic body of a shape, as stiff as to sink by `sink` [m] under its weight.
Model make_rocking_model(Shape shape, double sink = kSink) {
    const double mass = kBallDensity * shape.volume, stiffness = mass * kGravity / shape.face_area / sink;
    Model model = make_empty_model(make_ball_material(stiffness, 2.0, 1.0));
    model.gravity = {0.0, 0.0, -kGravity};
    add_block(model, add_shape(model, std::move(shape)), mass, Vector3::Zero());
    return model;
}

/// Tilts block 0 about the y axis, its lowest point at the origin.
void tilt(Model& model, double angle) {
    const Quaternion orientation(Eigen::AngleAxisd(angle, Vector3::UnitY()));
    model.blocks[0].orientation = orientation;
    model.blocks[0].position = -(orientation * Vector3(kRadius, 0.0, -0.5 * kHeight));
}

struct Fall {
    double quarter_period = 0.0;  ///< [s]
    double out_of_plane = 0.0;    ///< turning about other axes at the end [rad]
};

Fall fall_to_upright(const Model& model, double until) {
    Simulation s(model, 0.5 * compute_critical_time_step(model));
    const double time = find_crossing(s, until, [](const Simulation& now) { return tilt_about_y(now); });
    const Quaternion q = s.orientation(0);
    return {time, 2.0 * std::hypot(q.x(), q.z())};
}

/// Change of the quarter period when the pivot lies inside the rim by `inset` half widths: of acosh(1/(1 − θ0/α)) with α ∝ 1 − inset, at
/// θ0 = α/2; the rest, by r and I, is smaller and of opposite sign.
double pivot_effect(double inset) { return inset * (2.0 / std::sqrt(3.0)) / std::acosh(2.0); }

/// The pivot sinks by kSink·A_face/A_node, twice that while it rings, and the body leans by that over its width.
double sink_effect(const Model& model, double edge_area) {
    const Shape& shape = model.shapes[0];
    const double lean = 2.0 * kSink * shape.face_area / edge_area / (2.0 * kRadius);
    return 2.0 * lean / (0.5 * pendulum_of(shape).slenderness());
}

}  // namespace

// The drum's nodes on the plane of the ground. Rocking in a plane is an exact motion of a drum: the pivot is the node that was lowest.
TEST_CASE("a tilted drum falls to upright in the quarter period of its rim") {
    for (const double fraction : {0.3, 0.5, 0.7}) {
        Model model = make_rocking_model(make_drum());
        model.ground.present = true;
        const Pendulum pendulum = pendulum_of(model.shapes[0]);
        tilt(model, fraction * pendulum.slenderness());
        const double expected = pendulum.quarter_period(fraction * pendulum.slenderness());
        const Fall fall = fall_to_upright(model, 2.0 * expected);
        // one rim node: half a ring wide, π(R² − (R − R/20)²)/60
        const double node_area = kPi * kRadius * kRadius * (1.0 - 0.95 * 0.95) / 60.0;
        CHECK(fall.quarter_period / expected == relative(1.0, sink_effect(model, node_area)));
        CHECK(fall.out_of_plane < 1e-9);
    }
}

namespace {

/// Quarter period over the expected one, of a body on a plate with nodes every `spacing` [m].
Fall fall_on_plate(Shape shape, double spacing, ContactNodes nodes) {
    Model model = make_rocking_model(std::move(shape));
    model.numerics.contact_nodes = nodes;
    const Pendulum pendulum = pendulum_of(model.shapes[0]);
    const double angle = 0.5 * pendulum.slenderness();
    tilt(model, angle);
    add_plate(model, -2.5 * kRadius, 0.5 * kRadius, 3.0 * kRadius, spacing, kVoxel);
    const double expected = pendulum.quarter_period(angle);
    Fall fall = fall_to_upright(model, 2.0 * expected);
    fall.quarter_period /= expected;
    return fall;
}

}  // namespace

// Nodes of the plate find the rim only where they stand, up to a spacing inside it, and the rim of a grid is rounded by up to 0.3 voxels at
// a sharp edge (the trilinear interpolant of a corner). Nodes of the body itself pivot where the rim is.
TEST_CASE("a body that rocks on a plate pivots within a spacing and a voxel of its rim, or on it when probed from both sides") {
    const double spacing = 0.05 * kRadius;
    const double inset = pivot_effect((spacing + kVoxel) / kRadius);
    const Fall drum = fall_on_plate(make_drum(), spacing, ContactNodes::leader);
    const Fall drum_both = fall_on_plate(make_drum(), spacing, ContactNodes::both);
    const Fall box = fall_on_plate(make_grid_block(), spacing, ContactNodes::leader);
    const Fall box_both = fall_on_plate(make_grid_block(), spacing, ContactNodes::both);
    for (const Fall& fall : {drum, box}) {
        CHECK(fall.quarter_period > 1.0 - 1e-3);
        CHECK(fall.quarter_period < 1.0 + inset);
    }
    // half of the stiffness is at the body's own nodes
    Model model = make_rocking_model(make_drum());
    const double drum_node = kPi * kRadius * kRadius * (1.0 - 0.95 * 0.95) / 60.0, box_row = 4.0 * kRadius * kRadius / 20.0;
    CHECK(drum_both.quarter_period == relative(1.0, sink_effect(model, 0.5 * drum_node)));
    CHECK(box_both.quarter_period == relative(1.0, sink_effect(make_rocking_model(make_grid_block()), 0.5 * box_row)));
}

namespace {

/// Near the threshold the weight stands on a few rim nodes. At 0.98 of it, on those within 0.04 R of the rim, 0.8 % of the face, which then
/// sink 125 times deeper: the drum leans by 125/0.02 of sink/R. A firm bed keeps that small [m].
constexpr double kFirmSink = 1e-3 * kSink;
constexpr double kFirmLean = 1e4 * kFirmSink / kRadius;  // [rad]

/// Acceleration of the base, in units of its `peak`: up within a tenth of `duration`, then constant.
double ramp(double t, double duration) { return std::min(1.0, 10.0 * t / duration); }

/// Tilt of a standing drum after the ground has come up to A g and held it until `duration` [rad].
double shake_drum(double acceleration_g, double duration) {
    Model model = make_rocking_model(make_drum(), kFirmSink);
    model.ground.present = true;
    model.blocks[0].position.z() = 0.5 * kHeight - kFirmSink;
    const double a = acceleration_g * kGravity, rise = 0.1 * duration;
    model.ground.motion.shift[0] =
        sample_velocity(duration, 1000, [=](double t) { return t < rise ? 0.5 * a * t * t / rise : a * (t - 0.5 * rise); });
    Simulation s(model, 0.5 * compute_critical_time_step(model));
    advance_to(s, duration);
    return -tilt_about_y(s);
}

}  // namespace

// A body of half width R on a rough base lifts when a H/2 > g R: A = B/H  [Housner63], B = 2R the drum's diameter.
TEST_CASE("a drum on a shaken base lifts at its diameter over its height") {
    const Pendulum pendulum = pendulum_of(make_drum());
    const double threshold = 2.0 * kRadius / kHeight, duration = 0.5 / std::sqrt(pendulum.squared_rate());
    const double expected = pendulum.shaken_tilt(duration, [&](double t) { return 1.2 * threshold * ramp(t, duration); });
    const double below = shake_drum(0.98 * threshold, duration), above = shake_drum(1.2 * threshold, duration);
    CHECK(std::abs(below) < kFirmLean);
    // above: it starts to fall from its lean, ahead of the rigid drum by the time in which that, with the rate j of the base's
    // acceleration, would take up the lean, θ = p² j t³/6; over the rest of the time that adds 2t/duration to the tilt
    const double rate = 1.2 * threshold / (0.1 * duration);
    const double ahead = std::cbrt(6.0 * kFirmLean / (pendulum.squared_rate() * rate));
    CHECK(above == relative(expected, 2.0 * ahead / duration));
}
