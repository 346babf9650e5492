#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "records/formats/read_record.hpp"
#include "records/measures/intensity.hpp"
#include "records/processing/base_motion.hpp"
#include "tests/records/published_peaks.hpp"
#include "tests/support/relative.hpp"
#include "tests/support/shared_records.hpp"

namespace musim::records {
namespace {

using lsdem::tests::relative;
using scaling::si::hertz;
using scaling::si::seconds;

ReadOptions options_for(const tests::PublishedPeak& row) {
    ReadOptions options;
    if (row.asked_dt > 0.0) options.dt = row.asked_dt * seconds;
    if (!row.asked_unit.empty()) options.unit = std::string(row.asked_unit);
    return options;
}

// the published numbers have five digits: half a unit of the fifth is at most 5e-5 of the number
constexpr double kFiveDigits = 5e-5;

TEST_CASE("every real record has its published length, time step, peak and time of peak") {
    if (!tests::have_shared_records()) return;
    for (const tests::PublishedPeak& row : tests::kPublishedPeaks) {
        CAPTURE(row.file);
        CAPTURE(row.component);
        const GroundMotion motion = read_record(tests::shared_records() / row.file, options_for(row));
        REQUIRE(motion.components.size() > row.component);
        const TimeSeries& series = motion.components[row.component].series;
        const double si = find_sample_unit(row.unit)->si;

        CHECK(series.size() == row.size);
        CHECK(series.dt().value() == relative(row.dt, 1e-12));
        const Intensity intensity = compute_intensity(series, motion.integration_corner);
        double peak = 0.0;
        scaling::Time time;
        if (series.quantity() == SampleQuantity::acceleration) {
            peak = intensity.pga->value.value();
            time = intensity.pga->time;
        } else if (series.quantity() == SampleQuantity::velocity) {
            peak = intensity.pgv->value.value();
            time = intensity.pgv->time;
        } else {
            peak = intensity.pgd->value.value();
            time = intensity.pgd->time;
        }
        // USC's corrected files are integrated above their filter's corner, and PGA is above their level, which is 0.07 % of it
        const double digits = motion.format == "USC corrected" ? 1e-3 : kFiveDigits;
        CHECK(std::abs(peak / si) == relative(std::abs(row.peak), digits));
        if (row.time >= 0.0) {
            CHECK(peak * row.peak > 0.0);
            CHECK((time - series.start()).value() == relative(row.time, 1e-9));
        }
        // three digits and, for uncorrected records, another way to continue the record at its ends: 1 %
        if (row.pgv > 0.0) CHECK(std::abs(intensity.pgv->value.value()) * 100.0 == relative(row.pgv, 0.01));
    }
}

TEST_CASE("the velocity and displacement blocks of a corrected record are those of its header") {
    if (!tests::have_shared_records()) return;
    const std::filesystem::path path = tests::shared_records() / "csmip/CE58667.V2";

    const GroundMotion velocity = read_record(path, {.quantity = SampleQuantity::velocity});
    const GroundMotion displacement = read_record(path, {.quantity = SampleQuantity::displacement});

    // header of channel 1: -2.890 cm/s at 32.380 s, 1.086 cm at 41.280 s
    const auto pgv = find_peak_velocity(velocity.find_component("H1").series);
    const auto pgd = find_peak_displacement(displacement.find_component("H1").series);
    CHECK(pgv.value.value() * 100.0 == relative(-2.890, 5e-4));
    CHECK(pgv.time.value() == doctest::Approx(32.380));
    CHECK(pgd.value.value() * 100.0 == relative(1.086, 5e-4));
    CHECK(pgd.time.value() == doctest::Approx(41.280));
}

TEST_CASE("the papers' Ridgecrest record has its published peaks") {
    if (!tests::have_shared_records()) return;
    const GroundMotion motion = read_record(tests::shared_records() / "csmip/CICLC.v1");

    CHECK(motion.format == "CSMIP V1");
    CHECK(motion.component_names() == "90, 360, Up");
    CHECK(motion.time_zero == make_utc_time(2019, 7, 6, 3, 16, 8.0));
    REQUIRE(motion.integration_corner);
    const TimeSeries& series = motion.find_component("360").series;
    const double g = scaling::kStandardGravity.value();

    // [Andrade22] Table 1: 0.511 g and 42.4 cm/s; the PGV needs a corner near 0.064 Hz, and is 43.64 cm/s at 0.05 Hz
    const Intensity usual = compute_intensity(series, 0.05 * hertz);
    CHECK(usual.pga->value.value() / g == relative(0.5108, 1e-4));
    CHECK(usual.pga->time.value() == doctest::Approx(235.700));
    CHECK(std::abs(usual.pgv->value.value()) * 100.0 == relative(43.64, 1e-3));
    CHECK(std::abs(compute_intensity(series, 0.064 * hertz).pgv->value.value()) * 100.0 == relative(42.4, 2e-3));
}

TEST_CASE("the strong part of the Ridgecrest record becomes a base motion at rest with nearly its PGV") {
    if (!tests::have_shared_records()) return;
    const GroundMotion motion = read_record(tests::shared_records() / "csmip/CICLC.v1");
    const TimeSeries& series = motion.find_component("360").series;
    const TimeWindow strong = find_strong_motion(series);
    CHECK(strong.start.value() > 200.0);  // the M7.1 motion starts near 225 s
    CHECK(strong.start.value() < 230.0);

    const BaseMotion base = make_base_motion(motion, "360", {.window = strong});

    CHECK(base.velocity.samples().front() == 0.0);
    CHECK(base.velocity.samples().back() == 0.0);
    const double pgd = std::abs(find_peak_displacement(base.displacement).value.value());
    CHECK(std::abs(base.displacement.samples().back()) < 1e-9 * pgd);
    // the taper of the whole record and the correction to rest against 43.64 cm/s of the whole record: 1 %
    CHECK(std::abs(find_peak_velocity(base.velocity).value.value()) * 100.0 == relative(43.64, 0.01));
}

/// The series above the mean of its first `count` samples.
TimeSeries above_first(const TimeSeries& series, std::ptrdiff_t count) {
    std::vector<double> samples(series.samples().begin(), series.samples().end());
    const double level = std::accumulate(samples.begin(), samples.begin() + count, 0.0) / static_cast<double>(count);
    for (double& sample : samples) sample -= level;
    return series.with_samples(std::move(samples));
}

TEST_CASE("an evenly sampled uncorrected record of the older kind has its published peaks and velocities") {
    if (!tests::have_shared_records()) return;
    struct Channel {
        std::string_view name;
        double peak;  ///< [g]
        double time;  ///< [s]
        double pgv;   ///< [cm/s]
    };
    const GroundMotion motion = read_record(tests::shared_records() / "csmip/ce23583r_HESPERIA.RAW");
    CHECK(motion.component_names() == "90, UP, 180");
    const double g = scaling::kStandardGravity.value();
    for (const Channel& row :
         {Channel{"90", 0.058029, 9.425, 4.22}, Channel{"UP", 0.04203, 10.235, 2.96}, Channel{"180", -0.090495, 9.615, 10.5}}) {
        CAPTURE(row.name);
        const TimeSeries& series = motion.find_component(row.name).series;
        CHECK(series.size() == 12001);
        CHECK(series.dt().value() == 0.005);
        // the README took the mean of the first 500 samples off, compute_intensity takes that of the first 187, before the motion begins
        const auto peak = find_peak_acceleration(above_first(series, 500));
        CHECK(peak.value.value() / g == relative(row.peak, kFiveDigits));
        CHECK(peak.time.value() == relative(row.time, 1e-9));
        // three digits, and another way to continue the record at its ends: 1 %
        CHECK(std::abs(compute_intensity(series, motion.integration_corner).pgv->value.value()) * 100.0 == relative(row.pgv, 0.01));
    }
    // the header puts .042 g of "UP" at 18.030 s, a second peak of the same three decimals
    CHECK(std::abs(std::abs(motion.find_component("UP").series.samples()[3606] / g) - 0.042) <= 0.5e-3);
}

TEST_CASE("the test motion of eqsig has the published intensity measures") {
    if (!tests::have_shared_records()) return;
    const TimeSeries series = read_record(tests::shared_records() / "text/test_motion_dt0p01.txt").components.front().series;

    const Intensity intensity = compute_intensity(series);

    CHECK(std::abs(intensity.pga->value.value()) == relative(1.41, 1e-6));
    CHECK(std::abs(intensity.pgv->value.value()) == relative(0.26006, 2e-5));
    CHECK(std::abs(intensity.pgd->value.value()) == relative(0.072781, 1e-5));
    CHECK(compute_arias_intensity(series, 9.81 * scaling::si::meters_per_second_squared).value() == relative(0.63398, 1e-5));
    // 21.00 in whole steps of 0.01 s
    CHECK(std::abs(intensity.d5_95->value() - 21.00) < 0.01);
}

TEST_CASE("files of other formats are refused by name") {
    if (!tests::have_shared_records()) return;
    struct Case {
        std::string_view file;
        std::string_view format;
    };
    for (const Case& row : {Case{"mseed/CI.CLC.xml", "XML"}, Case{"csmip/CE89146.V3", "CSMIP V3"}}) {
        CAPTURE(row.file);
        const std::filesystem::path path = tests::shared_records() / row.file;
        try {
            read_record(path);
            FAIL("was read");
        } catch (const ReadError& error) {
            const std::string message = error.what();
            CAPTURE(message);
            CHECK(message.find(path.string()) == 0);
            CHECK(message.find(row.format) != std::string::npos);
            CHECK(message.find('\n') == std::string::npos);
        }
    }
}

TEST_CASE("a corrected record with a damaged header is refused with the line and the reason") {
    if (!tests::have_shared_records()) return;
    try {
        read_record(tests::shared_records() / "csmip/BadHeader.V2");
        FAIL("was read");
    } catch (const ReadError& error) {
        const std::string message = error.what();
        CAPTURE(message);
        CHECK(message.find("BadHeader.V2:27: azimuth is 900") != std::string::npos);
    }
}

TEST_CASE("an offset of raw samples rings neither in the peaks nor in the motion of a base") {
    if (!tests::have_shared_records()) return;
    // raw counts with an offset; published: 4.078 gal, 0.339 cm/s (high-pass at 0.05 Hz)
    const GroundMotion record = read_record(tests::shared_records() / "knet" / "AOM0011801241951.EW");
    const TimeSeries& series = record.components.at(0).series;
    double mean = 0.0;
    for (const double sample : series.samples()) mean += sample / static_cast<double>(series.size());
    const Intensity intensity = compute_intensity(series, record.integration_corner);
    CHECK(std::abs(mean) > std::abs(intensity.pga->value.value()));
    CHECK(std::abs(intensity.pgv->value.value()) == relative(0.00339, 0.01));
    const BaseMotion base = make_base_motion(record, record.components.at(0).name);
    double peak = 0.0;
    for (const double v : base.velocity.samples()) peak = std::max(peak, std::abs(v));
    CHECK(peak == relative(0.00339, 0.02));
}

}  // namespace
}  // namespace musim::records
