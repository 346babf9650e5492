#include <doctest/doctest.h>

#include <cmath>

#include "records/measures/intensity.hpp"
#include "records/processing/base_motion.hpp"
#include "records/synthesis/synthetic.hpp"
#include "tests/support/relative.hpp"

namespace musim::records {
namespace {

using lsdem::tests::relative;
using scaling::si::seconds;

TEST_CASE("the synthetic record has the wanted PGA and PGV at once and ends at rest") {
    for (const double duration : {2.5, 5.0, 10.0, 40.0}) {
        for (const std::uint64_t seed : {1U, 2U, 3U, 4U, 5U}) {
            CAPTURE(duration);
            CAPTURE(seed);
            const SyntheticSettings settings{.duration = duration * seconds, .seed = seed};
            const TimeSeries acceleration = make_synthetic_record(settings).find_component("1").series;

            const Intensity intensity = compute_intensity(acceleration);
            CHECK(std::abs(intensity.pga->value.value()) == relative(settings.pga.value(), 1e-12));
            CHECK(std::abs(intensity.pgv->value.value()) == relative(settings.pgv.value(), 1e-9));
            CHECK(acceleration.duration().value() == relative(duration, 1e-12));
            // sums of 10⁴ terms: rounding
            const TimeSeries velocity = integrate(acceleration);
            CHECK(std::abs(velocity.samples().back()) < 1e-12 * settings.pgv.value());
            CHECK(std::abs(integrate(velocity).samples().back()) < 1e-11 * std::abs(intensity.pgd->value.value()));
        }
    }
}

TEST_CASE("other peaks and time steps are met as well") {
    // Denali, Pump Station 10 [Harmon23]: 0.33 g and 161.8 cm/s
    const SyntheticSettings settings{.pga = 0.33 * scaling::kStandardGravity,
                                     .pgv = 1.618 * scaling::si::meters_per_second,
                                     .dt = 0.01 * seconds,
                                     .duration = 80.0 * seconds};
    const Intensity intensity = compute_intensity(make_synthetic_record(settings).components.front().series);
    CHECK(std::abs(intensity.pga->value.value()) == relative(settings.pga.value(), 1e-12));
    CHECK(std::abs(intensity.pgv->value.value()) == relative(1.618, 1e-9));
}

TEST_CASE("a wanted D5-95 is met beside both peaks") {
    for (const double wanted : {3.0, 7.6, 13.0, 22.0}) {
        for (const std::uint64_t seed : {1U, 2U, 3U}) {
            CAPTURE(wanted);
            CAPTURE(seed);
            const SyntheticSettings settings{.dt = 0.01 * seconds, .seed = seed, .d5_95 = wanted * seconds};
            const GroundMotion motion = make_synthetic_record(settings);
            const TimeSeries& acceleration = motion.components.front().series;

            const Intensity intensity = compute_intensity(acceleration);
            CHECK(std::abs(intensity.d5_95->value() / wanted - 1.0) <= kDurationTolerance);
            CHECK(std::abs(intensity.pga->value.value()) == doctest::Approx(settings.pga.value()).epsilon(1e-12));
            CHECK(std::abs(intensity.pgv->value.value()) == doctest::Approx(settings.pgv.value()).epsilon(1e-9));
            CHECK(std::abs(integrate(acceleration).samples().back()) < 1e-12 * settings.pgv.value());
            CHECK(motion.history.front().find("D5-95") != std::string::npos);
        }
    }
}

TEST_CASE("the same seed makes the same record and another seed another") {
    const TimeSeries first = make_synthetic_record({.seed = 7}).components.front().series;
    CHECK(first == make_synthetic_record({.seed = 7}).components.front().series);
    CHECK_FALSE(first == make_synthetic_record({.seed = 8}).components.front().series);
}

// only + − × ÷ and mt19937_64, all of which the standards fix; made with g++ 12 and clang 14, x86-64
TEST_CASE("the default record is the same on every machine") {
    const TimeSeries series = make_synthetic_record().components.front().series;
    REQUIRE(series.size() == 8001);
    CHECK(series.samples()[1000] == -1.5404722953793717);
    CHECK(series.samples()[4000] == -1.6514079399088537);
}

TEST_CASE("settings scaled by powers of two make the scaled record, bit for bit") {
    // λ_l = 1/16: times and velocities by 1/4, accelerations by 1
    SyntheticSettings prototype{.duration = 10.0 * seconds};
    SyntheticSettings model = prototype;
    model.pgv = prototype.pgv / 4.0;
    model.dt = prototype.dt / 4.0;
    model.duration = prototype.duration / 4.0;
    for (const bool with_duration : {false, true}) {
        CAPTURE(with_duration);
        if (with_duration) {
            prototype.d5_95 = 3.3 * seconds;
            model.d5_95 = *prototype.d5_95 / 4.0;
        }
        const TimeSeries full = make_synthetic_record(prototype).components.front().series;
        const TimeSeries small = make_synthetic_record(model).components.front().series;

        REQUIRE(full.size() == small.size());
        CHECK(std::equal(full.samples().begin(), full.samples().end(), small.samples().begin()));
    }
}

TEST_CASE("the synthetic record goes through make_base_motion nearly untouched") {
    const GroundMotion motion = make_synthetic_record();
    const BaseMotion base = make_base_motion(motion, "1");
    CHECK(std::abs(find_peak_velocity(base.velocity).value.value()) == relative(0.424, 1e-9));
}

TEST_CASE("settings that make no record are refused") {
    CHECK_THROWS_AS(make_synthetic_record({.pga = 0.0 * scaling::kStandardGravity}), ProcessingError);
    CHECK_THROWS_AS(make_synthetic_record({.pgv = -1.0 * scaling::si::meters_per_second}), ProcessingError);
    CHECK_THROWS_AS(make_synthetic_record({.dt = 0.0 * seconds}), ProcessingError);
    CHECK_THROWS_AS(make_synthetic_record({.duration = 0.1 * seconds}), ProcessingError);
    CHECK_THROWS_AS(make_synthetic_record({.duration = 1e9 * seconds}), ProcessingError);
    CHECK_THROWS_AS(make_synthetic_record({.d5_95 = 0.0 * seconds}), ProcessingError);
    CHECK_THROWS_AS(make_synthetic_record({.d5_95 = 35.0 * seconds}), ProcessingError);
    CHECK_THROWS_AS(make_synthetic_record({.d5_95 = 80.0 * seconds}), ProcessingError);
    CHECK_THROWS_AS(make_synthetic_record({.d5_95 = 0.05 * seconds}), ProcessingError);
    // 1 m/s within 1 s at 0.01 g is no vibration
    CHECK_THROWS_AS(make_synthetic_record({.pga = 0.01 * scaling::kStandardGravity, .duration = 1.0 * seconds}), ProcessingError);
}

}  // namespace
}  // namespace musim::records
