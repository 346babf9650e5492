#include "lsdem/response/structural_speed.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <stdexcept>
#include <string>
#include <vector>

#include "lsdem/run/simulate.hpp"
#include "tests/support/models.hpp"

using namespace musim::lsdem;

namespace {

/// A Ricker wavelet of frequency f that passes at t = 0.
double ricker(double f, double t) {
    const double x = std::pow(std::numbers::pi * f * t, 2);
    return (1.0 - 2.0 * x) * std::exp(-x);
}

/// Pseudorandom value in [-1, 1] from a place (SplitMix64).
double noise(std::uint64_t place) {
    std::uint64_t z = (place + 1) * 0x9E3779B97F4A7C15ULL;
    z = (z ^ (z >> 30U)) * 0xBF58476D1CE4E5B9ULL;
    z = (z ^ (z >> 27U)) * 0x94D049BB133111EBULL;
    return static_cast<double>((z ^ (z >> 31U)) >> 11U) / 4503599627370496.0 - 1.0;
}

constexpr double kFrequency = 10.0, kStep = 0.001;  // [Hz], [s]: 100 samples a period
constexpr double kSpeed = 137.0;                    // [m/s]

/// A pulse that travels upward at `speed`(height), with noise of a fraction of its peak.
template <class Delay>
Receivers make_pulse(const Delay& delay, double level_of_noise = 0.0) {
    Receivers receivers;
    receivers.dt = kStep;
    for (std::size_t i = 0; i < 12; ++i) {
        receivers.height.push_back(1.0 + 2.0 * static_cast<double>(i));
        std::vector<double> v;
        for (std::size_t k = 0; k < 1200; ++k) {
            const double t = kStep * static_cast<double>(k) - 0.3 - delay(2.0 * static_cast<double>(i));
            v.push_back(ricker(kFrequency, t) + level_of_noise * noise(1200 * i + k));
        }
        receivers.velocity.push_back(v);
    }
    return receivers;
}

const SpeedEstimate& find(const std::vector<SpeedEstimate>& estimates, const std::string& method) {
    for (const SpeedEstimate& estimate : estimates)
        if (estimate.method == method) return estimate;
    throw std::logic_error("no estimate " + method);
}

}  // namespace

TEST_CASE("a pulse that travels upward unchanged gives its speed by every estimator") {
    const auto estimates = estimate_speeds(make_pulse([](double z) { return z / kSpeed; }));
    REQUIRE(estimates.size() == 4);
    for (const SpeedEstimate& e : estimates) {
        CAPTURE(e.method);
        REQUIRE(e.speed.has_value());
        // a line between samples errs by h²|v''|/(8|v'|), a parabola by less: with ωh = 0.063 below 0.005 h, over the lag of 160 h. The
        // deconvolved peak is a sinc of the band that the water level leaves, below three times f: the parabola errs by (3ωh)²/10 h
        CHECK(*e.speed == doctest::Approx(kSpeed).epsilon(e.method == "deconvolution" ? 1e-4 : 5e-5));
        CHECK(e.speed_error < 1e-3 * kSpeed);
        CHECK(e.why.empty());
        CHECK(e.height.size() == 12);
    }
}

TEST_CASE("noise widens the error of a speed and its interval still holds the truth") {
    const auto clean = estimate_speeds(make_pulse([](double z) { return z / kSpeed; }));
    const auto noisy = estimate_speeds(make_pulse([](double z) { return z / kSpeed; }, 0.05));
    // first arrival is left out: noise of half the threshold moves it by a chance that is not symmetric
    for (const char* method : {"cross_correlation", "peak", "deconvolution"}) {
        CAPTURE(method);
        const SpeedEstimate& e = find(noisy, method);
        REQUIRE(e.slowness.has_value());
        CHECK(e.slowness_error > find(clean, method).slowness_error);
        // four standard errors with ten degrees of freedom: one in 400
        CHECK(std::abs(*e.slowness - 1.0 / kSpeed) < 4.0 * e.slowness_error);
    }
}

TEST_CASE("a pulse that slows down on its way gives the least-squares slope of its arrival times") {
    const double slowing = 2e-5;  // [s/m²]
    const auto delay = [&](double z) { return z / kSpeed + slowing * z * z; };
    const auto estimates = estimate_speeds(make_pulse(delay));
    // a parabola over evenly spaced heights 0 ... 22 m has the mean slope 1/c + 22·slowing
    const double slope = 1.0 / kSpeed + 22.0 * slowing;
    for (const SpeedEstimate& e : estimates) {
        CAPTURE(e.method);
        REQUIRE(e.slowness.has_value());
        CHECK(*e.slowness == doctest::Approx(slope).epsilon(2e-4));
        // the residuals of a parabola are not noise, yet they show as error: z² about its line has a deviation of 22²/(6√5) or so
        CHECK(e.slowness_error > 1e-5);
    }
}

