#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "records/measures/intensity.hpp"
#include "records/processing/processing.hpp"
#include "records/synthesis/ricker.hpp"
#include "records/synthesis/sine_sweep.hpp"
#include "records/synthesis/velocity_pulse.hpp"

namespace musim::records {
namespace {

using scaling::si::meters_per_second;
using scaling::si::seconds;
using std::numbers::pi;

const TimeSeries& series_of(const GroundMotion& motion) { return motion.components.front().series; }

double last(const TimeSeries& series) { return series.samples().back(); }

double largest(const TimeSeries& series) {
    double most = 0.0;
    for (const double sample : series.samples()) most = std::max(most, std::abs(sample));
    return most;
}

/// Is `small` the record `full` with times over 4, velocities over 4, accelerations the same, bit for bit?
void check_scaled(const TimeSeries& full, const TimeSeries& small) {
    REQUIRE(full.size() == small.size());
    CHECK(small.dt() * 4.0 == full.dt());
    CHECK(std::equal(full.samples().begin(), full.samples().end(), small.samples().begin()));
}

TEST_CASE("a Ricker record has its PGA at its middle and ends at rest where it began") {
    for (const double dt : {0.003, 0.01, 0.06}) {
        CAPTURE(dt);
        const RickerWavelet wavelet{.amplitude = 3.0 * scaling::si::meters_per_second_squared, .frequency = 2.0 / seconds};
        const GroundMotion motion = make_ricker_record(wavelet, dt * seconds);
        const TimeSeries& acceleration = series_of(motion);
        CHECK(acceleration.samples()[acceleration.size() / 2] == 3.0);
        CHECK(largest(acceleration) == 3.0);
        CHECK(motion.history.size() == 1);
        // aliasing of the samples: (F/f)² e^{−(F/f)²}, F = 1/dt, is nothing at F = 8 f; rounding of some 1000 terms is left
        const TimeSeries velocity = integrate(acceleration), displacement = integrate(velocity);
        CHECK(std::abs(last(velocity)) < 1e-13 * largest(velocity));
        CHECK(std::abs(last(displacement)) < 1e-12 * largest(displacement));
    }
}

TEST_CASE("the velocity of a Ricker wavelet is the integral of its acceleration") {
    const RickerWavelet wavelet{.frequency = 2.0 / seconds};
    const TimeSeries velocity = integrate(series_of(make_ricker_record(wavelet, 0.0005 * seconds)));
    const double middle = 0.5 * velocity.duration().value();
    // trapezoids: h² |a'|/12 with |a'| < 9 f A: 9/8 of (f h)² of the largest velocity, which is 0.14 A/f
    double worst = 0.0;
    for (std::size_t i = 0; i < velocity.size(); ++i) {
        const scaling::Time tau = velocity.time(i) - middle * seconds;
        worst = std::max(worst, std::abs(velocity.samples()[i] - wavelet.velocity(tau).value()));
    }
    CHECK(worst < 1e-5 * largest(velocity));
}

TEST_CASE("closed forms of the velocity pulse are derivatives of each other") {
    for (const double cycles : {1.01, 1.5, 2.0, 3.3}) {
        for (const double phase : {0.0, 40.0, 90.0, -135.0}) {
            CAPTURE(cycles);
            CAPTURE(phase);
            const VelocityPulse pulse{.frequency = 0.8 / seconds, .cycles = cycles, .phase_deg = phase};
            const double half = 0.5 * cycles / 0.8, h = 1e-4;
            for (double t = -0.95 * half; t < half - h; t += 0.07 * half) {
                const auto at = [&](double shift) { return (t + shift) * seconds; };
                // central differences: h²/6 of the third derivative, (2π 1.6 · 1e-4)²/6 = 2e-7 of the amplitude
                const double rate_v = (pulse.velocity(at(h)) - pulse.velocity(at(-h))).value() / (2.0 * h);
                const double rate_d = (pulse.displacement(at(h)) - pulse.displacement(at(-h))).value() / (2.0 * h);
                CHECK(std::abs(pulse.acceleration(at(0.0)).value() - rate_v) < 5e-7 * 0.5 * 2.0 * pi * 0.8);
                CHECK(std::abs(pulse.velocity(at(0.0)).value() - rate_d) < 5e-7 * 0.5);
            }
            const scaling::Time end = half * seconds;
            CHECK(pulse.velocity(1.1 * end).value() == 0.0);
            CHECK(pulse.acceleration(-1.1 * end).value() == 0.0);
            // rounding in units of A/f_p, enlarged by 1/(γ − 1)
            CHECK(std::abs(pulse.displacement(-end).value()) < 1e-12);
            CHECK(std::abs((pulse.displacement(end * (1.0 - 1e-9)) - pulse.residual_displacement()).value()) < 1e-12);
        }
    }
}

TEST_CASE("a velocity pulse's record ends at rest, displaced as the closed form says or back home") {
    for (const double phase : {0.0, 60.0}) {
        CAPTURE(phase);
        const VelocityPulse pulse{.amplitude = 1.2 * meters_per_second, .frequency = 0.5 / seconds, .cycles = 2.4, .phase_deg = phase};
        const TimeSeries displaced = series_of(make_velocity_pulse_record(pulse, 0.005 * seconds)),
                         home = series_of(make_velocity_pulse_record(pulse, 0.005 * seconds, true));
        const TimeSeries velocity = integrate(displaced), displacement = integrate(velocity);
        CHECK(std::abs(last(velocity)) < 1e-12);
        CHECK(std::abs(last(integrate(home))) < 1e-12);
        CHECK(last(displacement) == doctest::Approx(pulse.residual_displacement().value()).epsilon(1e-9));
        CHECK(std::abs(last(integrate(integrate(home)))) < 1e-9);
        CHECK(std::abs(pulse.residual_displacement().value()) > 0.01);
        // sampling: (2π f h)²/12 = 2e-5, and as much for the correction
        for (std::size_t i = 0; i < velocity.size(); i += 10) {
            const scaling::Time tau = velocity.time(i) - 0.5 * velocity.duration();
            CHECK(std::abs(velocity.samples()[i] - pulse.velocity(tau).value()) < 1e-4 * 1.2);
        }
        if (phase == 0.0) CHECK(largest(velocity) == doctest::Approx(1.2).epsilon(1e-4));
    }
    const std::string history = make_velocity_pulse_record({.cycles = 2.5}, 0.005 * seconds, true).history.front();
    CHECK(history.find("instead of") != std::string::npos);
    CHECK(history.find("gamma 2.5") != std::string::npos);
}

/// Zero crossings within a window of time.
int count_crossings(const TimeSeries& series, double from, double to) {
    int crossings = 0;
    for (std::size_t i = 1; i < series.size(); ++i) {
        const double t = series.time(i).value();
        if (t >= from && t < to && (series.samples()[i - 1] < 0.0) != (series.samples()[i] < 0.0)) ++crossings;
    }
    return crossings;
}

TEST_CASE("a sweep passes its frequencies in even steps, of Hz or of octaves, and ends at rest") {
    const SineSweepSettings settings{.first = 1.0 / seconds, .last = 16.0 / seconds, .duration = 40.0 * seconds};
    for (const SweepKind kind : {SweepKind::linear, SweepKind::logarithmic}) {
        SineSweepSettings chosen = settings;
        chosen.kind = kind;
        const GroundMotion motion = make_sine_sweep_record(chosen);
        const TimeSeries& acceleration = series_of(motion);
        // cycles between 10 s and 30 s: 8.5 Hz · 20 s, or T/ln 16 · (16^{3/4} − 16^{1/4}); two crossings each, one more or less at the ends
        const double cycles = kind == SweepKind::linear ? 170.0 : 40.0 / std::log(16.0) * (8.0 - 2.0);
        CHECK(std::abs(count_crossings(acceleration, 10.0, 30.0) - 2.0 * cycles) <= 2.0);
        const double amplitude = settings.amplitude.value();
        // the correction to rest, and 12 samples a period
        CHECK(largest(acceleration) == doctest::Approx(amplitude).epsilon(0.02));
        const TimeSeries velocity = integrate(acceleration), displacement = integrate(velocity);
        CHECK(std::abs(last(velocity)) < 1e-12 * largest(velocity));
        CHECK(std::abs(last(displacement)) < 1e-9 * largest(displacement));
        CHECK(acceleration.samples().front() == 0.0);
        CHECK(std::abs(last(acceleration)) < 1e-12 * amplitude);
    }
    SineSweepSettings down = settings;
    std::swap(down.first, down.last);
    CHECK(count_crossings(series_of(make_sine_sweep_record(down)), 2.0, 4.0) >
          count_crossings(series_of(make_sine_sweep_record(down)), 36.0, 38.0));
}

TEST_CASE("made records scaled by powers of two are the scaled records, bit for bit") {
    // λ_l = 1/16: times and velocities by 1/4, accelerations by 1
    const auto hertz = [](double value) { return value / seconds; };
    check_scaled(series_of(make_ricker_record({.frequency = hertz(1.3)}, 0.01 * seconds)),
                 series_of(make_ricker_record({.frequency = hertz(1.3) * 4.0}, 0.01 * seconds / 4.0)));
    const VelocityPulse pulse{.amplitude = 0.7 * meters_per_second, .frequency = hertz(0.6), .cycles = 1.7, .phase_deg = 25.0};
    VelocityPulse small_pulse = pulse;
    small_pulse.amplitude /= 4.0;
    small_pulse.frequency *= 4.0;
    for (const bool home : {false, true}) {
        check_scaled(series_of(make_velocity_pulse_record(pulse, 0.01 * seconds, home)),
                     series_of(make_velocity_pulse_record(small_pulse, 0.01 * seconds / 4.0, home)));
    }
    for (const SweepKind kind : {SweepKind::linear, SweepKind::logarithmic}) {
        const SineSweepSettings sweep{.kind = kind};
        SineSweepSettings small_sweep = sweep;
        small_sweep.first *= 4.0;
        small_sweep.last *= 4.0;
        small_sweep.dt /= 4.0;
        small_sweep.duration /= 4.0;
        check_scaled(series_of(make_sine_sweep_record(sweep)), series_of(make_sine_sweep_record(small_sweep)));
    }
}

TEST_CASE("parameters that make no record are refused") {
    const auto hertz = [](double value) { return value / seconds; };
    CHECK_THROWS_AS(make_ricker_record({.amplitude = {}}), ProcessingError);
    CHECK_THROWS_AS(make_ricker_record({.frequency = hertz(-1.0)}), ProcessingError);
    CHECK_THROWS_AS(make_ricker_record({.frequency = hertz(1.0)}, 0.2 * seconds), ProcessingError);
    CHECK_THROWS_AS(make_ricker_record({.frequency = hertz(1e-9)}, 0.001 * seconds), ProcessingError);
    CHECK_THROWS_AS(make_velocity_pulse_record({.amplitude = {}}), ProcessingError);
    CHECK_THROWS_AS(make_velocity_pulse_record({.cycles = 1.0}), ProcessingError);
    CHECK_THROWS_AS(make_velocity_pulse_record({.phase_deg = std::numeric_limits<double>::quiet_NaN()}), ProcessingError);
    CHECK_THROWS_AS(make_velocity_pulse_record({.frequency = hertz(50.0)}), ProcessingError);
    CHECK_THROWS_AS(make_sine_sweep_record({.first = hertz(2.0), .last = hertz(2.0)}), ProcessingError);
    CHECK_THROWS_AS(make_sine_sweep_record({.last = hertz(60.0)}), ProcessingError);
    CHECK_THROWS_AS(make_sine_sweep_record({.duration = 0.1 * seconds}), ProcessingError);
    CHECK_THROWS_AS(make_sine_sweep_record({.taper = 0.6}), ProcessingError);
}

}  // namespace
}  // namespace musim::records
