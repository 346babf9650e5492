#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <numbers>
#include <random>

#include "records/processing/processing.hpp"
#include "tests/records/processing/made_series.hpp"
#include "tests/support/relative.hpp"

namespace musim::records {
namespace {

using lsdem::tests::relative;
using scaling::si::hertz;
using scaling::si::seconds;
using std::numbers::pi;

TEST_CASE("a series refuses what is no history") {
    CHECK_THROWS_AS(make_series({1.0}, 0.0), ProcessingError);
    CHECK_THROWS_AS(make_series({1.0}, -1.0), ProcessingError);
    CHECK_THROWS_AS(make_series({1.0}, std::numeric_limits<double>::quiet_NaN()), ProcessingError);
    CHECK_THROWS_AS(make_series({}), ProcessingError);
    CHECK_THROWS_AS(make_series({1.0, std::numeric_limits<double>::infinity()}), ProcessingError);
}

TEST_CASE("a cut keeps the samples of its window with their times") {
    const TimeSeries series(SampleQuantity::acceleration, 10.0 * seconds, 0.1 * seconds, {0.0, 1.0, 2.0, 3.0, 4.0});

    const TimeSeries part = cut(series, {10.1 * seconds, 10.3 * seconds});

    REQUIRE(part.size() == 3);
    CHECK(part.samples()[0] == 1.0);
    CHECK(part.start().value() == relative(10.1, 1e-15));
    CHECK_THROWS_AS(cut(series, {9.0 * seconds, 10.2 * seconds}), ProcessingError);
    CHECK_THROWS_AS(cut(series, {10.0 * seconds, 11.0 * seconds}), ProcessingError);
    CHECK_THROWS_AS(cut(series, {10.3 * seconds, 10.1 * seconds}), ProcessingError);
}

TEST_CASE("baseline removal of order n takes polynomials of degree n out to rounding") {
    for (int order = 0; order <= 3; ++order) {
        CAPTURE(order);
        std::vector<double> samples;
        for (int i = 0; i < 1000; ++i) {
            const double t = 0.01 * i;
            samples.push_back(3.0 + (order > 0 ? -2.0 * t : 0.0) + (order > 1 ? 0.5 * t * t : 0.0) + (order > 2 ? 0.1 * t * t * t : 0.0));
        }
        const TimeSeries series = make_series(std::move(samples));

        CHECK(largest(remove_baseline(series, order).samples()) < 1e-13 * largest(series.samples()));
        if (order > 0) CHECK(largest(remove_baseline(series, order - 1).samples()) > 1e-3 * largest(series.samples()));
    }
    CHECK_THROWS_AS(remove_baseline(make_series({1.0, 2.0, 3.0, 4.0, 5.0}), 4), ProcessingError);
    CHECK_THROWS_AS(remove_baseline(make_series({1.0, 2.0}), 2), ProcessingError);
}

TEST_CASE("baseline removal is a projection: what is left has no polynomial in it") {
    const TimeSeries once = remove_baseline(make_series(random_samples(500, 1)), 3);
    const TimeSeries twice = remove_baseline(once, 3);
    double difference = 0.0;
    for (std::size_t i = 0; i < once.size(); ++i) difference = std::max(difference, std::abs(once.samples()[i] - twice.samples()[i]));
    CHECK(difference < 1e-14);
}

TEST_CASE("a taper is zero at the ends, one in the middle and half in between") {
    const TimeSeries series = taper(make_series(std::vector<double>(101, 1.0)), 0.2);

    CHECK(series.samples()[0] == 0.0);
    CHECK(series.samples()[100] == 0.0);
    CHECK(series.samples()[10] == relative(0.5, 1e-14));
    CHECK(series.samples()[90] == relative(0.5, 1e-14));
    CHECK(series.samples()[20] == 1.0);
    CHECK(series.samples()[80] == 1.0);
    CHECK_THROWS_AS(taper(series, 0.6), ProcessingError);
    CHECK_THROWS_AS(taper(series, -0.1), ProcessingError);
    CHECK(taper(series, 0.0) == series);
}

// the impulse response of the two passes is the inverse transform of |H|², so its transform must be |H|² at every frequency
TEST_CASE("the high-pass has the squared Butterworth magnitude and no phase") {
    const double dt = 0.01;
    const double corner = 0.5;  // [Hz]
    const std::size_t middle = 4000;
    std::vector<double> impulse(2 * middle + 1, 0.0);
    impulse[middle] = 1.0;
    for (int order = 1; order <= 8; ++order) {
        CAPTURE(order);
        const TimeSeries response = high_pass(make_series(impulse), corner * hertz, order);
        for (const double frequency : {0.05, 0.25, 0.5, 1.0, 5.0, 30.0}) {
            CAPTURE(frequency);
            std::complex<double> transform;
            for (std::size_t i = 0; i < response.size(); ++i) {
                const double phase = 2.0 * pi * frequency * dt * (static_cast<double>(i) - static_cast<double>(middle));
                transform += response.samples()[i] * std::polar(1.0, -phase);
            }
            const double ratio = std::tan(pi * corner * dt) / std::tan(pi * frequency * dt);
            const double expected = 1.0 / (1.0 + std::pow(ratio, 2 * order));
            // padding cut at 1e-6 of the memory; order 1 is the slowest to decay
            CHECK(std::abs(transform.real() - expected) < 1e-5);
            CHECK(std::abs(transform.imag()) < 1e-5);
        }
    }
}

TEST_CASE("the high-pass is symmetric in time") {
    const TimeSeries series = make_series(random_samples(800, 2));
    std::vector<double> reversed(series.samples().begin(), series.samples().end());
    std::reverse(reversed.begin(), reversed.end());

    const TimeSeries filtered = high_pass(series, 1.0 * hertz, 3);
    const TimeSeries filtered_reversed = high_pass(make_series(std::move(reversed)), 1.0 * hertz, 3);

    double difference = 0.0;
    for (std::size_t i = 0; i < filtered.size(); ++i) {
        difference = std::max(difference, std::abs(filtered.samples()[i] - filtered_reversed.samples()[filtered.size() - 1 - i]));
    }
    // padding remembers to 1e-6
    CHECK(difference < 1e-5);
}

TEST_CASE("a slow motion that starts and ends at zero goes, a fast one stays") {
    std::vector<double> slow;
    std::vector<double> fast;
    for (int i = 0; i <= 8000; ++i) {
        const double window = std::sin(pi * i / 8000.0);
        slow.push_back(window);
        fast.push_back(window * window * std::sin(2.0 * pi * 5.0 * 0.01 * i));
    }
    const TimeSeries slow_left = high_pass(make_series(slow), 0.5 * hertz, 4);
    const TimeSeries fast_left = high_pass(make_series(fast), 0.5 * hertz, 4);

    // the half sine has 80 s, its kink at the ends the rest; 5 Hz against 0.5 Hz: (1/10)^8
    CHECK(largest(slow_left.samples()) < 0.01);
    double difference = 0.0;
    for (std::size_t i = 0; i < fast.size(); ++i) difference = std::max(difference, std::abs(fast_left.samples()[i] - fast[i]));
    CHECK(difference < 1e-6);
}

TEST_CASE("the high-pass refuses corners and orders that make no filter") {
    const TimeSeries series = make_series(random_samples(100, 3));
    CHECK_THROWS_AS(high_pass(series, 0.0 * hertz, 2), ProcessingError);
    CHECK_THROWS_AS(high_pass(series, -1.0 * hertz, 2), ProcessingError);
    CHECK_THROWS_AS(high_pass(series, 50.0 * hertz, 2), ProcessingError);
    CHECK_THROWS_AS(high_pass(series, 1e-9 * hertz, 2), ProcessingError);
    CHECK_THROWS_AS(high_pass(series, 1.0 * hertz, 0), ProcessingError);
    CHECK_THROWS_AS(high_pass(series, 1.0 * hertz, 9), ProcessingError);
}

TEST_CASE("integration is exact for piecewise linear histories and differentiation for parabolas") {
    std::vector<double> ramp;
    for (int i = 0; i <= 100; ++i) ramp.push_back(2.0 * 0.01 * i);
    const TimeSeries velocity = integrate(make_series(ramp));
    const TimeSeries acceleration = differentiate(velocity);

    CHECK(velocity.quantity() == SampleQuantity::velocity);
    CHECK(velocity.samples()[100] == relative(1.0, 1e-13));  // ∫2t dt from 0 to 1
    CHECK(acceleration.quantity() == SampleQuantity::acceleration);
    CHECK(acceleration.samples()[50] == relative(1.0, 1e-12));
    CHECK_THROWS_AS(integrate(make_series(ramp, 0.01, SampleQuantity::displacement)), ProcessingError);
    CHECK_THROWS_AS(differentiate(make_series(ramp)), ProcessingError);
}

TEST_CASE("the strong motion is where the energy is") {
    std::vector<double> samples(1000, 0.0);
    for (std::size_t i = 600; i < 700; ++i) samples[i] = i % 2 == 0 ? 1.0 : -1.0;

    const TimeWindow window = find_strong_motion(make_series(samples), 0.1);

    // 6.0 s to 7.0 s, less 0.5 % and plus 10 % of its length on each side
    CHECK(window.start.value() == relative(5.9, 0.01));
    CHECK(window.end.value() == relative(7.1, 0.01));
    CHECK_THROWS_AS(find_strong_motion(make_series({0.0, 0.0, 0.0})), ProcessingError);
}

}  // namespace
}  // namespace musim::records