TEST_CASE("a motion that reaches all heights at once has no speed, and says so") {
    for (const SpeedEstimate& e : estimate_speeds(make_pulse([](double) { return 0.0; }))) {
        CAPTURE(e.method);
        CHECK_FALSE(e.speed.has_value());
        CHECK(e.why == "the lag does not grow with height by more than its scatter");
    }
}

TEST_CASE("a motion that comes from above has no upward speed but a negative slowness") {
    for (const SpeedEstimate& e : estimate_speeds(make_pulse([](double z) { return -z / kSpeed; }))) {
        CAPTURE(e.method);
        CHECK_FALSE(e.speed.has_value());
        CHECK(e.slowness.value_or(0.0) == doctest::Approx(-1.0 / kSpeed).epsilon(2e-4));
    }
}

TEST_CASE("histories without motion, and too few of them, have no speed and say why") {
    Receivers still = make_pulse([](double) { return 0.0; });
    for (auto& v : still.velocity) v.assign(v.size(), 0.0);
    for (const SpeedEstimate& e : estimate_speeds(still)) CHECK(e.why == "nothing moves");

    Receivers two = make_pulse([](double) { return 0.0; });
    two.height.resize(2);
    two.velocity.resize(2);
    for (const SpeedEstimate& e : estimate_speeds(two)) CHECK(e.why == "fewer than three levels are kept");

    Receivers bad = make_pulse([](double) { return 0.0; });
    bad.velocity[3].pop_back();
    CHECK_THROWS_AS(estimate_speeds(bad), std::invalid_argument);
}

TEST_CASE("levels that never reach the threshold are left out of the first arrival") {
    Receivers fading = make_pulse([](double z) { return z / kSpeed; });
    for (std::size_t i = 6; i < 12; ++i)
        for (double& v : fading.velocity[i]) v *= 0.05;
    const SpeedEstimate e = find(estimate_speeds(fading), "first_arrival");
    CHECK(e.height.size() == 6);
    CHECK(e.speed.value_or(0.0) == doctest::Approx(kSpeed).epsilon(1e-4));
}

// A base that outruns its column: behind the front the long-wave solution is v = μg[t + (l − 2z)/c_e], so that equal velocities climb with
// c_e/2.
TEST_CASE("in a slipping column equal velocities climb at half of the elastic speed") {
    namespace lsdem = musim::lsdem;
    constexpr std::size_t kBlocks = 38;
    const tests::Stone stone = tests::wood();
    Specimen specimen;
    specimen.model = tests::make_resting_column(stone, kBlocks, true);
    for (std::size_t i = 0; i < kBlocks; ++i) {
        specimen.spine.block.push_back(i);
        specimen.spine.level.push_back(static_cast<int>(i) + 1);
    }
    const double height = kBlocks * stone.size.z(), elastic = stone.size.z() * std::sqrt(stone.shear_stiffness / stone.mass());
    // faster than the lowest block will be within the run, 2.5 l/c_e
    const double base = 8.0 * stone.friction * tests::kGravity * height / elastic;
    specimen.model.ground.motion.shift[0] = {.start = 0.0, .dt = 0.0, .velocity = {base}};
    const double step = 0.05 * stone.size.z() / elastic;
    const RunResult run = simulate(
        specimen, {.time_step = step, .steps_per_sample = 1, .samples = static_cast<std::uint64_t>(2.5 * height / elastic / step)});

    Receivers receivers;
    receivers.dt = step;
    for (std::size_t i = 0; i < kBlocks; ++i) {
        receivers.height.push_back(run.initial.position[i].z());
        receivers.velocity.emplace_back();
        for (std::size_t k = 0; k < run.history.samples(); ++k)
            receivers.velocity.back().push_back(run.history.spine_velocity[k * kBlocks + i].x());
    }
    // the velocity that every level reaches behind the front: μ g l/c_e
    const double level = stone.friction * tests::kGravity * height / elastic;
    const SpeedEstimate first = find(estimate_speeds(receivers, {.threshold = level / base, .reference_peak = base}), "first_arrival");
    REQUIRE(first.speed.has_value());
    INFO("slip front: " << *first.speed / elastic << " c_e");
    // long waves are those of many blocks: with 38 of them a chain shows 0.509
    CHECK(*first.speed / elastic == doctest::Approx(0.5).epsilon(0.03));
}
