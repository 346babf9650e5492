#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "lsdem/motion/simulation.hpp"
#include "lsdem/solid/basic_solids.hpp"
#include "lsdem/time_step.hpp"
#include "tests/support/models.hpp"
#include "tests/support/motion.hpp"

using namespace musim::lsdem;
using namespace musim::lsdem::tests;

namespace {

constexpr double kDrumRadius = 0.1, kDrumLength = 0.1, kDrumDensity = 2500.0;  // [m], [m], [kg/m³]

/// A drum on its side, a flat of it on the ground, its axis along y, on a slope downhill along +x. `sink`: depth at rest as a part of the
/// radius, were it on level ground [-].
Model make_lying_drum(int flats, double slope, double friction, double restitution, double sink) {
    Model model;
    model.numerics.skip_rest = false;
    model.shapes.push_back(make_solid_shape(make_drum(kDrumRadius, kDrumLength, flats, kDrumRadius)));
    const double mass = kDrumDensity * model.shapes[0].volume, half = kPi / flats;
    const double stiffness = mass * kGravity / (2.0 * kDrumRadius * std::sin(half) * kDrumLength * sink * kDrumRadius);
    model.materials.push_back({stiffness, 0.8 * stiffness, friction, restitution, 0.0});
    model.ground.material = model.materials.front();
    model.gravity = tilted_gravity(slope);
    Block block;
    block.mass = mass;
    // the first flat's middle, on +x of the drum, down; the drum's axis along y
    const Matrix3 rotation = (Matrix3() << 0.0, 1.0, 0.0, 0.0, 0.0, -1.0, -1.0, 0.0, 0.0).finished();
    block.orientation = Quaternion(Matrix3(rotation * model.shapes[0].own.rotation.transpose()));
    block.position = {0.0, 0.0, kDrumRadius * std::cos(half) - sink * kDrumRadius};
    model.blocks.push_back(block);
    return model;
}

/// A block on a bed tips earlier than a rigid one: a load N at the end of a base of width s and length w leaves a part x of it pressed, and
/// the largest moment that it bears, over that of a rigid edge, is 1 − x/s with x³ = 12 h N/(K w), h the height of the centre.
double find_shortfall(int flats, double sink) {
    const double s = 2.0 * std::sin(kPi / flats), h = std::cos(kPi / flats);
    return std::cbrt(12.0 * h * sink / (s * s));
}

/// Angle by which a drum has turned after `duration` [rad], or as soon as that is more than the angle of a flat.
double find_drum_turn(const Model& model, double duration) {
    Simulation s(model, 0.8 * compute_critical_time_step(model));
    double turned = 0.0;
    while (s.time() < duration && turned < kPi / 4.0) {
        turned += s.angular_velocity(0).y() * s.time_step();
        advance(s);
    }
    return turned;
}

}  // namespace

// [oracles H4] A prism of n flats rests until tan θ = tan(π/n), whatever its friction above that.
TEST_CASE("a prism of n flats rests on slopes up to pi over n") {
    constexpr double kDrumSink = 1e-6;
    for (const int flats : {4, 6, 12}) {
        CAPTURE(flats);
        const double limit = std::tan(kPi / flats), shortfall = find_shortfall(flats, kDrumSink);
        REQUIRE(shortfall < 0.04);
        const auto turn_at = [&](double part) {
            return find_drum_turn(make_lying_drum(flats, std::atan(part * limit), 3.0, 0.3, kDrumSink), 1.0);
        };
        // a release from flat costs the energy of the bed, sink of the radius, far below the barrier of half the shortfall
        CHECK(turn_at(1.0 - 2.0 * shortfall) < shortfall);
        CHECK(turn_at(1.0 + 0.5 * shortfall) > kPi / 4.0);
    }
}

