#include <doctest/doctest.h>
#include <fmt/format.h>

#include <string>

#include "records/formats/read_record.hpp"
#include "tests/records/refusal.hpp"
#include "tests/support/relative.hpp"

namespace musim::records {
namespace {

using lsdem::tests::relative;
using tests::replaced;

// one component of ten samples; the peak is the sixth
const std::string kCsmncFile =
    "53XYZ200102030405\n0200102030405 2020-01-02 11:04:05 BTM\nSOME EARTHQUAKE, SOMEWHERE,CHN\nEPICENTER  30.000N 100.000E DEPTH 9 KM\n"
    "MAGNITUDE  5.0(Ms)\nSTATION: 53XYZ 30.100N 100.100E\nSITE CONDITION: SOIL\nINSTRUMENT TYPE: Y\nOBSERVING POINT: GROUND\nCOMP. EW\n"
    "UNCORRECTED ACCELERATION          UNIT: CM/SEC/SEC\n"
    "NO. OF POINTS:  10  EQUALLY SPACED INTERVALS OF:  0.005  SEC\n"
    "PEAK VALUE:    -35.746   AT   0.025 SEC    DURATION:  0.05 SEC\n"
    "PRE-EVENT TIME:  20  SEC  RECORDER TIME:  2020-01-02 11:04:00.000 BTM\nCSMNC\n\n"
    ".000 .000 -.060 .000 .060 -35.746 .000 .000 \n1.000E-1 -2.5 \n";

TEST_CASE("a CSMNC file gives its component in SI, uncorrected") {
    const tests::TemporaryFolder folder;
    const GroundMotion motion = read_record(folder.write("a", kCsmncFile));

    CHECK(motion.format == "CSMNC");
    CHECK(motion.station == "53XYZ 30.100N 100.100E");
    CHECK(motion.event == "0200102030405 2020-01-02 11:04:05 BTM, SOME EARTHQUAKE, SOMEWHERE,CHN");
    REQUIRE(motion.integration_corner);
    const Component& component = motion.find_component("EW");
    CHECK(component.azimuth_deg == 90.0);
    CHECK(component.series.dt().value() == 0.005);
    REQUIRE(component.series.size() == 10);
    CHECK(component.series.samples()[5] == relative(-0.35746, 1e-15));
    CHECK(component.series.samples()[9] == relative(-0.025, 1e-15));
}

TEST_CASE("an older CSMNC header with fewer lines, a misspelt title and steps without a leading zero is read") {
    const tests::TemporaryFolder folder;
    const std::string older =
        "ZGZ02050601\n020501 02-05-06 12-47-20 UTC\nSOME EARTHQUAKE\nEPICENTER 39.5N 118.6E\nDEPTH 10KM\nMAG. 6.0(ML)\n"
        "STATION: TOWN (91ZGC) 39.8N 116.2E\nINSTRUMENT TYPE: ETNA\nOBSERVING POINT: G\nCOMP. V\n"
        "UNCORRECTED ACCCELERATION UNIT: CM/SEC/SEC\nNO. OF POINTS: 4 EQUALLY SPACED INTERVALS OF: .005 SEC\n"
        "PEAK VALUE: -3.1 AT .01 SEC DURATION: .02 SEC\nPRE-EVENT TIME: 20 SEC SITE CONDITION: soil\n\n1.0 1.0 -2.1 1.0\n";
    // the peak is stated about the mean, 0.225: -2.325; then -3.1 is neither
    tests::check_refused(older, "a:13: PEAK VALUE: is '3.1' (the samples peak at 2.325;");

    const GroundMotion motion = read_record(folder.write("a", replaced(older, "-3.1 AT", "-2.3 AT")));
    CHECK(is_vertical(motion.find_component("V")));
    CHECK(motion.components.front().series.samples()[2] == relative(-0.021, 1e-15));
}

TEST_CASE("every defect of a CSMNC file is reported with its line") {
    using tests::check_refused;
    check_refused(replaced(kCsmncFile, " -2.5 ", ""), "a:18: 9 values for NO. OF POINTS = 10 (file is truncated)");
    check_refused(kCsmncFile + "0.1\n", "a:19: more values than NO. OF POINTS = 10");
    check_refused(replaced(kCsmncFile, "-2.5", "-2,5x"), "a:18: sample 11 is '5x' (no finite number)");
    check_refused(replaced(kCsmncFile, "  10  EQ", "  ten  EQ"), "a:12: number of points 'ten' is unusable");
    check_refused(replaced(kCsmncFile, "0.005  SEC", "0.000  SEC"), "a:12: time step is 0 s (must be positive)");
    check_refused(replaced(kCsmncFile, "0.005  SEC", "x  SEC"), "a:12: time step 'x' is no number");
    check_refused(replaced(kCsmncFile, "-35.746   AT", "-36.746   AT"), "a:13: PEAK VALUE: is '36.746' (the samples peak at 35.746;");
    check_refused(replaced(kCsmncFile, "CM/SEC/SEC", "COUNTS"), "a:11: unit 'COUNTS' is unknown");
    check_refused(replaced(kCsmncFile, "UNCORRECTED ACCELERATION", "CORRECTED VELOCITY"),
                  "a:11: line names velocity (its unit cm/s^2 is of");
    check_refused(replaced(kCsmncFile, "DURATION:  0.05", "DURATION:  500"), "a:12: 10 points of 0.005 s do not make the 500 s of line 13");
    check_refused(kCsmncFile.substr(0, kCsmncFile.find(".000 .000")), "no samples follow the header (file is truncated)");
    check_refused(kCsmncFile, "a: file states its unit cm/s^2 (asked for: g)", {.unit = "g"});
}

}  // namespace
}  // namespace musim::records
