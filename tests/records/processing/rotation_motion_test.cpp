#include <doctest/doctest.h>

#include <cmath>
#include <functional>
#include <numbers>
#include <vector>

#include "records/processing/base_motion.hpp"
#include "records/processing/motion_change.hpp"
#include "records/processing/processing.hpp"
#include "records/processing/recipe.hpp"
#include "records/processing/scale_record.hpp"
#include "records/processing/surface_rotation.hpp"
#include "scaling/laws/law_similitude.hpp"
#include "tests/support/relative.hpp"

/// Rotations as records: angles, their rates and accelerations, and those of the surface in a wave.
namespace musim::records {
namespace {

using lsdem::tests::relative;
using scaling::si::seconds;

// θ = A (1 − cos ω t)²: at rest at both ends of whole periods, home again
constexpr double kAmplitude = 0.03;                                  // rad
constexpr double kOmega = 2.0 * std::numbers::pi;                    // rad/s
constexpr std::size_t kRotationSteps = 4000;                         // of two periods
constexpr double kStep = 2.0 / static_cast<double>(kRotationSteps);  // s

double angle(double t) { return kAmplitude * std::pow(1.0 - std::cos(kOmega * t), 2); }
double rate(double t) { return 2.0 * kAmplitude * kOmega * (1.0 - std::cos(kOmega * t)) * std::sin(kOmega * t); }
double acceleration(double t) { return 2.0 * kAmplitude * kOmega * kOmega * (std::cos(kOmega * t) - std::cos(2.0 * kOmega * t)); }

TimeSeries sample(SampleQuantity quantity, const std::function<double(double)>& value) {
    std::vector<double> samples;
    for (std::size_t i = 0; i <= kRotationSteps; ++i) samples.push_back(value(static_cast<double>(i) * kStep));
    return {quantity, 0.0 * seconds, kStep * seconds, std::move(samples)};
}

double largest_error(const TimeSeries& series, const std::function<double(double)>& value) {
    double largest = 0.0;
    for (std::size_t i = 0; i < series.size(); ++i)
        largest = std::max(largest, std::abs(series.samples()[i] - value(series.time(i).value())));
    return largest;
}

}  // namespace

TEST_CASE("a base turns the same from an angle, its rate and its acceleration") {
    const TimeSeries given[] = {sample(SampleQuantity::angle, angle), sample(SampleQuantity::angular_velocity, rate),
                                sample(SampleQuantity::angular_acceleration, acceleration)};
    const double peak_angle = 4.0 * kAmplitude;
    for (const TimeSeries& series : given) {
        CAPTURE(to_string(series.quantity()));
        for (const AtRest at_rest : {AtRest::home, AtRest::displaced, AtRest::as_given}) {
            const BaseMotion base = make_base_motion(series, {.at_rest = at_rest});
            CHECK(base.velocity.quantity() == SampleQuantity::angular_velocity);
            CHECK(base.displacement.quantity() == SampleQuantity::angle);
            // trapezoids and central differences are off by (ω dt)² times a number near one; the angle has overtones up to 2ω
            const double tolerance = 4.0 * std::pow(kOmega * kStep, 2);
            CHECK(largest_error(base.velocity, rate) < tolerance * peak_angle * kOmega);
            CHECK(largest_error(base.displacement, angle) < tolerance * peak_angle);
            if (at_rest == AtRest::home) CHECK(std::abs(base.displacement.samples().back()) < 1e-12 * peak_angle);
        }
    }
    const BaseMotion home = make_base_motion(given[2], {});
    CHECK(home.steps.back().find("rad/s and ") != std::string::npos);
    // a turn and a displacement of the same samples are treated alike, to the last bit
    const std::span<const double> samples = given[2].samples();
    const BaseMotion along = make_base_motion(given[2].with_samples(SampleQuantity::acceleration, {samples.begin(), samples.end()}), {});
    for (std::size_t i = 0; i < along.velocity.size(); ++i) CHECK(along.velocity.samples()[i] == home.velocity.samples()[i]);
}

TEST_CASE("a window of a turn is cut as one of a displacement is") {
    const TimeSeries turn = sample(SampleQuantity::angular_acceleration, acceleration);
    const BaseMotion base = make_base_motion(turn, {.window = TimeWindow{0.25 * seconds, 1.75 * seconds}});
    CHECK(base.velocity.start().value() == 0.25);
    CHECK(base.velocity.samples().front() == 0.0);
    CHECK(base.velocity.samples().back() == 0.0);
    CHECK(std::abs(base.displacement.samples().back()) < 1e-12);
}

TEST_CASE("peaks of a turned base are compared with those of its record") {
    const TimeSeries turn = sample(SampleQuantity::angular_acceleration, acceleration);
    const BaseMotion base = make_base_motion(turn);
    const RotationChange change = compare_rotations(base.velocity, base.record);
    CHECK_FALSE(change.is_changed());
    // |cos − cos 2| is 2 at half a period, (1 − cos) sin is 3√3/4 at a third
    CHECK(change.record.acceleration.value() == relative(4.0 * kAmplitude * kOmega * kOmega, 1e-6));
    CHECK(change.record.rate.value() == relative(1.5 * std::sqrt(3.0) * kAmplitude * kOmega, 1e-5));
    CHECK(change.record.angle.value() == relative(4.0 * kAmplitude, 1e-5));
    CHECK(describe(change).starts_with("angular acceleration 4.737 rad/s^2 (record 4.737 rad/s^2, 0 %), angular velocity 28.1 deg/s"));
    CHECK(describe(change).find("angle 6.88 deg (record 6.88 deg, 0 %)") != std::string::npos);
    CHECK(std::holds_alternative<RotationChange>(compare_component(base.velocity, base.record)));

    std::vector<double> halved(base.velocity.samples().begin(), base.velocity.samples().end());
    for (double& value : halved) value *= 0.5;
    const RotationChange of_half = compare_rotations(base.velocity.with_samples(halved), base.record);
    CHECK(of_half.is_changed());
    CHECK(describe_changed_peaks(of_half).find("angular velocity 14 deg/s where its record has 28.1 deg/s (-50.0 %)") != std::string::npos);
}

TEST_CASE("steps of processing take rotations as they take translations") {
    const TimeSeries turn = sample(SampleQuantity::angle, angle);
    CHECK(differentiate(turn).quantity() == SampleQuantity::angular_velocity);
    CHECK(differentiate(differentiate(turn)).quantity() == SampleQuantity::angular_acceleration);
    CHECK(integrate(differentiate(turn)).quantity() == SampleQuantity::angle);
    CHECK_THROWS_WITH(integrate(turn), "an angle is not integrated (nothing is its rate); integrate acceleration or velocity");
    CHECK_THROWS_AS(differentiate(differentiate(differentiate(turn))), ProcessingError);
    CHECK_THROWS_WITH(bring_to_rest(turn),
                      "the correction to rest needs angular acceleration (the series holds angle); convert it or name the right quantity");
}

// u = f(t − x/c) along +x: θ_y = −∂u_z/∂x, θ_z = ½ ∂u_y/∂x; the derivatives along x are taken from the wave itself, not from time
TEST_CASE("the surface turns in a plane wave as the displacements around a point say") {
    const double c = 300.0, x = 40.0;                                                               // m/s, m
    const auto pulse = [](double t) { return 0.02 * std::sin(3.0 * t) * std::exp(-0.5 * t * t); };  // m
    const auto wave = [&](double at, double t) { return pulse(t - 1.0 - at / c); };
    const auto along_x = [&](double t) { return (wave(x + 0.01, t) - wave(x - 0.01, t)) / 0.02; };  // ∂u/∂x
    const TimeSeries translation = sample(SampleQuantity::displacement, [&](double t) { return wave(x, t); });
    for (const double towards : {1.0, -1.0}) {
        // waves along −x are those along +x seen from the other side
        const TimeSeries rocking = find_rocking(translation, towards * c * scaling::si::meters_per_second);
        const TimeSeries torsion = find_torsion(translation, towards * c * scaling::si::meters_per_second);
        CHECK(rocking.quantity() == SampleQuantity::angle);
        // central differences: (3 dt)²/6 of the peak, 0.06/c; one-sided ones at the ends: half a step
        CHECK(largest_error(rocking, [&](double t) { return -towards * along_x(t); }) < 3.0 * kStep * 0.06 / c);
        CHECK(largest_error(torsion, [&](double t) { return 0.5 * towards * along_x(t); }) < 1.5 * kStep * 0.06 / c);
    }
    const TimeSeries accelerated =
        find_rocking(translation.with_samples(SampleQuantity::acceleration, {0.0, 3.0}), c * scaling::si::meters_per_second);
    CHECK(accelerated.quantity() == SampleQuantity::angular_velocity);
    CHECK(accelerated.samples()[1] == relative(0.01, 1e-15));
    CHECK_THROWS_WITH(find_torsion(translation, {}), "apparent velocity is 0 m/s (must be finite and not zero); give one such as 800 m/s");
    CHECK_THROWS_AS(find_rocking(accelerated, c * scaling::si::meters_per_second), ProcessingError);
}

TEST_CASE("rotations of the surface are a step of a recipe") {
    GroundMotion motion;
    motion.source = "a";
    motion.components.push_back({.name = "UP", .azimuth_deg = {}, .series = sample(SampleQuantity::acceleration, rate)});
    motion.components.push_back({.name = "N", .azimuth_deg = 0.0, .series = sample(SampleQuantity::acceleration, angle)});
    const Recipe recipe = parse_recipe(
        R"({"schema": "musim-recipe/1", "steps": [{"step": "surface_rotation", "velocity": "800 m/s", "vertical": "UP", "transverse": "N"}]})",
        "test");
    const GroundMotion turned = process(motion, recipe);
    CHECK(turned.component_names() == "UP, N, ry, rz");
    CHECK(turned.find_component("ry").series == find_rocking(motion.components[0].series, 800.0 * scaling::si::meters_per_second));
    CHECK(turned.find_component("rz").series == find_torsion(motion.components[1].series, 800.0 * scaling::si::meters_per_second));
    CHECK(write_recipe(recipe_of(turned)) == write_recipe(recipe));
    CHECK_THROWS_WITH(process(turned, recipe), "step 1 (surface_rotation): the record has a component ry already; leave this step out");
    CHECK_THROWS_WITH(
        parse_recipe(R"({"schema": "musim-recipe/1", "steps": [{"step": "surface_rotation", "velocity": "800 m/s"}]})", "t"),
        "t: step 1 (surface_rotation): names no component; add \"vertical\", for rocking, \"transverse\", for torsion, or both");

    const GroundMotion uniform = process(turned, {step::ToAcceleration{}});
    CHECK(uniform.components[0].series.quantity() == SampleQuantity::acceleration);
    CHECK(uniform.components[2].series.quantity() == SampleQuantity::angular_acceleration);
}

TEST_CASE("every law keeps angles and divides their rates by the time") {
    GroundMotion motion;
    motion.components.push_back({.name = "ry", .azimuth_deg = {}, .series = sample(SampleQuantity::angle, angle)});
    motion.components.push_back({.name = "gyro", .azimuth_deg = {}, .series = sample(SampleQuantity::angular_velocity, rate)});
    motion.components.push_back({.name = "rz", .azimuth_deg = {}, .series = sample(SampleQuantity::angular_acceleration, acceleration)});
    for (const char* const law : {"froude", "mu", "cauchy", "centrifuge"}) {
        CAPTURE(law);
        const scaling::Similitude similitude = scaling::make_similitude(law, {.length = 1.0 / 16.0});
        const GroundMotion model = rescale(motion, similitude);
        const double time = similitude.time();
        for (std::size_t i = 97; i <= kRotationSteps; i += 97) {
            const double t = static_cast<double>(i) * kStep;
            CHECK(model.components[0].series.samples()[i] == angle(t));
            CHECK(model.components[1].series.samples()[i] == relative(rate(t) / time, 1e-14));
            CHECK(model.components[2].series.samples()[i] == relative(acceleration(t) / (time * time), 1e-14));
        }
        CHECK(model.history.back().find(", angle 1, angular velocity ") != std::string::npos);
        // integrals of the model are the prototype's: with powers of two to the last bit
        if (time == 0.25) {
            const BaseMotion full = make_base_motion(motion.components[2].series), small = make_base_motion(model.components[2].series);
            for (std::size_t i = 0; i < full.displacement.size(); ++i) {
                CHECK(small.displacement.samples()[i] == full.displacement.samples()[i]);
                CHECK(small.velocity.samples()[i] == 4.0 * full.velocity.samples()[i]);
            }
        }
    }
}

}  // namespace musim::records
