#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "records/processing/resample.hpp"
#include "tests/support/relative.hpp"

namespace musim::records {
namespace {

using lsdem::tests::relative;
using scaling::si::seconds;
using std::numbers::pi;

/// A wave packet of frequency f [1/s], at rest at both ends of 20 s.
double packet(double f, double t) { return std::exp(-0.5 * std::pow((t - 10.0) / 2.0, 2)) * std::sin(2.0 * pi * f * t); }

TimeSeries make_packet(double f, double dt) {
    std::vector<double> samples;
    for (int i = 0; dt * i <= 20.0; ++i) samples.push_back(packet(f, dt * i));
    return {SampleQuantity::acceleration, 3.0 * seconds, dt * seconds, std::move(samples)};
}

double worst_against(const TimeSeries& series, double f) {
    double worst = 0.0;
    for (std::size_t i = 0; i < series.size(); ++i)
        worst = std::max(worst, std::abs(series.samples()[i] - packet(f, (series.time(i) - 3.0 * seconds).value())));
    return worst;
}

TEST_CASE("a motion below the band's edge is the same on any step") {
    // 0.02 s: half the rate is 25 Hz; the packet is some 0.5 Hz wide
    for (const double f : {0.5, 5.0, 20.0})
        for (const double dt : {0.01, 0.0125, 0.005, 0.003}) {
            CAPTURE(f);
            CAPTURE(dt);
            const TimeSeries finer = resample(make_packet(f, 0.02), dt * seconds);
            CHECK(finer.dt().value() == dt);
            CHECK(finer.start().value() == 3.0);
            CHECK(worst_against(finer, f) < 1e-4);
        }
    CHECK(worst_against(resample(make_packet(5.0, 0.005), 0.02 * seconds), 5.0) < 1e-4);
    CHECK(worst_against(resample(make_packet(20.0, 0.005), 0.02 * seconds), 20.0) < 1e-4);
    // straight lines between samples are off by (2πf dt)²/8 there
    const double straight = worst_against(resample(make_packet(5.0, 0.02), 0.01 * seconds, Between::straight), 5.0);
    CHECK(straight == relative(std::pow(2.0 * pi * 5.0 * 0.02, 2) / 8.0, 0.1));
}

TEST_CASE("what lies above half the new rate does not fold back") {
    const TimeSeries coarse = resample(make_packet(30.0, 0.005), 0.02 * seconds);
    double most = 0.0;
    for (const double sample : coarse.samples()) most = std::max(most, std::abs(sample));
    CHECK(most < 1e-4);
    double folded = 0.0;
    const TimeSeries naive = resample(make_packet(30.0, 0.005), 0.02 * seconds, Between::straight);
    for (const double sample : naive.samples()) folded = std::max(folded, std::abs(sample));
    CHECK(folded > 0.9);
}

TEST_CASE("samples that fall on samples stay to the bit, and the ends are kept") {
    const TimeSeries series = make_packet(7.0, 0.01);
    const TimeSeries finer = resample(series, 0.005 * seconds);
    REQUIRE(finer.size() == 2 * series.size() - 1);
    for (std::size_t i = 0; i < series.size(); ++i) CHECK(finer.samples()[2 * i] == series.samples()[i]);
    CHECK(resample(series, 0.01 * seconds) == series);
    CHECK(resample(series, 0.03 * seconds).size() == 667);
    // one sample is no record
    CHECK_THROWS_WITH_AS(resample(series, 1e9 * seconds), "new step is 1e+09 s (longer than the record of 20 s); give a shorter one",
                         ProcessingError);
}

TEST_CASE("a clock shifted by a part of a step shows the motion there") {
    for (const double part : {0.3, -0.3, 0.999}) {
        CAPTURE(part);
        const TimeSeries series = make_packet(5.0, 0.02), shifted = shift_clock(series, part * 0.02 * seconds);
        CHECK(shifted.size() == series.size() - 1);
        CHECK(shifted.start().value() == relative(3.0 + 0.02 * (part < 0.0 ? 1.0 + part : part), 1e-14));
        CHECK(worst_against(shifted, 5.0) < 1e-4);
    }
}

TEST_CASE("a scaled record is resampled to the scaled result, to the last bit") {
    const TimeSeries series = make_packet(5.0, 0.02);
    std::vector<double> samples(series.samples().begin(), series.samples().end());
    for (double& sample : samples) sample *= 4.0;
    const TimeSeries scaled(series.quantity(), 0.25 * series.start(), 0.25 * series.dt(), samples);
    const TimeSeries one = resample(series, 0.013 * seconds), two = resample(scaled, 0.25 * 0.013 * seconds);
    REQUIRE(one.size() == two.size());
    for (std::size_t i = 0; i < one.size(); ++i) CHECK(two.samples()[i] == 4.0 * one.samples()[i]);
}

TEST_CASE("impossible steps are refused") {
    const TimeSeries series = make_packet(5.0, 0.02);
    CHECK_THROWS_AS(resample(series, 0.0 * seconds), ProcessingError);
    CHECK_THROWS_AS(resample(series, -0.01 * seconds), ProcessingError);
    CHECK_THROWS_AS(resample(series, 1e-12 * seconds), ProcessingError);
    CHECK_THROWS_AS(shift_clock(series, 0.02 * seconds), ProcessingError);
}

}  // namespace
}  // namespace musim::records
