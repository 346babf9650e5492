#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

#include "records/error.hpp"
#include "records/shake_table/table_check.hpp"
#include "scaling/laws/law_similitude.hpp"
#include "tests/support/relative.hpp"

namespace musim::records {
namespace {

using lsdem::tests::relative;
using scaling::make_similitude;
using scaling::Similitude;
namespace si = scaling::si;

constexpr double kEnergyShare = 0.99;

/// Demand of the tests' motion on a table, as a prototype.
TableDemand demand() {
    return {0.5 * si::meters,  0.4 * si::meters,  1.5 * si::meters_per_second, 6.0 * si::meters_per_second_squared,
            0.2 / si::seconds, 12.0 / si::seconds};
}

TableAxis axis() {
    TableAxis axis;
    axis.name = "x";
    return axis;
}

Payload load(double mass, double height = 0.0, bool is_prototype = false) {
    return {mass * si::kilograms, height * si::meters, is_prototype};
}

double use_of(const TableAxis& axis, TableLimit which, const Payload& payload) {
    for (const LimitUse& use : check_axis(demand(), axis, payload))
        if (use.which == which) return use.used();
    FAIL("limit is not checked");
    return 0.0;
}

/// Models of a law whose factors are 1 but for length.
ScalesOfLength by(const char* law) {
    return [law](double length) { return make_similitude(law, {.length = length}); };
}

/// The one range of scales; its ends are found to the last bits, products of a few roundings.
ScaleRange only_range(const TableAxis& axis, const Payload& payload, const char* law = "mu") {
    const auto ranges = find_scales(find_limit_scales({{axis, demand()}}, payload, by(law)));
    REQUIRE(ranges.size() == 1);
    return ranges.front();
}

constexpr double kRounding = 16.0 * std::numeric_limits<double>::epsilon();

}  // namespace

TEST_CASE("each limit of an axis is used as far as its formula says") {
    TableAxis table = axis();
    table.displacement = 1.0 * si::meters;
    table.velocity = 2.0 * si::meters_per_second;
    table.moving_mass = 1000.0 * si::kilograms;
    table.force = 36e3 * si::newtons;
    table.overturning_moment = scaling::Moment::from_value(12e3);
    table.payload = 1000.0 * si::kilograms;
    table.lowest_frequency = 0.1 / si::seconds;
    table.highest_frequency = 24.0 / si::seconds;
    table.oil_column = OilColumn{40.0 / si::seconds, 0.6};
    table.controller_rate = 100.0 / si::seconds;
    const Payload payload = load(3000.0, 0.5);
    CHECK(use_of(table, TableLimit::displacement, payload) == 0.5);
    CHECK(use_of(table, TableLimit::velocity, payload) == 0.75);
    CHECK(use_of(table, TableLimit::force, payload) == 4000.0 * 6.0 / 36e3);
    CHECK(use_of(table, TableLimit::overturning_moment, payload) == 3000.0 * 0.5 * 6.0 / 12e3);
    CHECK(use_of(table, TableLimit::payload, payload) == 3.0);
    CHECK(use_of(table, TableLimit::lowest_frequency, payload) == 0.1 / 0.2);
    CHECK(use_of(table, TableLimit::highest_frequency, payload) == 0.5);
    CHECK(use_of(table, TableLimit::oil_column, payload) == 12.0 / (0.6 * 0.5 * 40.0));  // four times the mass: half the frequency
    CHECK(use_of(table, TableLimit::controller_band, payload) == 12.0 / (kFollowedShare * 100.0));
    CHECK(check_axis(demand(), axis(), payload).empty());
}

// θ = Θ sin ωt about an axis in the platen: velocity Θω, acceleration Θω², m h (h Θω² + g sin Θ) against a mass m at the height h
TEST_CASE("a turn uses the limits of its axis, and a moment against inertia and weight") {
    const double angle = 0.05, omega = 4.0 * std::numbers::pi;
    std::vector<double> samples;
    constexpr std::size_t kSteps = 8000;  // of ten periods
    for (std::size_t i = 0; i < kSteps; ++i)
        samples.push_back(-angle * omega * omega * std::sin(omega * 5.0 * static_cast<double>(i) / static_cast<double>(kSteps)));
    const TimeSeries acceleration(SampleQuantity::angular_acceleration, 0.0 * si::seconds, 5.0 / kSteps * si::seconds, samples);
    // integrated from rest the sine drifts; the table's motion is the periodic one
    const TimeSeries rate = integrate_by_frequency(acceleration);
    const TableDemand turn = find_demand({acceleration, rate, integrate_by_frequency(rate)}, kEnergyShare);
    CHECK(turn.displacement.value() == 0.0);
    CHECK(turn.turn.angle.value() == relative(angle, 1e-3));
    CHECK(turn.lowest_frequency.value() == relative(2.0, 0.11));

    TableAxis table = axis();
    table.name = "pitch";
    table.is_rotation = true;
    table.angle = scaling::Ratio::from_value(0.1);
    table.angular_velocity = 2.0 / si::seconds;
    table.angular_acceleration = scaling::AngularAcceleration::from_value(10.0);
    table.overturning_moment = scaling::Moment::from_value(5e3);
    const auto uses = check_axis(turn, table, load(600.0, 0.7));
    REQUIRE(uses.size() == 4);
    // 800 samples a period: peaks to (2π/800)²/8
    CHECK(uses[0].used() == relative(angle / 0.1, 1e-3));
    CHECK(uses[1].used() == relative(angle * omega / 2.0, 1e-3));
    CHECK(uses[2].used() == relative(angle * omega * omega / 10.0, 1e-3));
    CHECK(uses[3].which == TableLimit::overturning_moment);
    CHECK(uses[3].demand ==
          relative(600.0 * 0.7 * (0.7 * angle * omega * omega + scaling::kStandardGravity.value() * std::sin(angle)), 1e-3));

    // angles keep their size, so the velocity's limit alone depends on the scale: λ_t = √λ_l in froude
    const auto limits = find_limit_scales({{table, turn}}, load(0.0), by("froude"));
    REQUIRE(limits.size() == 4);
    CHECK(limits[0].ranges.front().smallest == kSmallestScale);
    CHECK(limits[1].ranges.front().smallest == relative(std::pow(angle * omega / 2.0, 2), 1e-2));
    const Similitude half = make_similitude("froude", {.length = 0.25});
    const TableDemand model = to_model(turn, half), back = to_prototype(model, half);
    CHECK(model.turn.angle == turn.turn.angle);
    CHECK(model.turn.angular_velocity == 2.0 * turn.turn.angular_velocity);
    CHECK(model.turn.angular_acceleration == 4.0 * turn.turn.angular_acceleration);
    CHECK(back.turn.angular_acceleration == turn.turn.angular_acceleration);
}

TEST_CASE("between payloads the table's force is the same, beyond them too") {
    TableAxis table = axis();
    table.acceleration = {{0.0 * si::kilograms, 12.0 * si::meters_per_second_squared},
                          {1000.0 * si::kilograms, 6.0 * si::meters_per_second_squared},
                          {3000.0 * si::kilograms, 3.0 * si::meters_per_second_squared}};
    const auto limit = [&](double mass) { return 6.0 / use_of(table, TableLimit::acceleration, load(mass)); };
    CHECK(limit(0.0) == relative(12.0, kRounding));
    CHECK(limit(500.0) == relative(8.0, kRounding));  // 12 kN move 1 t + 0.5 t
    CHECK(limit(1000.0) == relative(6.0, kRounding));
    CHECK(limit(2000.0) == relative(4.0, kRounding));
    CHECK(limit(5000.0) == relative(2.0, kRounding));
    // two limits with errors of their own may rise: far beyond them none is left, and never a negative one
    std::swap(table.acceleration[1].limit, table.acceleration[2].limit);
    CHECK(use_of(table, TableLimit::acceleration, load(1e6)) == 0.0);
    table.acceleration.resize(1);
    CHECK(limit(5000.0) == relative(12.0, kRounding));
}

TEST_CASE("the length scales that a limit leaves are those of its power of the scale") {
    TableAxis table = axis();
    table.displacement = 0.05 * si::meters;
    table.highest_frequency = 60.0 / si::seconds;
    {
        const ScaleRange range = only_range(table, load(0.0));
        CHECK(range.largest == relative(0.05 / 0.5, kRounding));                 // d λ_l
        CHECK(range.smallest == relative(std::pow(12.0 / 60.0, 2), kRounding));  // f/√λ_l
        CHECK(range.binds_above == TableLimit::displacement);
        CHECK(range.binds_below == TableLimit::highest_frequency);
        CHECK(range.axis_above == "x");
    }
    table = axis();
    table.velocity = 0.3 * si::meters_per_second;
    CHECK(only_range(table, load(0.0)).largest == relative(std::pow(0.3 / 1.5, 2), kRounding));  // v √λ_l
    CHECK_FALSE(only_range(table, load(0.0)).binds_below);
    table = axis();
    table.payload = 100.0 * si::kilograms;
    CHECK(only_range(table, load(1e6, 0.0, true)).largest == relative(std::cbrt(1e-4), kRounding));  // m λ_l³
    table = axis();
    table.overturning_moment = scaling::Moment::from_value(600.0);
    CHECK(only_range(table, load(1e4, 10.0, true)).largest == relative(std::pow(1e-3, 0.25), kRounding));  // λ_l⁴
    // elasticity: a smaller model needs more acceleration
    table = axis();
    table.acceleration = {{0.0 * si::kilograms, 60.0 * si::meters_per_second_squared}};
    CHECK(only_range(table, load(0.0), "cauchy").smallest == relative(0.1, kRounding));
}

TEST_CASE("limits can leave no scale, or all, or be looked at alone") {
    TableAxis table = axis();
    table.displacement = 0.01 * si::meters;
    table.highest_frequency = 20.0 / si::seconds;
    const std::vector<AxisLoad> loads{{table, demand()}};
    const std::vector<LimitScales> limits = find_limit_scales(loads, load(0.0), by("mu"));
    CHECK(find_scales(limits).empty());
    REQUIRE(limits.size() == 2);
    CHECK(limits.front().which == TableLimit::displacement);
    REQUIRE(limits.front().ranges.size() == 1);
    CHECK(limits.front().ranges.front().smallest == kSmallestScale);
    const auto all = find_scales(find_limit_scales({{axis(), demand()}}, load(1e9), by("mu")));
    REQUIRE(all.size() == 1);
    CHECK(all.front().smallest == kSmallestScale);
    CHECK(all.front().largest == 1.0);
}

TEST_CASE("a payload that grows and an acceleration that falls can leave two ends") {
    TableAxis table = axis();
    table.moving_mass = 100.0 * si::kilograms;
    table.force = 10e3 * si::newtons;
    const auto ranges = find_scales(find_limit_scales({{table, demand()}}, load(1e4, 0.0, true), by("cauchy")));  // (M + m λ³) a/λ
    REQUIRE(ranges.size() == 1);
    for (const double end : {ranges[0].smallest, ranges[0].largest})
        CHECK((100.0 + 1e4 * end * end * end) * 6.0 / end == relative(10e3, 1e-12));
    CHECK(ranges[0].smallest < ranges[0].largest);
}

TEST_CASE("what a motion asks is measured unfiltered") {
    // one cycle of v = (1 − cos 2πt)/2, which displaces by 1/2 m, then back
    std::vector<double> samples;
    constexpr int kSteps = 1000;
    for (int i = 0; i <= 2 * kSteps; ++i) {
        const double t = static_cast<double>(i) / kSteps, sign = i <= kSteps ? 1.0 : -1.0;
        samples.push_back(sign * std::numbers::pi * std::sin(2.0 * std::numbers::pi * t));
    }
    const DriveMotion motion =
        integrate_twice(TimeSeries(SampleQuantity::acceleration, 0.0 * si::seconds, (1.0 / kSteps) * si::seconds, samples));
    const TableDemand asked = find_demand(motion, kEnergyShare);
    // trapezoids of sines are off by (2π dt)²/12 = 3.3e-6
    CHECK(asked.displacement.value() == relative(0.5, 1e-5));
    CHECK(asked.half_range.value() == relative(0.25, 1e-5));
    CHECK(asked.velocity.value() == relative(1.0, 1e-5));
    CHECK(asked.acceleration.value() == relative(std::numbers::pi, 1e-5));
    CHECK(asked.lowest_frequency < 1.0 / si::seconds);
    CHECK(asked.highest_frequency > 1.0 / si::seconds);

    const Similitude similitude = make_similitude("mu", {.length = 1.0 / 107.0, .friction = 1.07});
    const TableDemand there = to_model(asked, similitude), back = to_prototype(there, similitude);
    CHECK(there.displacement.value() == asked.displacement.value() * similitude.length());
    CHECK(there.highest_frequency.value() == asked.highest_frequency.value() * similitude.frequency());
    CHECK(back.velocity.value() == relative(asked.velocity.value(), kRounding));
    const TableDemand up = to_model(asked, similitude, scaling::Shaking::vertical);
    CHECK(up.acceleration.value() == asked.acceleration.value());
    CHECK(up.displacement.value() == relative(asked.displacement.value() / 107.0 / 1.07, kRounding));
    CHECK(up.highest_frequency.value() == there.highest_frequency.value());
    CHECK(to_prototype(up, similitude, scaling::Shaking::vertical).velocity.value() == relative(asked.velocity.value(), kRounding));
    samples.assign(samples.size(), 0.0);
    CHECK_THROWS_AS(find_demand(integrate_twice(motion.acceleration.with_samples(samples)), kEnergyShare), ProcessingError);
}

}  // namespace musim::records
