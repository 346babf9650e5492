#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "records/base_motion.hpp"
#include "records/intensity.hpp"
#include "records/read_record.hpp"
#include "tests/records/published_peaks.hpp"
#include "tests/support/shared_records.hpp"

namespace musim::records {
namespace {

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
        CHECK(series.dt().value() == doctest::Approx(row.dt).epsilon(1e-12));
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
        CHECK(std::abs(peak / si) == doctest::Approx(std::abs(row.peak)).epsilon(kFiveDigits));
        if (row.time >= 0.0) {
            CHECK(peak * row.peak > 0.0);
            CHECK((time - series.start()).value() == doctest::Approx(row.time).epsilon(1e-9));
        }
        // three digits and, for uncorrected records, another way to continue the record at its ends: 1 %
        if (row.pgv > 0.0) CHECK(std::abs(intensity.pgv->value.value()) * 100.0 == doctest::Approx(row.pgv).epsilon(0.01));
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
    CHECK(pgv.value.value() * 100.0 == doctest::Approx(-2.890).epsilon(5e-4));
    CHECK(pgv.time.value() == doctest::Approx(32.380));
    CHECK(pgd.value.value() * 100.0 == doctest::Approx(1.086).epsilon(5e-4));
    CHECK(pgd.time.value() == doctest::Approx(41.280));
}

TEST_CASE("the papers' Ridgecrest record has its published peaks") {
    if (!tests::have_shared_records()) return;
    const GroundMotion motion = read_record(tests::shared_records() / "csmip/CICLC.v1");

    CHECK(motion.format == "CSMIP V1");
    CHECK(motion.component_names() == "90, 360, Up");
    REQUIRE(motion.integration_corner);
    const TimeSeries& series = motion.find_component("360").series;
    const double g = scaling::kStandardGravity.value();

    // [Andrade22] Table 1: 0.511 g and 42.4 cm/s; the PGV needs a corner near 0.064 Hz, and is 43.64 cm/s at 0.05 Hz
    const Intensity usual = compute_intensity(series, 0.05 * hertz);
    CHECK(usual.pga->value.value() / g == doctest::Approx(0.5108).epsilon(1e-4));
    CHECK(usual.pga->time.value() == doctest::Approx(235.700));
    CHECK(std::abs(usual.pgv->value.value()) * 100.0 == doctest::Approx(43.64).epsilon(1e-3));
    CHECK(std::abs(compute_intensity(series, 0.064 * hertz).pgv->value.value()) * 100.0 == doctest::Approx(42.4).epsilon(2e-3));
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
    CHECK(std::abs(base.residual.value()) < 1e-9 * pgd);
    // a shorter record, a taper and the correction to rest against 43.64 cm/s of the whole record: 5 %
    CHECK(std::abs(find_peak_velocity(base.velocity).value.value()) * 100.0 == doctest::Approx(43.64).epsilon(0.05));
}

TEST_CASE("an evenly sampled uncorrected record of the older kind has the peaks of its header") {
    if (!tests::have_shared_records()) return;
    const GroundMotion motion = read_record(tests::shared_records() / "csmip/ce23583r_HESPERIA.RAW");

    // header: .058 g, .042 g and -.091 g; half a unit of the third decimal for the print and half for the initial level, which it ignores
    const double g = scaling::kStandardGravity.value();
    const double unit = 1e-3;
    CHECK(motion.component_names() == "90, UP, 180");
    CHECK(std::abs(compute_intensity(motion.components[0].series, motion.integration_corner).pga->value.value() / g - 0.058) < unit);
    CHECK(std::abs(compute_intensity(motion.components[1].series, motion.integration_corner).pga->value.value() / g - 0.042) < unit);
    CHECK(std::abs(compute_intensity(motion.components[2].series, motion.integration_corner).pga->value.value() / g + 0.091) < unit);
}

TEST_CASE("the test motion of eqsig has the published intensity measures") {
    if (!tests::have_shared_records()) return;
    const TimeSeries series = read_record(tests::shared_records() / "text/test_motion_dt0p01.txt").components.front().series;

    const Intensity intensity = compute_intensity(series);

    CHECK(std::abs(intensity.pga->value.value()) == doctest::Approx(1.41).epsilon(1e-6));
    CHECK(std::abs(intensity.pgv->value.value()) == doctest::Approx(0.26006).epsilon(2e-5));
    CHECK(std::abs(intensity.pgd->value.value()) == doctest::Approx(0.072781).epsilon(1e-5));
    CHECK(compute_arias_intensity(series, 9.81 * scaling::si::meters_per_second_squared).value() == doctest::Approx(0.63398).epsilon(1e-5));
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
    CHECK(std::abs(intensity.pgv->value.value()) == doctest::Approx(0.00339).epsilon(0.01));
    const BaseMotion base = make_base_motion(record, record.components.at(0).name);
    double peak = 0.0;
    for (const double v : base.velocity.samples()) peak = std::max(peak, std::abs(v));
    CHECK(peak == doctest::Approx(0.00339).epsilon(0.02));
}

}  // namespace
}  // namespace musim::records
