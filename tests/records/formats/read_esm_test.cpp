#include <doctest/doctest.h>

#include <string>

#include "records/formats/read_record.hpp"
#include "tests/records/refusal.hpp"
#include "tests/support/shared_records.hpp"

namespace musim::records {
namespace {

using tests::replaced;

const std::string kEsmFile =
    "EVENT_NAME: GREECE\nEVENT_DATE_YYYYMMDD: 20190728\nEVENT_TIME_HHMMSS: 160908\nNETWORK: HI\nSTATION_CODE: ARS1\n"
    "STATION_NAME: Argos\nDATE_TIME_FIRST_SAMPLE_YYYYMMDD_HHMMSS: 20190728_160919.870\nSAMPLING_INTERVAL_S: 0.005000\nNDATA: 3\n"
    "STREAM: HNE\nUNITS: cm/s^2\nPGA_CM/S^2: 2.500\nBASELINE_CORRECTION: BASELINE REMOVED\nDATA_TYPE: ACCELERATION\nUSER5: \n"
    "1.000000\n-2.500000\n0.500000\n";

TEST_CASE("an ESM file gives samples in SI, its stream, station and clock") {
    const tests::TemporaryFolder folder;
    const GroundMotion motion = read_record(folder.write("a", kEsmFile));

    CHECK(motion.format == "ESM");
    CHECK(motion.event == "GREECE, 20190728 160908");
    CHECK(motion.station == "HI.ARS1, Argos");
    CHECK(motion.time_zero == make_utc_time(2019, 7, 28, 16, 9, 19.87));
    CHECK_FALSE(motion.integration_corner);
    const Component& component = motion.find_component("HNE");
    CHECK(component.azimuth_deg == 90.0);
    CHECK(component.series.dt().value() == 0.005);
    REQUIRE(component.series.size() == 3);
    CHECK(component.series.samples()[1] == -0.025);
}

TEST_CASE("only directions that are compass points have an azimuth") {
    const tests::TemporaryFolder folder;
    const auto azimuth = [&](std::string_view stream) {
        return read_record(folder.write("a", replaced(kEsmFile, "HNE", stream))).components.front().azimuth_deg;
    };
    CHECK(azimuth("HNN") == 0.0);
    CHECK_FALSE(azimuth("HNZ"));
    CHECK_FALSE(azimuth("HN1"));
}

TEST_CASE("ESM velocities keep their quantity, and files with their baseline are uncorrected") {
    const tests::TemporaryFolder folder;
    const std::string velocity =
        replaced(replaced(replaced(kEsmFile, "cm/s^2", "cm/s"), "PGA_CM/S^2: 2.500", "PGV_CM/S: -2.500"), "ACCELERATION", "VELOCITY");
    CHECK(read_record(folder.write("a", velocity)).components.front().series.quantity() == SampleQuantity::velocity);

    const GroundMotion raw = read_record(folder.write("a", replaced(kEsmFile, "BASELINE REMOVED", "BASELINE NOT REMOVED")));
    REQUIRE(raw.integration_corner);
    CHECK(raw.integration_corner->value() == 0.05);
}

TEST_CASE("every defect of an ESM file is reported with its line") {
    using tests::check_refused;
    check_refused(replaced(kEsmFile, "0.500000\n", ""), "a:17: 2 values for NDATA = 3 (file is truncated)");
    check_refused(kEsmFile + "0.1\n", "a:19: more values than NDATA = 3");
    check_refused(replaced(kEsmFile, "0.500000", "0.5o0000"), "a:18: sample 3 is '0.5o0000' (no finite number)");
    check_refused(replaced(kEsmFile, "NDATA: 3", "NDATA: 1000000000000"), "a:18: 3 values for NDATA = 1000000000000");
    check_refused(replaced(kEsmFile, "NDATA: 3", "NDATA: -3"), "a:9: NDATA is '-3' (must be a positive integer)");
    check_refused(replaced(kEsmFile, "NDATA: 3", "NDATA:"), "a: header has no 'NDATA'");
    check_refused(replaced(kEsmFile, "0.005000", "0"), "a:8: SAMPLING_INTERVAL_S is '0' (must be a positive number)");
    check_refused(replaced(kEsmFile, "S^2: 2.500", "S^2: 2.600"), "a:12: PGA_CM/S^2 is '2.600' (the samples peak at 2.5;");
    check_refused(replaced(kEsmFile, "UNITS: cm/s^2", "UNITS: furlong"), "a:11: UNITS is 'furlong' (known: ");
    check_refused(replaced(kEsmFile, "ACCELERATION", "PSA SPECTRUM"),
                  "a:14: DATA_TYPE is 'PSA SPECTRUM' (UNITS cm/s^2 are of acceleration)");
    check_refused(replaced(kEsmFile, "20190728_160919.870", "20191328_160919.870"), "a:7: DATE_TIME_FIRST_SAMPLE_YYYYMMDD_HHMMSS is");
    check_refused(kEsmFile, "file states its unit cm/s^2 (asked for: g)", {.unit = "g"});
}

TEST_CASE("both ways in which ESM files write dates are read") {
    if (!tests::have_shared_records()) return;
    const GroundMotion slashes = read_record(tests::shared_records() / "esm/20101114230825_3104_ap_RawAcc_E.asc");
    CHECK(slashes.station == "TK.3104");
    CHECK(slashes.time_zero == make_utc_time(2010, 11, 14, 23, 9, 19.3));
    CHECK(slashes.find_component("HNE").azimuth_deg == 90.0);

    const GroundMotion digits = read_record(tests::shared_records() / "esm/HI.ARS1..HNN.D.20190728.160908.C.ACC.ASC");
    CHECK(digits.time_zero == make_utc_time(2019, 7, 28, 16, 9, 19.87));
    CHECK(digits.find_component("HNN").azimuth_deg == 0.0);
}

}  // namespace
}  // namespace musim::records
