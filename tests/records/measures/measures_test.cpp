#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "records/formats/read_record.hpp"
#include "records/measures/intensity.hpp"
#include "records/measures/measures.hpp"
#include "tests/support/relative.hpp"
#include "tests/support/shared_records.hpp"

namespace musim::records {
namespace {

using lsdem::tests::relative;
using scaling::si::hertz;
using scaling::si::meters_per_second_squared;
using scaling::si::seconds;
using std::numbers::pi;

TimeSeries make_acceleration(std::vector<double> samples, double dt) {
    return {SampleQuantity::acceleration, 0.0 * seconds, dt * seconds, std::move(samples)};
}

TimeSeries make_counted_sine(double amplitude, double frequency, std::size_t count, double dt) {
    std::vector<double> samples;
    for (std::size_t i = 0; i < count; ++i) samples.push_back(amplitude * std::sin(2.0 * pi * frequency * dt * static_cast<double>(i)));
    return make_acceleration(std::move(samples), dt);
}

TEST_CASE("measures of a sine are those of the closed forms") {
    // 10 whole periods of 1 Hz, 1000 samples each: trapezoids are exact to (π/500)²/6 of the curve between samples
    const TimeSeries sine = make_counted_sine(2.0, 1.0, 10001, 1e-3);
    CHECK(compute_cumulative_absolute_velocity(sine).value() == relative(2.0 * 10.0 * 2.0 / pi, 1e-5));
    CHECK(compute_rms_acceleration(sine).value() == relative(2.0 / std::sqrt(2.0), 1e-9));
    // |sin| ≥ 1/2 first at 1/12 of a period, last at 1/12 before the end; both are found to a sample
    const auto bracketed = compute_bracketed_duration(sine, 1.0 * meters_per_second_squared);
    REQUIRE(bracketed);
    CHECK(bracketed->value() == relative(10.0 - 2.0 / 12.0, 2e-3 / 9.8));
    CHECK_FALSE(compute_bracketed_duration(sine, 3.0 * meters_per_second_squared));
    CHECK_THROWS_AS(compute_bracketed_duration(sine, 0.0 * meters_per_second_squared), ProcessingError);
    CHECK(compute_rms_acceleration(make_acceleration({-3.0}, 0.01)).value() == 3.0);
}

TEST_CASE("Fourier amplitudes find a sine, and hold the energy of any record") {
    const TimeSeries sine = make_counted_sine(2.0, 5.0, 4000, 1e-3);
    const FourierAmplitudes spectrum = compute_fourier_amplitudes(sine);
    CHECK(spectrum.step.value() == relative(0.25, 1e-14));
    REQUIRE(spectrum.amplitude.size() == 2001);
    CHECK(spectrum.amplitude[20] == relative(2.0 * 4.0 / 2.0, 1e-12));
    CHECK(spectrum.amplitude[21] < 1e-12);
    CHECK(compute_mean_period(spectrum, 0.25 * hertz, 20.0 * hertz)->value() == relative(0.2, 1e-12));
    CHECK_FALSE(compute_mean_period(spectrum, 600.0 * hertz, 601.0 * hertz));
    CHECK_THROWS_AS(compute_mean_period(spectrum, 2.0 * hertz, 1.0 * hertz), ProcessingError);

    for (const std::size_t count : {std::size_t{1}, std::size_t{2}, std::size_t{997}, std::size_t{1024}}) {
        CAPTURE(count);
        std::vector<double> noise;
        for (std::size_t i = 0; i < count; ++i) noise.push_back(std::cos(static_cast<double>(i * i % 101)));
        const FourierAmplitudes whole = compute_fourier_amplitudes(make_acceleration(noise, 0.02));
        double in_time = 0.0, in_frequency = 0.0;
        for (const double a : noise) in_time += 0.02 * a * a;
        for (std::size_t i = 0; i < whole.amplitude.size(); ++i) {
            const bool alone = i == 0 || (count % 2 == 0 && i == count / 2);
            in_frequency += (alone ? 1.0 : 2.0) * whole.amplitude[i] * whole.amplitude[i] * whole.step.value();
        }
        CHECK(in_frequency == relative(in_time, 1e-12));
    }
}

TEST_CASE("a sine's predominant and pulse periods are its own") {
    const TimeSeries sine = make_counted_sine(1.0, 2.0, 20000, 2e-3);
    const std::vector<scaling::Time> periods = make_periods(0.05 * seconds, 5.0 * seconds, 401);
    const ResponseSpectrum spectrum = compute_response_spectrum(sine, periods);
    const double grid = std::pow(100.0, 1.0 / 400.0) - 1.0;
    CHECK(find_predominant_period(spectrum)->value() == relative(0.5, grid));
    CHECK(find_pulse_period(spectrum)->value() == relative(0.5, grid));
    const ResponseSpectrum silent = compute_response_spectrum(make_acceleration(std::vector<double>(10, 0.0), 0.01), periods);
    CHECK_FALSE(find_predominant_period(silent));
}

TEST_CASE("eqsig's test motion has eqsig's measures") {
    if (!tests::have_shared_records()) return;
    const TimeSeries motion = read_record(tests::shared_records() / "text" / "test_motion_dt0p01.txt").components.at(0).series;
    const Intensity intensity = compute_intensity(motion);
    CHECK(std::abs(intensity.pga->value.value()) == relative(1.41, 1e-5));
    CHECK(std::abs(intensity.pgv->value.value()) == relative(0.26006, 2e-5));
    CHECK(std::abs(intensity.pgd->value.value()) == relative(0.07278134, 1e-6));
    // eqsig has g = 9.81
    CHECK(compute_arias_intensity(motion, 9.81 * meters_per_second_squared).value() == relative(0.63398, 1e-5));
    CHECK(compute_cumulative_absolute_velocity(motion).value() == relative(8.53872, 1e-6));
    // eqsig takes the samples beyond 5 and 95 %, we the instants: a step at each end
    CHECK(compute_significant_duration(motion).value() == relative(20.99, 0.02 / 20.99));
}

}  // namespace
}  // namespace musim::records
