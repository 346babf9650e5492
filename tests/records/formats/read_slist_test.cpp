#include <doctest/doctest.h>

#include <string>

#include "records/formats/read_record.hpp"
#include "tests/records/refusal.hpp"
#include "tests/support/relative.hpp"

namespace musim::records {
namespace {

using lsdem::tests::relative;
using tests::replaced;

const std::string kSlist =
    "TIMESERIES XX_ABC__HNE_D, 5 samples, 100 sps, 2020-02-29T12:00:00.010000, SLIST, FLOAT, M/S**2\n"
    "+1.5000000000e+00\t-2.0\t3.0\n4.0\t5.0\n"
    "TIMESERIES XX_ABC__HNZ_D, 1 samples, 100 sps, 2020-02-29T12:00:00.000000, SLIST, FLOAT, M/S**2\n7.0\n";
const std::string kSecondPiece =
    "TIMESERIES XX_ABC__HNE_D, 2 samples, 100 sps, 2020-02-29T12:00:00.060000, SLIST, FLOAT, M/S**2\n6.0\n8.0\n";

const std::string kTspair =
    "TIMESERIES XX.ABC.--.HNE.M, 3 samples, 50 sps, 2020-02-29T23:59:59.980000Z, TSPAIR, INTEGER, Counts\n"
    "2020-02-29T23:59:59.980000Z 2\n2020-03-01T00:00:00.000000Z  -4\n2020-03-01T00:00:00.020000Z 6\n";

TEST_CASE("series of SLIST become components with their own starts, pieces one behind the other") {
    const tests::TemporaryFolder folder;
    const GroundMotion motion = read_record(folder.write("a", kSlist + kSecondPiece));

    CHECK(motion.format == "SLIST");
    CHECK(motion.station == "XX.ABC");
    CHECK(motion.time_zero == make_utc_time(2020, 2, 29, 12, 0, 0.0));
    const TimeSeries& series = motion.find_component("HNE").series;
    CHECK(series.start().value() == relative(0.01, 1e-12));
    CHECK(series.dt().value() == 0.01);
    REQUIRE(series.size() == 7);
    CHECK(series.samples()[1] == -2.0);
    CHECK(series.samples()[6] == 8.0);
    CHECK(motion.find_component("HNZ").series.samples()[0] == 7.0);
}

TEST_CASE("counts of TSPAIR are divided by the sensitivity, and a unit in the file needs none") {
    const tests::TemporaryFolder folder;
    const auto path = folder.write("a", kTspair);
    const GroundMotion motion = read_record(path, {.sensitivity = 4.0});
    CHECK(motion.format == "TSPAIR");
    CHECK(motion.components.front().series ==
          TimeSeries(SampleQuantity::acceleration, 0.0 * scaling::si::seconds, 0.02 * scaling::si::seconds, {0.5, -1.0, 1.5}));

    tests::check_refused(kTspair, "a: sensitivity is not given (TSPAIR holds counts); give the station's StationXML");
    tests::check_refused(kSlist, "a: sensitivity is given (the file names the unit of its samples)", {.sensitivity = 2.0});
    const std::string gal = replaced(kTspair, "Counts", "CM/S**2");
    CHECK(read_record(folder.write("b", gal)).components.front().series.samples()[2] == relative(0.06, 1e-15));
    // some programs leave the unit out
    CHECK(read_record(folder.write("c", replaced(kTspair, ", Counts", ",")), {.sensitivity = 1.0}).components.front().series.size() == 3);
    CHECK(read_record(folder.write("d", replaced(kTspair, "XX.ABC.--.HNE.M", "FDSN:XX_ABC__H_N_E")), {.sensitivity = 1.0})
              .component_names() == "HNE");
}

TEST_CASE("GeoCSV gives series with the sensitivity in its header") {
    const tests::TemporaryFolder folder;
    const std::string header =
        "# dataset: GeoCSV 2.0\n# delimiter: , \n# SID: XX_ABC_00_HNE\n# sample_count: 2\n# sample_rate_hz: 100\n"
        "# start_time: 2020-02-29T12:00:00.000000Z\n# azimuth_deg: 90.0\n# dip_deg: 0.0\n# scale_factor: 400.0\n# scale_units: M/S**2\n";
    const std::string list = header + "# field_unit: Counts\n# field_type: INTEGER\nSample\n100\n-200\n";
    const std::string pairs = header + "# field_unit: UTC, Counts\n# field_type: datetime, INTEGER\nTime, Sample\n" +
                              "2020-02-29T12:00:00.000000Z, 100\n2020-02-29T12:00:00.010000Z, -200\n";
    const std::string second = replaced(replaced(list, "00.000000Z", "00.020000Z"), "100\n-200", "300\n0");
    for (const std::string& text : {list, pairs}) {
        const GroundMotion motion = read_record(folder.write("a", text + second));
        CHECK(motion.format == "GeoCSV");
        CHECK(motion.time_zero == make_utc_time(2020, 2, 29, 12, 0, 0.0));
        const Component& component = motion.find_component("HNE");
        CHECK(component.azimuth_deg == 90.0);
        REQUIRE(component.series.size() == 4);
        CHECK(component.series.samples()[1] == relative(-0.5, 1e-15));
        CHECK(component.series.samples()[2] == relative(0.75, 1e-15));
    }
    const std::string counts = replaced(list, "# scale_factor: 400.0\n", "");
    CHECK(read_record(folder.write("b", counts), {.sensitivity = 100.0}).components.front().series.samples()[1] == -2.0);

    using tests::check_refused;
    check_refused(counts, "a: sensitivity is not given (GeoCSV holds counts)");
    check_refused(replaced(list, "sample_count: 2", "sample_count: 3"), "a:15: 2 samples for the 3 of line 1 (file is truncated)");
    check_refused(replaced(list, "sample_rate_hz: 100", "sample_rate_hz: x"), "a:1: sample_rate_hz is 'x' (missing or unusable)");
    check_refused(replaced(list, "M/S**2", "PA"), "a:1: unit 'PA' is unknown");
    check_refused(replaced(pairs, "00.010000Z, -200", "00.030000Z, -200"), "a:15: time is 0.030000 s after the start");
}

TEST_CASE("every defect of SLIST and TSPAIR is reported with its line") {
    using tests::check_refused;
    check_refused(replaced(kSlist, "5 samples", "6 samples"), "a:3: 5 samples for the 6 of line 1 (file is truncated)");
    check_refused(replaced(kSlist, "5 samples", "4 samples"), "a:3: more samples than the 4 of line 1");
    check_refused(replaced(kSlist, "5 samples", "five samples"), "a:1: 'five samples' is no number of samples");
    check_refused(replaced(kSlist, "100 sps", "x sps"), "a:1: 'x sps' is no sample rate");
    check_refused(replaced(kSlist, "100 sps", "0 sps"), "a:1: sample rate is 0 Hz (must be positive)");
    check_refused(replaced(kSlist, "T12:00:00.01", "T25:00:00.01"), "a:1: start is '2020-02-29T25:00:00.010000' (no date and time)");
    check_refused(replaced(kSlist, "SLIST", "SLOST"), "a:1: form is 'SLOST' (read: SLIST, TSPAIR)");
    check_refused(replaced(kSlist, "FLOAT", "ASCII"), "a:1: samples are 'ASCII' (read: INTEGER, FLOAT)");
    check_refused(replaced(kSlist, "M/S**2", "PA"), "a:1: unit 'PA' is unknown");
    check_refused(replaced(kSlist, "XX_ABC__HNE_D", "HNE"), "a:1: 'HNE' is no name of a stream");
    check_refused(replaced(kSlist, ", SLIST, FLOAT, M/S**2", ""), "a:1: header has 4 fields");
    check_refused(replaced(kSlist, "-2.0", "-2.x"), "a:2: sample 2 is '-2.x' (no finite number)");
    check_refused(kSlist + replaced(kSecondPiece, "00.06", "00.07"), "a:6: gap of 0.01 s in XX.ABC..HNE");
    check_refused(kSlist + replaced(kSecondPiece, "00.06", "00.05"), "a:6: overlap of 0.01 s in XX.ABC..HNE");
    check_refused(kSlist + replaced(kSecondPiece, "100 sps", "50 sps"), "a:6: sample rate of XX.ABC..HNE is 50 Hz (before: 100 Hz)");
    check_refused(kSlist + replaced(kSecondPiece, "M/S**2", "CM/S**2"), "a:6: unit of XX.ABC..HNE differs");
    check_refused(replaced(kTspair, "00.020000Z 6", "00.040000Z 6"),
                  "a:4: time is 0.060000 s after the start (the sample rate gives 0.040000 s)", {.sensitivity = 1.0});
    check_refused(replaced(kTspair, "00.020000Z 6", "00.020000Z"), "a:4: 0 values behind a time (TSPAIR has one)", {.sensitivity = 1.0});
    check_refused(replaced(kTspair, "2020-03-01T00:00:00.0200", "2020-13-01T00:00:00.0200"), "a:4: time is '2020-13-01T00:00:00.020000Z'",
                  {.sensitivity = 1.0});
}

}  // namespace
}  // namespace musim::records
