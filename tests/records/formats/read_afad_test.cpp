#include <doctest/doctest.h>

#include <cmath>
#include <string>

#include "records/formats/read_record.hpp"
#include "records/measures/intensity.hpp"
#include "tests/records/refusal.hpp"
#include "tests/support/relative.hpp"
#include "tests/support/shared_records.hpp"

namespace musim::records {
namespace {

using lsdem::tests::relative;
using tests::replaced;

const std::string kFile =
    "STRONG GROUND MOTION RECORDS OF TURKIYE\nPLACE                   : MU\xF0LA\nEARTHQUAKE DATE         : 2017/07/20 22:31:09 (GMT)\n"
    "EARTHQUAKE MAGNITUDE    : 6.5 Mw\nSTATION ID              : 4812\nRECORD TIME             : 20/07/2017 22:30:58.250000 (GMT)\n"
    "NUMBER OF DATA          : 2\nSAMPLING INTERVAL (sec) : 0.01\n"
    "RAW PGA VALUES (gal)    : (N-S) 0.500000 (E-W) 1.250000 (U-D) 0.000001\n       N-S          E-W          U-D\n"
    "   -0.500000      1.000000    -0.000001\n    0.250000     -1.250000     0.000000\n";

TEST_CASE("an AFAD file gives three components, its clock and its place in UTF-8") {
    const tests::TemporaryFolder folder;
    const GroundMotion motion = read_record(folder.write("a", kFile));

    CHECK(motion.format == "AFAD");
    CHECK(motion.station == "4812, MU\u011FLA");
    CHECK(motion.event == "2017/07/20 22:31:09 (GMT), magnitude 6.5 Mw");
    CHECK(motion.time_zero == make_utc_time(2017, 7, 20, 22, 30, 58.25));
    REQUIRE(motion.integration_corner);
    CHECK(motion.component_names() == "N-S, E-W, U-D");
    CHECK(motion.components[0].azimuth_deg == 0.0);
    CHECK(motion.components[1].azimuth_deg == 90.0);
    CHECK_FALSE(motion.components[2].azimuth_deg);
    CHECK(motion.components[1].series.dt().value() == 0.01);
    REQUIRE(motion.components[1].series.size() == 2);
    CHECK(motion.components[1].series.samples()[1] == -0.0125);
}

TEST_CASE("every defect of an AFAD file is reported with its line") {
    using tests::check_refused;
    check_refused(replaced(kFile, "    0.250000     -1.250000     0.000000\n", ""),
                  "a:11: 1 rows for NUMBER OF DATA = 2 (file is truncated)");
    check_refused(kFile + " 0 0 0\n", "a:13: more rows than NUMBER OF DATA = 2");
    check_refused(kFile.substr(0, kFile.find("   -0.5")), "a: no samples follow the header");
    check_refused(replaced(kFile, "-1.250000 ", ""), "a:12: 2 values (the header names 3 columns)");
    check_refused(replaced(kFile, "0.000000\n", "0.000000 1\n"), "a:12: 4 values (the header names 3 columns)");
    check_refused(replaced(kFile, "-1.250000", "-1.25O000"), "a:12: sample 2 is '-1.25O000' (no finite number)");
    check_refused(replaced(kFile, "DATA          : 2", "DATA          : 1000000000000"), "a:12: 2 rows for NUMBER OF DATA = 1000000000000");
    check_refused(replaced(kFile, "DATA          : 2", "DATA          :"), "a: header has no 'NUMBER OF DATA'");
    check_refused(replaced(kFile, "(sec) : 0.01", "(sec) : -1"), "a:8: SAMPLING INTERVAL (sec) is '-1' (must be a positive number)");
    check_refused(replaced(kFile, "(E-W) 1.25", "(E-W) 1.35"), "a:9: raw PGA (E-W) is '1.350000' (the samples peak at 1.25;");
    check_refused(replaced(kFile, "(E-W) 1.25", "1.25"), "a:9: raw PGA (E-W) is '' (no number)");
    check_refused(replaced(kFile, "       N-S          E-W", "       N-S          X-Y"), "a: no line names the columns");
    check_refused(replaced(kFile, "20/07/2017", "32/07/2017"), "a:6: RECORD TIME is '32/07/2017 22:30:58.250000 (GMT)' (no date and time)");
    check_refused(kFile, "file states its unit gal (asked for: g)", {.unit = "g"});
}

TEST_CASE("a real AFAD record has its published lengths and peaks") {
    if (!tests::have_shared_records()) return;
    const GroundMotion motion = read_record(tests::shared_records() / "afad/20170720223109_4812.txt");
    CHECK(motion.station == "4812, MU\u011FLA DATCA BELEDIYE KAPALI SPOR SALONU");
    CHECK(motion.time_zero == make_utc_time(2017, 7, 20, 22, 30, 58.0));

    // peaks from the header [gal], signs and times from the samples; velocities of the high-passed record to three digits
    constexpr double kPeaks[] = {37.847707, -39.771316, -32.130932};
    constexpr double kTimes[] = {26.47, 26.56, 27.17};
    constexpr double kVelocities[] = {3.21, 4.94, 2.67};
    REQUIRE(motion.components.size() == 3);
    for (std::size_t i = 0; i < 3; ++i) {
        const TimeSeries& series = motion.components[i].series;
        CHECK(series.size() == 9178);
        CHECK(series.dt().value() == 0.01);
        const auto peak = find_peak_acceleration(series);
        CHECK(peak.value.value() * 100.0 == relative(kPeaks[i], 1e-9));
        CHECK(peak.time.value() == doctest::Approx(kTimes[i]));
        CHECK(std::abs(compute_intensity(series, motion.integration_corner).pgv->value.value()) * 100.0 == relative(kVelocities[i], 0.01));
    }
}

}  // namespace
}  // namespace musim::records
