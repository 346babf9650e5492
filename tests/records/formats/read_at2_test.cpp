#include <doctest/doctest.h>

#include <string>

#include "records/formats/read_record.hpp"
#include "tests/support/temporary_folder.hpp"

namespace musim::records {
namespace {

constexpr double kG = 9.80665;  // [m/s²]

const std::string kHeader =
    "PEER NGA STRONG MOTION DATABASE RECORD\n"
    "Loma Prieta, 10/18/1989, Corralitos, 90\n"
    "ACCELERATION TIME SERIES IN UNITS OF G\n";

TEST_CASE("a PEER file gives samples in SI, the time step and its names") {
    const tests::TemporaryFolder folder;
    const auto path = folder.write("a.txt", kHeader + "NPTS=   3, DT=   .0050 SEC,   \n   .1E+00  -.2E+00   .3E+00 \n");

    const GroundMotion motion = read_record(path);

    CHECK(motion.format == "PEER AT2");
    CHECK(motion.event == "Loma Prieta, 10/18/1989");
    CHECK(motion.station == "Corralitos");
    REQUIRE(motion.components.size() == 1);
    const Component& component = motion.find_component("090");
    CHECK(component.azimuth_deg == 90.0);
    CHECK(component.series.dt().value() == 0.005);
    REQUIRE(component.series.size() == 3);
    CHECK(component.series.samples()[0] == 0.1 * kG);
    CHECK(component.series.samples()[1] == -0.2 * kG);
    CHECK(component.series.samples()[2] == 0.3 * kG);
}

TEST_CASE("header variants of the PEER family read the same") {
    const tests::TemporaryFolder folder;
    for (const std::string counts :
         {"NPTS= 2, DT= .02000 SEC", "npts= 2, dt= .02", "2    0.0200    NPTS, DT", "NPTS=2,DT=0.02,", "  NPTS 2 DT 2D-2 SEC"}) {
        for (const std::string line_end : {"\n", "\r\n", "\r\r\n"}) {
            CAPTURE(counts);
            const auto path = folder.write("a.at2", kHeader + counts + line_end + "1.0" + line_end + "+2.0," + line_end);
            const TimeSeries series = read_record(path).components.front().series;
            CHECK(series.dt().value() == 0.02);
            REQUIRE(series.size() == 2);
            CHECK(series.samples()[1] == 2.0 * kG);
        }
    }
}

TEST_CASE("a PEER line of counts may state the unit") {
    const tests::TemporaryFolder folder;
    for (const std::string counts :
         {"NPTS= 2, DT= .005 SEC, UNITS= CM/S2", "NPTS: 2, DT: 0.005, Units: gal", "title\nUNITS = cm/s/s\nNPTS= 2, DT= .005"}) {
        CAPTURE(counts);
        const GroundMotion motion = read_record(folder.write("a.txt", counts + "\n100.0\n-50.0\n"));
        CHECK(motion.components.front().name == "1");
        CHECK(motion.components.front().series.samples()[0] == doctest::Approx(1.0));
    }
}

TEST_CASE("velocity and displacement files of the family keep their quantity") {
    const tests::TemporaryFolder folder;
    const auto velocity = folder.write("v", "a\nb\nVELOCITY TIME SERIES IN UNITS OF CM/S\nNPTS= 1, DT= .01 SEC\n 12.5\n");
    const auto displacement = folder.write("d", "a\nb\nDISPLACEMENT TIME HISTORY IN UNITS OF CM. FILTER\nNPTS= 1, DT= .01 SEC\n 12.5\n");

    CHECK(read_record(velocity).components.front().series.quantity() == SampleQuantity::velocity);
    CHECK(read_record(velocity).components.front().series.samples()[0] == 0.125);
    CHECK(read_record(displacement).format == "PEER DT2");
    CHECK(read_record(displacement).components.front().series.quantity() == SampleQuantity::displacement);
}

TEST_CASE("every defect of a PEER file is reported with its line") {
    struct Case {
        std::string content;
        std::string said;
    };
    const tests::TemporaryFolder folder;
    for (const Case& row : {
             Case{kHeader + "NPTS= 3, DT= .005 SEC\n1 2\n", "a.at2:5: 2 values for NPTS = 3 (file is truncated)"},
             Case{kHeader + "NPTS= 3, DT= .005 SEC\n1 2\n3 4\n", "a.at2:6: more values than NPTS = 3"},
             Case{kHeader + "NPTS= 3, DT= .005 SEC\n1 NaN 3\n", "a.at2:5: sample 2 is 'NaN' (no finite number)"},
             Case{kHeader + "NPTS= 3, DT= .005 SEC\n1 2\ninf\n", "a.at2:6: sample 3 is 'inf'"},
             Case{kHeader + "NPTS= 3, DT= .005 SEC\n1 2 3e999\n", "a.at2:5: sample 3 is '3e999'"},
             Case{kHeader + "NPTS= 3, DT= .005 SEC\n1 2 3e308\n", "a.at2:5: sample 3 is '3e308'"},
             Case{kHeader + "NPTS= 3, DT= .005 SEC\n1 2..0 3\n", "a.at2:5: sample 2 is '2..0'"},
             Case{kHeader + "NPTS= 3, DT= .000 SEC\n1 2 3\n", "a.at2:4: time step is 0 s (must be positive)"},
             Case{kHeader + "NPTS= 3, DT= -.01 SEC\n1 2 3\n", "a.at2:4: time step is -0.01 s (must be positive)"},
             Case{kHeader + "NPTS= 3, DT= nan SEC\n1 2 3\n", "a.at2:4: time step 'nan' is no number"},
             Case{kHeader + "NPTS= 3\n1 2 3\n", "a.at2:4: time step is missing"},
             Case{kHeader + "NPTS= 0, DT= .01\n", "a.at2:4: number of points '0' is unusable"},
             Case{kHeader + "NPTS= -3, DT= .01\n1\n", "a.at2:4: number of points '-3' is unusable"},
             Case{kHeader + "NPTS= 99999999999999, DT= .01\n1\n", "a.at2:5: 1 values for NPTS = 99999999999999"},
             Case{"a\nb\nACCELERATION TIME SERIES IN UNITS OF G/10\nNPTS= 1, DT= .01\n1\n", "a.at2:3: unit 'G/10' is unknown"},
         }) {
        CAPTURE(row.content);
        const auto path = folder.write("a.at2", row.content);
        const std::string message = tests::message_of<ReadError>([&] { read_record(path); });
        CAPTURE(message);
        CHECK(message.find(row.said) != std::string::npos);
        CHECK(message.find(';') != std::string::npos);
        CHECK(message.find('\n') == std::string::npos);
    }
}

TEST_CASE("options that contradict a PEER header are refused") {
    const tests::TemporaryFolder folder;
    const auto path = folder.write("a.at2", kHeader + "NPTS= 1, DT= .005 SEC\n1\n");

    CHECK_NOTHROW(read_record(path, {.dt = 0.005 * scaling::si::seconds, .unit = "g", .quantity = SampleQuantity::acceleration}));
    CHECK_THROWS_AS(read_record(path, {.dt = 0.01 * scaling::si::seconds}), ReadError);
    CHECK_THROWS_AS(read_record(path, {.unit = "m/s^2"}), ReadError);
    CHECK_THROWS_AS(read_record(path, {.quantity = SampleQuantity::velocity}), ReadError);
}

TEST_CASE("a component that is not there is refused with those that are") {
    const tests::TemporaryFolder folder;
    const auto path = folder.write("a.at2", kHeader + "NPTS= 1, DT= .005 SEC\n1\n");

    const std::string message = tests::message_of<ReadError>([&] { read_record(path).find_component("360"); });

    CHECK(message == path.string() + ": no component '360' (components: 90); name one of these");
}

}  // namespace
}  // namespace musim::records