namespace {

struct RolledWay {
    double acceleration = 0.0;  ///< v²/(2x), of the last flat's mean velocity [m/s²]
    double closure = 0.0;       ///< error of the energy balance over the work of gravity [-]
};

/// Lets a drum roll over so many flats.
RolledWay roll_over(const Model& model, int flats, int count) {
    Simulation s(model, 0.8 * compute_critical_time_step(model));
    const double start = s.energy().balance(), step = 2.0 * kPi / flats, begin = s.position(0).x();
    double turned = 0.0, entered = 0.0, at_entry = 0.0;
    while (turned < step * count) {
        turned += s.angular_velocity(0).y() * s.time_step();
        advance(s);
        REQUIRE(s.time() < 10.0);
        if (entered == 0.0 && turned >= step * (count - 1)) entered = s.time(), at_entry = s.position(0).x();
    }
    const double x = s.position(0).x(), v = (x - at_entry) / (s.time() - entered), middle = 0.5 * (x + at_entry) - begin;
    const double work = model.blocks[0].mass * kGravity * std::sin(std::atan2(model.gravity.x(), -model.gravity.z())) * (x - begin);
    return {v * v / (2.0 * middle), std::abs(s.energy().balance() - start) / work};
}

}  // namespace

// A drum rolls with (2/3) g sin θ. Of a rigid polygon each flat that lands without rebound keeps ((k + cos θ_n)/(k + 1))² of the energy,
// θ_n = 2π/n, k = (2 + cos θ_n)/6, so that after m flats E/(m ΔE) is at least r(1 − r^m)/(m(1 − r)); a bed that gives keeps more.
TEST_CASE("a drum with many flats rolls at two thirds of gravity's pull, the better the more flats it has") {
    constexpr double kDrumSlope = 20.0 * kPi / 180.0;
    const double expected = 2.0 / 3.0 * kGravity * std::sin(kDrumSlope);
    double before = 1.0;
    for (const int flats : {24, 48, 96}) {
        CAPTURE(flats);
        const int count = flats / 3;
        const double turn = 2.0 * kPi / flats, k = (2.0 + std::cos(turn)) / 6.0;
        const double kept = std::pow((k + std::cos(turn)) / (k + 1.0), 2);
        const double least = kept * (1.0 - std::pow(kept, count)) / (count * (1.0 - kept));
        const RolledWay way = roll_over(make_lying_drum(flats, kDrumSlope, 0.6, 0.3, 1e-5), flats, count);
        const double part = way.acceleration / expected;
        MESSAGE(flats << " flats: " << part << " of 2/3 g sin, at least " << least << ", balance open " << way.closure);
        CHECK(part < 1.0 + 2.0 / count);
        CHECK(part > least - 1.0 / count);
        CHECK(std::abs(part - 1.0) < before);
        CHECK(way.closure < 1e-3);
        before = std::abs(part - 1.0);
    }
}

// Steeper than tan θ = 3 μ it slips: a = g (sin θ − μ cos θ), and spins up with 2 μ g cos θ/R.
TEST_CASE("a drum slips down a steep slope, and spins up as friction says") {
    constexpr double kDrumSlope = kPi / 4.0, kSlipFriction = 0.2, kSlipTime = 0.3;
    Model model = make_lying_drum(96, kDrumSlope, kSlipFriction, 0.3, 1e-4);
    Simulation s(model, 0.8 * compute_critical_time_step(model));
    const double begin = s.position(0).x();
    advance_to(s, kSlipTime);
    const double cosine = std::cos(kDrumSlope), a = kGravity * (std::sin(kDrumSlope) - kSlipFriction * cosine);
    const double way = (s.position(0).x() - begin) / (0.5 * a * kSlipTime * kSlipTime);
    const double spin = s.angular_velocity(0).y() * kDrumRadius / (2.0 * kSlipFriction * kGravity * cosine * kSlipTime);
    MESSAGE("way " << way << " spin " << spin << " of the closed forms");
    // the ground pushes up to half a flat beside the foot of the centre: an arm of R tan(π/n) beside the one of friction, R
    CHECK(std::abs(way - 1.0) < std::tan(kPi / 96.0));
    CHECK(std::abs(spin - 1.0) < std::tan(kPi / 96.0));
}
