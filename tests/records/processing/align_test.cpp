#include <doctest/doctest.h>

#include <cmath>
#include <numbers>

#include "records/formats/read_record.hpp"
#include "records/processing/align.hpp"
#include "tests/support/relative.hpp"
#include "tests/support/shared_records.hpp"

namespace musim::records {
namespace {

using lsdem::tests::relative;
using scaling::si::seconds;
using std::numbers::pi;

/// exp(−((t − 8)/2)²) along the azimuth, from `start` for `count` samples.
TimeSeries make_pulse(double start, double dt, std::size_t count, double factor = 1.0) {
    std::vector<double> samples;
    for (std::size_t i = 0; i < count; ++i)
        samples.push_back(factor * std::exp(-std::pow((start + dt * static_cast<double>(i) - 8.0) / 2.0, 2)));
    return {SampleQuantity::acceleration, start * seconds, dt * seconds, std::move(samples)};
}

TEST_CASE("components of different start, step and length meet on one clock by time") {
    GroundMotion motion;
    motion.components = {
        {"N", 0.0, make_pulse(0.0, 0.01, 1700)}, {"E", 90.0, make_pulse(0.503, 0.01, 1500)}, {"Up", {}, make_pulse(0.2, 0.02, 800)}};
    const GroundMotion aligned = align(motion);
    const TimeSeries& first = aligned.components[0].series;
    for (const Component& component : aligned.components) {
        CAPTURE(component.name);
        const TimeSeries& series = component.series;
        CHECK(series.start() == first.start());
        CHECK(series.dt().value() == 0.01);
        CHECK(series.size() == first.size());
        // band-limited values of a smooth pulse, to the window's 1e-4
        for (std::size_t i = 0; i < series.size(); i += 50)
            CHECK(series.samples()[i] ==
                  doctest::Approx(std::exp(-std::pow((series.time(i).value() - 8.0) / 2.0, 2))).epsilon(2e-4).scale(1.0));
    }
    CHECK(first.start().value() == relative(0.503, 1e-12));
    CHECK_FALSE(aligned.history.empty());
}

TEST_CASE("files are merged by their own times, or begin together where they give none") {
    GroundMotion one, two;
    one.components = {{"N", 0.0, make_pulse(0.0, 0.01, 1600)}};
    two.components = {{"E", 90.0, make_pulse(0.0, 0.01, 1600)}};
    one.time_zero = make_utc_time(2019, 7, 6, 3, 19, 23.0);
    two.time_zero = make_utc_time(2019, 7, 6, 3, 19, 25.5);
    CHECK(merge({one, two}).components[1].series.start().value() == doctest::Approx(2.5));
    two.time_zero.reset();
    one.source = "a.v1";
    two.source = "b.at2";
    CHECK_THROWS_WITH_AS(merge({one, two}),
                         "of a.v1 and b.at2 only one says when it begins; cut both to one moment and write them without clocks",
                         ProcessingError);
    one.time_zero.reset();
    const GroundMotion together = merge({one, two});
    CHECK(together.components[1].series.start().value() == 0.0);
    CHECK(together.history.back() == "merged from 2 files, taken to begin together");
    CHECK(merge({one, one}).components[1].name == "2 N");
    CHECK_THROWS_AS(merge({}), ProcessingError);
    two.components[0].series = make_pulse(100.0, 0.01, 10);
    CHECK_THROWS_WITH_AS(align(merge({one, two})),
                         "components cover no common time (one begins at 100 s, one ends at 15.99 s); check that they are of one event",
                         ProcessingError);
}

TEST_CASE("a motion along one direction is found there by rotation, from any two components") {
    constexpr double kDirection = 37.0, kDegree = pi / 180.0;
    for (const std::pair<double, double>& azimuths : {std::pair(0.0, 90.0), std::pair(20.0, 140.0), std::pair(270.0, 300.0)}) {
        const double a = azimuths.first, b = azimuths.second;
        CAPTURE(a);
        CAPTURE(b);
        GroundMotion motion;
        motion.components = {{"A", a, make_pulse(0.0, 0.01, 1600, std::cos((a - kDirection) * kDegree))},
                             {"Up", {}, make_pulse(0.0, 0.01, 1600, 5.0)},
                             {"B", b, make_pulse(0.0, 0.01, 1600, std::cos((b - kDirection) * kDegree))}};
        const GroundMotion rotated = rotate(motion, kDirection);
        CHECK(rotated.components[0].name == "37");
        CHECK(*rotated.components[2].azimuth_deg == 127.0);
        for (std::size_t i = 0; i < 1600; i += 100) {
            CHECK(rotated.components[0].series.samples()[i] == relative(make_pulse(0.0, 0.01, 1600).samples()[i], 1e-12));
            CHECK(std::abs(rotated.components[2].series.samples()[i]) < 1e-12);
        }
        CHECK(rotated.components[1].series == motion.components[1].series);
    }
    GroundMotion parallel;
    parallel.components = {{"A", 10.0, make_pulse(0.0, 0.01, 10)}, {"B", 190.0, make_pulse(0.0, 0.01, 10)}};
    CHECK_THROWS_WITH_AS(rotate(parallel, 0.0), "components A and B are parallel (no motion across them is known); take others",
                         ProcessingError);
    parallel.components.pop_back();
    CHECK_THROWS_AS(rotate(parallel, 0.0), ProcessingError);
}

TEST_CASE("the three components of China Lake, of three lengths, are cut to what they share") {
    if (!tests::have_shared_records()) return;
    const GroundMotion record = read_record(tests::shared_records() / "csmip" / "CICLC.v1");
    const GroundMotion aligned = align(record);
    for (std::size_t i = 0; i < 3; ++i) {
        const TimeSeries &before = record.components[i].series, &after = aligned.components[i].series;
        CHECK(after.size() == 31932);
        CHECK(after.start() == before.start());
        CHECK(std::equal(after.samples().begin(), after.samples().end(), before.samples().begin()));
    }
    CHECK(aligned.history.back() == "Up cut to 0 s ... 319.31 s");
}

}  // namespace
}  // namespace musim::records
