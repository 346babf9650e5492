#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "records/processing/butterworth.hpp"
#include "records/processing/processing.hpp"
#include "tests/support/relative.hpp"

namespace musim::records {
namespace {

using lsdem::tests::relative;
using scaling::si::hertz;
using scaling::si::seconds;
using std::numbers::pi;

constexpr double kInterval = 0.01;

TimeSeries make_sine(double frequency, double seconds_long) {
    std::vector<double> samples;
    for (int i = 0; kInterval * i < seconds_long; ++i) samples.push_back(std::sin(2.0 * pi * frequency * kInterval * i));
    return {SampleQuantity::acceleration, 0.0 * seconds, kInterval * seconds, std::move(samples)};
}

/// Largest sample of the middle half.
double middle_amplitude(const TimeSeries& series) {
    double most = 0.0;
    for (std::size_t i = series.size() / 4; i < 3 * series.size() / 4; ++i) most = std::max(most, std::abs(series.samples()[i]));
    return most;
}

/// |H|² of one run at a corner, with K = tan(π f dt).
double gain(double f, double corner, int order, bool low) {
    const double ratio = std::tan(pi * f * kInterval) / std::tan(pi * corner * kInterval);
    return 1.0 / (1.0 + std::pow(low ? ratio : 1.0 / ratio, 2 * order));
}

TEST_CASE("amplitudes are Butterworth's, one run and two, above, below and between") {
    for (int order = 1; order <= 8; ++order)
        for (const double f : {0.5, 1.0, 2.0, 4.0}) {
            CAPTURE(order);
            CAPTURE(f);
            const TimeSeries sine = make_sine(f, 100.0);
            const FilterBand low{.high = 1.5 * hertz}, high{.low = 1.5 * hertz}, band{.low = 0.8 * hertz, .high = 2.5 * hertz};
            // the sine's own samples miss its peak by up to (π f dt)²/2
            const double tolerance = 1e-3 + std::pow(pi * f * kInterval, 2) / 2.0;
            CHECK(middle_amplitude(apply_butterworth(sine, low, order)) == relative(gain(f, 1.5, order, true), tolerance));
            CHECK(middle_amplitude(apply_butterworth(sine, high, order)) == relative(gain(f, 1.5, order, false), tolerance));
            CHECK(middle_amplitude(apply_butterworth(sine, low, order, FilterPhase::causal)) ==
                  doctest::Approx(std::sqrt(gain(f, 1.5, order, true))).epsilon(tolerance));
            CHECK(middle_amplitude(apply_butterworth(sine, band, order)) ==
                  relative(gain(f, 0.8, order, false) * gain(f, 2.5, order, true), tolerance));
        }
}

TEST_CASE("a causal filter moves nothing before its cause, a two-pass filter keeps the time of a pulse") {
    std::vector<double> blow(2001, 0.0);
    blow[1000] = 1.0;
    const TimeSeries pulse{SampleQuantity::acceleration, 0.0 * seconds, kInterval * seconds, blow};
    const TimeSeries causal = apply_butterworth(pulse, {.high = 5.0 * hertz}, 4, FilterPhase::causal);
    for (std::size_t i = 0; i < 1000; ++i) CHECK(causal.samples()[i] == 0.0);
    const TimeSeries both = apply_butterworth(pulse, {.high = 5.0 * hertz}, 4);
    const auto peak = std::max_element(both.samples().begin(), both.samples().end()) - both.samples().begin();
    CHECK(peak == 1000);
    for (std::size_t i = 1; i < 500; ++i) CHECK(both.samples()[1000 + i] == relative(both.samples()[1000 - i], 1e-9).scale(1e-3));
}

TEST_CASE("impossible filters are refused in words") {
    const TimeSeries sine = make_sine(1.0, 10.0);
    CHECK_THROWS_WITH_AS(apply_butterworth(sine, {}, 2), "a filter has no corner (it would change nothing); give a low or a high corner",
                         ProcessingError);
    CHECK_THROWS_WITH_AS(apply_butterworth(sine, {.high = 60.0 * hertz}, 2),
                         "low-pass corner is 60 Hz (must be between 0 and the Nyquist frequency 50 Hz); change it", ProcessingError);
    CHECK_THROWS_WITH_AS(apply_butterworth(sine, {.low = 2.0 * hertz, .high = 1.0 * hertz}, 2),
                         "band-pass lies between 2 and 1 Hz (the first must be below the second); exchange them", ProcessingError);
    CHECK_THROWS_WITH_AS(apply_butterworth(sine, {.low = 1.0 * hertz}, 9), "high-pass order is 9 (must be 1 to 8); choose one of these",
                         ProcessingError);
}

TEST_CASE("padding keeps times, a motion brought to rest ends there, and integrals in both domains agree") {
    const TimeSeries sine = make_sine(1.0, 10.0);
    const TimeSeries padded = pad(sine, 2.0 * seconds, 3.0 * seconds);
    CHECK(padded.size() == sine.size() + 500);
    CHECK(padded.start().value() == doctest::Approx(-2.0));
    CHECK(padded.samples()[200 + 25] == sine.samples()[25]);
    CHECK_THROWS_AS(pad(sine, -1.0 * seconds, 0.0 * seconds), ProcessingError);

    const TimeSeries rest = bring_to_rest(make_sine(0.37, 11.3)), velocity = integrate(rest), displacement = integrate(velocity);
    CHECK(std::abs(velocity.samples().back()) < 1e-12);
    CHECK(std::abs(displacement.samples().back()) < 1e-11);

    // a packet at rest at its ends: trapezoids are off by (2πf dt)²/12
    std::vector<double> samples;
    for (int i = 0; i < 2000; ++i)
        samples.push_back(std::exp(-0.5 * std::pow((kInterval * i - 10.0) / 1.5, 2)) * std::sin(2.0 * pi * 2.0 * kInterval * i));
    const TimeSeries packet{SampleQuantity::velocity, 0.0 * seconds, kInterval * seconds, samples};
    const TimeSeries one = integrate(packet), two = integrate_by_frequency(packet);
    CHECK(two.quantity() == SampleQuantity::displacement);
    double mean = 0.0, worst = 0.0, most = 0.0;
    for (std::size_t i = 0; i < one.size(); ++i) mean += (one.samples()[i] - two.samples()[i]) / static_cast<double>(one.size());
    for (std::size_t i = 0; i < one.size(); ++i) {
        worst = std::max(worst, std::abs(one.samples()[i] - two.samples()[i] - mean));
        most = std::max(most, std::abs(one.samples()[i]));
    }
    CHECK(worst < 2.0 * std::pow(2.0 * pi * 2.0 * kInterval, 2) / 12.0 * most);
    CHECK_THROWS_AS(integrate_by_frequency(one), ProcessingError);
}

}  // namespace
}  // namespace musim::records
