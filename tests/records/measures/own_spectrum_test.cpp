#include <doctest/doctest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "records/error.hpp"
#include "records/measures/response_spectrum.hpp"
#include "tests/support/relative.hpp"

namespace musim::records {
namespace {

using lsdem::tests::relative;
using scaling::si::hertz;
using scaling::si::seconds;
using std::numbers::pi;

/// 1001 samples, at rest but for a half sine of amplitude `a` over the last quarter.
TimeSeries make_late_pulse(double a, double dt) {
    std::vector<double> samples(1001, 0.0);
    for (std::size_t i = 750; i < 1001; ++i) samples[i] = a * std::sin(pi * static_cast<double>(i - 750) / 250.0);
    return {SampleQuantity::acceleration, 0.0 * seconds, dt * seconds, std::move(samples)};
}

double last_period(const ResponseSpectrum& spectrum) { return spectrum.period.back(); }

}  // namespace

TEST_CASE("a corrected record resolves periods up to its duration, an uncorrected one to a quarter of it or its corner") {
    const TimeSeries series = make_late_pulse(1.0, 0.004);
    const ResponseSpectrum spectrum = compute_own_spectrum(series, std::nullopt);
    CHECK(spectrum.period.size() == 200);
    CHECK(spectrum.period.front() == 4.0 * 0.004);
    CHECK(last_period(spectrum) == series.duration().value());
    CHECK(last_period(compute_own_spectrum(series, 0.05 * hertz)) == 0.25 * series.duration().value());
    CHECK(last_period(compute_own_spectrum(series, 2.0 * hertz)) == 0.5);
    CHECK_THROWS_AS(compute_own_spectrum(series, 0.0 * hertz), ProcessingError);
    // four steps are as long as the shortest period
    const TimeSeries brief{SampleQuantity::acceleration, 0.0 * seconds, 0.004 * seconds, {0.0, 1.0, 2.0, 1.0, 0.0}};
    CHECK(compute_own_spectrum(brief, std::nullopt).period.empty());
}

// Free vibration of an undamped oscillator after a half sine of length τ: PSA = 4(τ/T) cos(πτ/T)/(1 − (2τ/T)²) of its amplitude, reached
// after the pulse when T > 2τ; here T is the record's duration, 4τ.
TEST_CASE("the free vibration after a corrected record counts") {
    const TimeSeries series = make_late_pulse(3.0, 0.004);
    const double expected = 3.0 * std::cos(0.25 * pi) / 0.75;
    // straight lines between samples lose (π/250)²/12 of a sine, peaks between samples (2π/1000)²/8: 2e-5
    CHECK(compute_own_spectrum(series, std::nullopt, 0.0).pseudo_acceleration().back() == relative(expected, 1e-4));
    const std::vector<scaling::Time> longest{series.duration()};
    CHECK(compute_response_spectrum(series, longest, 0.0).pseudo_acceleration().front() < 0.9 * expected);
}

TEST_CASE("a record scaled by powers of two has its own spectrum scaled to the last bit") {
    const TimeSeries series = make_late_pulse(1.3, 0.007), scaled = make_late_pulse(8.0 * 1.3, 0.25 * 0.007);
    for (const std::optional<scaling::Frequency>& corner :
         {std::optional<scaling::Frequency>(), std::optional(0.05 * hertz), std::optional(1.7 * hertz)}) {
        const ResponseSpectrum own = compute_own_spectrum(series, corner),
                               other = compute_own_spectrum(scaled, corner ? std::optional(4.0 * *corner) : std::nullopt);
        REQUIRE(own.period.size() == other.period.size());
        for (std::size_t i = 0; i < own.period.size(); ++i) {
            CHECK(other.period[i] == 0.25 * own.period[i]);
            CHECK(other.displacement[i] == 0.5 * own.displacement[i]);
        }
    }
}

}  // namespace musim::records
