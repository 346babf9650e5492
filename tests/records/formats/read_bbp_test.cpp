#include <doctest/doctest.h>

#include <string>

#include "records/formats/read_record.hpp"
#include "records/measures/intensity.hpp"
#include "tests/records/refusal.hpp"
#include "tests/support/shared_records.hpp"

namespace musim::records {
namespace {

using tests::replaced;

const std::string kBbpFile =
    "#    time(sec)      N-S(cm/s/s)      E-W(cm/s/s)      U-D(cm/s/s)\n"
    "1.000000e+00    5.0e+00    6.0e+00    7.0e+00\n1.020000e+00    4.0e+00   -3.0e+00    2.0e+00\n"
    "1.040000e+00    1.0e+00    0.0e+00    0.0e+00\n";

TEST_CASE("a broadband-platform file gives named axes, and its clock begins where its times do") {
    const tests::TemporaryFolder folder;
    const GroundMotion motion = read_record(folder.write("a", kBbpFile));

    CHECK(motion.format == "SCEC BBP");
    CHECK(motion.component_names() == "N-S, E-W, U-D");
    CHECK(motion.components[0].azimuth_deg == 0.0);
    CHECK(motion.components[1].azimuth_deg == 90.0);
    CHECK_FALSE(motion.components[2].azimuth_deg);
    const TimeSeries& series = motion.components[1].series;
    CHECK(series.quantity() == SampleQuantity::acceleration);
    CHECK(series.start().value() == 1.0);
    CHECK(series.dt().value() == 0.02);
    REQUIRE(series.size() == 3);
    CHECK(series.samples()[1] == -0.03);
}

TEST_CASE("velocities are recognized by their unit, unless the text says that they are accelerations") {
    const tests::TemporaryFolder folder;
    const std::string velocities = "# Time (s), NS (cm/s), EW (cm/s), UD (cm/s)\n0,1,2,3\n0.5,4,5,6\n";

    const TimeSeries velocity = read_record(folder.write("a", velocities)).find_component("NS").series;
    CHECK(velocity.quantity() == SampleQuantity::velocity);
    CHECK(velocity.samples()[1] == 0.04);

    const GroundMotion mistaken = read_record(folder.write("a", "# Acceleration time series in units of cm/s.\n" + velocities));
    CHECK(mistaken.find_component("NS").series.quantity() == SampleQuantity::acceleration);
    CHECK(mistaken.find_component("NS").series.samples()[1] == 0.04);
    CHECK(mistaken.history.back().find("unit cm/s^2 (titled 'cm/s')") != std::string::npos);
}

TEST_CASE("every defect of a broadband-platform file is reported with its line") {
    using tests::check_refused;
    check_refused(replaced(kBbpFile, "   -3.0e+00", ""), "a:3: 3 values (the header names 4 columns)");
    check_refused(replaced(kBbpFile, "-3.0e+00", "-3.0e+00 1"), "a:3: 5 values (the header names 4 columns)");
    check_refused(replaced(kBbpFile, "-3.0e+00", "-3.0f+00"), "a:3: sample 2 is '-3.0f+00' (no finite number)");
    check_refused(replaced(kBbpFile, "1.020000e+00", "1.030000e+00"), "a:3: time is 1.03 s (even sampling gives 1.02 s)");
    check_refused(kBbpFile.substr(0, kBbpFile.find("1.02")), "a:2: one row gives no time step");
    check_refused(kBbpFile.substr(0, kBbpFile.find("1.00")), "a: no samples follow the header");
    check_refused(replaced(kBbpFile, "E-W(cm/s/s)", "E-W(cm/s)"), "a:1: units 'cm/s/s' and 'cm/s' differ");
    check_refused(replaced(replaced(replaced(kBbpFile, "(cm/s/s)", "(furlong)"), "(cm/s/s)", "(furlong)"), "(cm/s/s)", "(furlong)"),
                  "a:1: unit 'furlong' is unknown");
    check_refused(kBbpFile, "file states its unit cm/s^2 (asked for: g)", {.unit = "g"});
    check_refused(kBbpFile, "file states its time step 0.02 s (asked for: 0.01 s)", {.dt = 0.01 * scaling::si::seconds});
}

TEST_CASE("the real broadband-platform files name their axes") {
    if (!tests::have_shared_records()) return;
    CHECK(read_record(tests::shared_records() / "bbp/2002-SYL.bbp").component_names() == "N-S, E-W, U-D");
    // its titles say cm/s, its text acceleration
    const GroundMotion synthetic = read_record(tests::shared_records() / "bbp/accel_ts.bbp");
    CHECK(synthetic.component_names() == "NS, EW, UD");
    CHECK(synthetic.components.front().series.quantity() == SampleQuantity::acceleration);
}

}  // namespace
}  // namespace musim::records
