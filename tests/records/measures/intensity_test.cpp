#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>

#include "records/measures/intensity.hpp"
#include "records/processing/processing.hpp"
#include "tests/support/relative.hpp"

namespace musim::records {
namespace {

using lsdem::tests::relative;
using scaling::si::seconds;
using std::numbers::pi;

// a = A sin(2πft) over whole periods
TimeSeries make_sine(double amplitude, double frequency, double duration, double dt) {
    std::vector<double> samples;
    const auto steps = static_cast<int>(std::lround(duration / dt));
    for (int i = 0; i <= steps; ++i) samples.push_back(amplitude * std::sin(2.0 * pi * frequency * dt * i));
    return {SampleQuantity::acceleration, 5.0 * seconds, dt * seconds, std::move(samples)};
}

TEST_CASE("a sine has the intensity measures of the closed forms") {
    const double amplitude = 2.0;  // [m/s²]
    const Intensity intensity = compute_intensity(make_sine(amplitude, 1.0, 10.0, 0.001));

    CHECK(intensity.pga->value.value() == relative(amplitude, 1e-9));
    CHECK(intensity.pga->time.value() == doctest::Approx(5.25));
    // v = A/(2πf) (1 − cos 2πft): peak A/(πf); trapezoid error (ωdt)²/12 = 3e-6
    CHECK(intensity.pgv->value.value() == relative(amplitude / pi, 1e-5));
    CHECK(std::fmod(intensity.pgv->time.value(), 1.0) == doctest::Approx(0.5));
    // d = A/(2πf) (t − ...): A/(2πf)·10 s at the end
    CHECK(intensity.pgd->value.value() == relative(amplitude / (2.0 * pi) * 10.0, 1e-5));
    // π/(2g) A²/2 T; exact for whole periods
    CHECK(intensity.arias->value() == relative(pi / (2.0 * 9.80665) * 0.5 * amplitude * amplitude * 10.0, 1e-9));
    // energy grows evenly but for a ripple of 1/(4πf) about each end
    CHECK(std::abs(intensity.d5_95->value() - 9.0) < 1.0 / (2.0 * pi));
}

TEST_CASE("a constant acceleration has a significant duration of nine tenths") {
    const TimeSeries series(SampleQuantity::acceleration, 0.0 * seconds, 0.01 * seconds, std::vector<double>(1001, 1.0));
    CHECK(compute_significant_duration(series).value() == relative(9.0, 1e-9));
    CHECK(compute_significant_duration(series, 0.05, 0.75).value() == relative(7.0, 1e-9));
    CHECK(compute_significant_duration(series, 0.0, 1.0).value() == relative(10.0, 1e-9));
    for (const auto& [from, to] : {std::pair{-0.1, 0.5}, {0.5, 0.5}, {0.6, 0.5}, {0.5, 1.1}, {std::nan(""), 0.5}})
        CHECK_THROWS_AS(compute_significant_duration(series, from, to), ProcessingError);
}

TEST_CASE("only uncorrected records are leveled before they are measured") {
    const TimeSeries series(SampleQuantity::acceleration, 0.0 * seconds, 0.01 * seconds, {1.0, 1.0, 3.0});
    CHECK(level_uncorrected(series, std::nullopt) == series);
    CHECK(level_uncorrected(series, 0.05 / seconds) == series.with_samples({0.0, 0.0, 2.0}));
}

// A sine from the first sample on: the mean of its first 1/64 is far from zero, that of all is not.
TEST_CASE("the level of an uncorrected record that begins in motion is the mean of all samples") {
    constexpr double kOffset = 3.0, kAmplitude = 2.0;
    std::vector<double> samples;
    for (int i = 0; i < 1600; ++i) samples.push_back(kOffset + kAmplitude * std::sin(2.0 * pi * i / 100.0));
    const TimeSeries moving(SampleQuantity::acceleration, 0.0 * seconds, 0.01 * seconds, samples);
    CHECK(begins_in_motion(moving));
    CHECK(compute_intensity(moving, 0.05 / seconds).pga->value.value() == relative(kAmplitude, 1e-12));

    // at rest first, whatever the mean of what follows
    std::fill(samples.begin(), samples.begin() + 50, kOffset);
    for (std::size_t i = 800; i < samples.size(); ++i) samples[i] += 0.5 * kAmplitude;
    const TimeSeries at_rest_first = moving.with_samples(samples);
    CHECK_FALSE(begins_in_motion(at_rest_first));
    CHECK(compute_intensity(at_rest_first, 0.05 / seconds).pga->value.value() == relative(1.5 * kAmplitude, 1e-12));
}

TEST_CASE("peaks keep their sign and the first of equals wins") {
    const TimeSeries series(SampleQuantity::velocity, 1.0 * seconds, 0.5 * seconds, {1.0, -3.0, 3.0, 2.0});
    CHECK(find_peak_velocity(series).value.value() == -3.0);
    CHECK(find_peak_velocity(series).time.value() == 1.5);
    CHECK_THROWS_AS(find_peak_acceleration(series), ProcessingError);
    CHECK_THROWS_AS(compute_arias_intensity(series), ProcessingError);
}

TEST_CASE("a velocity record gives no acceleration measures") {
    const Intensity intensity = compute_intensity({SampleQuantity::velocity, 0.0 * seconds, 0.5 * seconds, {0.0, 1.0, 0.0}});
    CHECK_FALSE(intensity.pga);
    CHECK_FALSE(intensity.arias);
    CHECK(intensity.pgv->value.value() == 1.0);
    CHECK(intensity.pgd->value.value() == 0.5);
}

TEST_CASE("a record without motion has intensity zero") {
    const Intensity intensity = compute_intensity({SampleQuantity::acceleration, 0.0 * seconds, 0.5 * seconds, {0.0, 0.0, 0.0}});
    CHECK(intensity.arias->value() == 0.0);
    CHECK(intensity.d5_95->value() == 0.0);
}

}  // namespace
}  // namespace musim::records
