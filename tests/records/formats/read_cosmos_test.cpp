#include <doctest/doctest.h>
#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <string>

#include "records/formats/read_record.hpp"
#include "records/measures/intensity.hpp"
#include "tests/records/refusal.hpp"
#include "tests/support/relative.hpp"
#include "tests/support/shared_records.hpp"
#include "tests/support/temporary_folder.hpp"

namespace musim::records {
namespace {

using lsdem::tests::relative;

/// Values of a channel made for a test; the rest is the same for all.
struct CosmosChannel {
    std::string stage = "Corrected acceleration";
    std::string title = "Sta Chan  1:  90 deg (Rcrdr Chan  1)";
    double azimuth = 90;
    double second = 4.5;
    double step_ms = 10.0;
    double length = 0.03;
    double peak = -9.0;
    double sensitivity = 0.5;
    std::string announced = "       3 acceleration pts, approx    0 secs, units=cm/sec2(04),Format=(2F6.2)";
    std::string samples = "  1.00 -9.00\n  2.00\n";
    std::string end = "End-of-data for Chan  1 acceleration\n";
};

// lines: 13 of text, 15 to 24 of integers, 26 to 45 of reals, 46 and 47 of comment, 48 announces the samples
std::string text_of(const CosmosChannel& channel) {
    std::string text = channel.stage + "  (Format v01.20 with 13 text lines)\nRecord of Some Earthquake\nHypocenter\nOrigin\n" +
                       "Statn No: 02-001795 Code:NP-1795   USGS  SF FS 25 Bayview\nCoords\nRecorder\nRcrd start time\n" + channel.title +
                       "\nRaw\nProcessed\nRecord\nValues\n 100 Integer-header values follow on  10 lines, Format= (10I8)\n";
    for (int i = 1; i <= 100; ++i) {
        int value = -999;
        if (i == 40) value = 2019;
        if (i == 42 || i == 43) value = 5;
        if (i == 44) value = 6;
        if (i == 45) value = 47;
        if (i == 54) value = static_cast<int>(channel.azimuth);
        text += fmt::format("{:8}{}", value, i % 10 == 0 ? "\n" : "");
    }
    text += " 100 Real-header values follow on  20 lines, Format =(5F15.6)\n";
    for (int i = 1; i <= 100; ++i) {
        double value = -999.0;
        if (i == 22) value = 2.0;
        if (i == 30) value = channel.second;
        if (i == 42) value = channel.sensitivity;
        if (i == 47) value = 4.0;
        if (i == 62) value = channel.step_ms;
        if (i == 63) value = channel.length;
        if (i == 64) value = channel.peak;
        text += fmt::format("{:15.6f}{}", value, i % 5 == 0 ? "\n" : "");
    }
    return text + "   1 Comment line(s) follow, each starting with a \"|\":\n|<SCNL>1795.HNE.NP.--\n" + channel.announced + "\n" +
           channel.samples + channel.end;
}

TEST_CASE("a COSMOS channel has the name, direction, unit, start and station of its headers") {
    const tests::TemporaryFolder folder;

    const GroundMotion motion = read_record(folder.write("a", text_of({})));

    CHECK(motion.format == "COSMOS V2");
    CHECK(motion.station == "NP.1795 SF FS 25 Bayview");
    CHECK(motion.event == "Record of Some Earthquake");
    CHECK_FALSE(motion.integration_corner);
    CHECK(motion.time_zero == make_utc_time(2019, 5, 5, 6, 47, 4.5));
    REQUIRE(motion.components.size() == 1);
    const Component& component = motion.components.front();
    CHECK(component.name == "90");
    CHECK(component.azimuth_deg == 90.0);
    CHECK(component.series.dt().value() == 0.01);
    REQUIRE(component.series.size() == 3);
    CHECK(component.series.samples()[1] == relative(-0.09, 1e-14));
}

TEST_CASE("channels of a COSMOS file that start later say so, and one without direction goes by its code") {
    const tests::TemporaryFolder folder;

    const GroundMotion motion =
        read_record(folder.write("a", text_of({}) + text_of({.title = "Sta Chan   ?:Other   (Rcrdr", .azimuth = 0, .second = 6.75})));

    CHECK(motion.component_names() == "90, HNE");
    CHECK(motion.components[0].series.start().value() == 0.0);
    CHECK(motion.components[1].series.start().value() == 2.25);
    CHECK_FALSE(motion.components[1].azimuth_deg);
}

TEST_CASE("counts of a COSMOS file become accelerations by its recorder and sensor") {
    const tests::TemporaryFolder folder;
    const CosmosChannel raw{.stage = "Raw acceleration counts",
                            .peak = 1341629.0,
                            .announced = "       3 raw accel.   pts, approx    0 secs, units=counts (50),Format=(10I8)",
                            .samples = "-1341624-1341629-1341621\n"};

    const GroundMotion motion = read_record(folder.write("a", text_of(raw)));

    CHECK(motion.format == "COSMOS V0");
    REQUIRE(motion.integration_corner);
    CHECK(motion.integration_corner->value() == 0.05);
    // 2 microvolts a count through a gain of 4, 0.5 V for one g: 1e-6 g a count
    CHECK(motion.components[0].series.samples()[1] == relative(-1.341629 * 9.80665, 1e-14));
}

TEST_CASE("a COSMOS file with several quantities gives the one asked for") {
    const tests::TemporaryFolder folder;
    const CosmosChannel velocity{.stage = "Corrected velocity",
                                 .announced = "       3 velocity     pts, approx    0 secs, units=cm/sec (05),Format=(2F6.2)"};
    const auto path = folder.write("a", text_of({}) + text_of(velocity));

    CHECK(read_record(path).components.front().series.quantity() == SampleQuantity::acceleration);
    const GroundMotion asked = read_record(path, {.quantity = SampleQuantity::velocity});
    REQUIRE(asked.components.size() == 1);
    CHECK(asked.components.front().series.quantity() == SampleQuantity::velocity);
    CHECK(tests::message_of<ReadError>([&] {
              read_record(path, {.quantity = SampleQuantity::displacement});
          }).find("file has no displacement (asked for)") != std::string::npos);
    CHECK(tests::message_of<ReadError>([&] {
              read_record(path, {.dt = 0.02 * scaling::si::seconds});
          }).find("file states its time step 0.01 s") != std::string::npos);
}

TEST_CASE("every defect of a COSMOS file is reported with its line") {
    struct Case {
        std::string content;
        std::string said;
    };
    const std::string whole = text_of({});
    const std::string announced = CosmosChannel{}.announced;
    const auto with = [](std::string text, const std::string& from, const std::string& to) {
        return text.replace(text.find(from), from.size(), to);
    };
    for (const Case& row : {
             Case{text_of({.samples = "  1.00 -9.00\n", .end = ""}), "a:49: sample 3 of 3 is missing (file is truncated)"},
             Case{text_of({.samples = "  1.00 -9.00\n  2.00  3.00\n"}), "a:50: line goes on after sample 3"},
             Case{text_of({.samples = "  1.00 -9.00\n  2.00\n  3.00\n"}), "a:51: end mark 'End-of-data' of the channel is missing"},
             Case{text_of({.end = ""}), "a:50: end mark 'End-of-data' of the channel is missing"},
             Case{text_of({.samples = "  1.00 -9.0x\n  2.00\n"}), "a:49: sample 2 is '-9.0x' (no finite number)"},
             Case{text_of({.samples = "  1.00    -9\n  2.00\n"}), "a:49: sample 2 is '-9' (no decimal point in its column)"},
             Case{text_of({.samples = "  1.00 -8.00\n  2.00\n"}), "a:38: peak is -9 cm/s^2 (largest sample: 8;"},
             Case{text_of({.samples = "", .end = ""}), "a:48: sample 1 of 3 is missing"},
             Case{text_of({.azimuth = 180}), "a:20: azimuth is 180 (line 9 says 90 Deg"},
             Case{text_of({.step_ms = 0.0}), "a:38: time step is 0 s (must be positive)"},
             Case{text_of({.step_ms = 50.0, .length = 0.9}), "a:48: 3 points of 0.05 s do not make the 0.9 s of line 38"},
             Case{with(whole, "       3 acc", "       0 acc"), "a:48: number of points '0' is unusable"},
             Case{with(whole, "       3 acc", "1000000000000 acc"), "a:48: 1000000000000 points of 0.01 s do not make"},
             Case{with(text_of({.length = -999}), "       3 acc", "1000000000000 acc"), "a:50: sample 4 of 1000000000000"},
             Case{with(whole, "units=cm/sec2", "units=volts"), "a:48: unit 'volts' is unknown"},
             Case{with(whole, "Format=(2F6.2)", ""), "a:48: Fortran format is missing"},
             Case{with(whole, " 100 Real", "9999 Real"), "a:46: real-header value 101 is '1 Comment li' (no decimal point"},
             Case{with(whole, " 100 Integer", " x00 Integer"), "a:14: number of integer-header values 'x00' is unusable"},
             Case{with(whole, "with 13 text", "with 99999999 text"), "a:1: channel header is unusable"},
             Case{whole + "junk\n", "a:52: channel header is unusable"},
             Case{text_of({.stage = "Raw acceleration counts",
             .sensitivity = -999.0,
             .announced = "       3 raw accel.   pts, units=counts (50),Format=(10I8)"}),
                  "a:34: real-header value 42 is -999 (counts need"},
         }) {
        tests::check_refused(row.content, row.said);
    }
}

TEST_CASE("the raw counts of Fort Bragg come back with their station, start and offsets") {
    if (!tests::have_shared_records()) return;

    const GroundMotion motion = read_record(tests::shared_records() / "cosmos/NP1795-n.305.v0c");

    CHECK(motion.format == "COSMOS V0");
    CHECK(motion.component_names() == "90, 360, Up");
    CHECK(motion.components[0].azimuth_deg == 90.0);
    CHECK_FALSE(motion.components[2].azimuth_deg);
    CHECK(motion.station == "NP.1795 SF FS 25 Bayview");
    CHECK(motion.time_zero == make_utc_time(2019, 5, 5, 6, 47, 39.93249));
    // headers: 0.794729 microvolts a count and 1.2 V for one g; the first channel is farthest from zero, -985881 counts, at 45.290 s
    const double si = 0.794729e-6 / 1.2 * 9.80665;
    const TimeSeries& series = motion.components[0].series;
    CHECK(series.size() == 20000);
    CHECK(series.dt().value() == 0.005);
    CHECK(series.samples()[9058] == relative(-985881.0 * si, 1e-12));
    for (const double sample : series.samples()) REQUIRE(std::abs(sample) <= std::abs(series.samples()[9058]));
}

TEST_CASE("the COSMOS test file whose headers name two directions is refused, and read once they agree") {
    if (!tests::have_shared_records()) return;
    const std::filesystem::path file = tests::shared_records() / "cosmos/Cosmos12TimeSeriesTest2.v1";

    // 400 is COSMOS's number for up (so in CE23837.V1C): one of "up" and "340 deg" is wrong, and the file cannot say which
    CHECK(tests::message_of<ReadError>([&] {
              read_record(file);
          }).find("Cosmos12TimeSeriesTest2.v1:20: azimuth is 400 (line 9 says 340 Deg; header is damaged)") != std::string::npos);

    // the number that the file's one-channel sister gives; README of the records: -161.96 cm/s² at 27.850 s and 5.77 cm/s in both channels
    const tests::TemporaryFolder folder;
    const auto mended = folder.write("a", tests::replaced(tests::bytes_of(file), "-999     400      20", "-999     340      20"));
    const GroundMotion motion = read_record(mended);
    CHECK(motion.component_names() == "340, 90");
    for (const Component& component : motion.components) {
        const Intensity intensity = compute_intensity(component.series, motion.integration_corner);
        CHECK(component.series.size() == 7000);
        CHECK(component.series.dt().value() == 0.01);
        CHECK(intensity.pga->value.value() * 100.0 == relative(-161.962, 5e-6));
        CHECK((intensity.pga->time - component.series.start()).value() == relative(27.850, 1e-9));
        CHECK(std::abs(intensity.pgv->value.value()) * 100.0 == relative(5.77, 0.01));
    }
}

TEST_CASE("the COSMOS record of Pomona has its directions and its start") {
    if (!tests::have_shared_records()) return;

    const GroundMotion motion = read_record(tests::shared_records() / "cosmos/CE23837.V1C");

    CHECK(motion.format == "COSMOS V1");
    CHECK(motion.component_names() == "360, Up, 90");
    CHECK(motion.components[0].azimuth_deg == 360.0);
    CHECK(motion.station == "CE.23837 Pomona - Orange Grove & Fairplex");
    CHECK(motion.time_zero == make_utc_time(2018, 8, 29, 2, 33, 0.0));
    CHECK(motion.integration_corner);
}

}  // namespace
}  // namespace musim::records
