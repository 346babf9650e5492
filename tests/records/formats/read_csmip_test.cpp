#include <doctest/doctest.h>

#include <string>

#include "records/formats/read_record.hpp"
#include "tests/records/refusal.hpp"
#include "tests/support/temporary_folder.hpp"

namespace musim::records {
namespace {

// one uncorrected channel of three samples: 13 text lines, 7 of integers, 7 of reals, the samples and the end mark
std::string volume1_channel(const std::string& title, const std::string& azimuth, const std::string& announced,
                            const std::string& samples) {
    std::string text =
        "Uncorrected Accelerogram Data             Processed: 07/06/19, CGS\nRcrd of Fri Jul  5, 2019\n\nid\nStation Id.\nChina Lake\n";
    text += "Chan  1: " + title + "\nRcrd\nHypocenter\nInstr Period\n";
    text += "No. of Points =      3  Record Length =   .030 sec   at 100 Samples/sec\nUnits of uncor data are sec and g.\nRMS\n";
    text += "    1  100\n" + std::string(50, ' ') + azimuth + "    3\n";
    for (int i = 0; i < 12; ++i) text += "      .000\n";
    return text + announced + "\n" + samples + "/&  ----------  End of Data for Station Channel   1  ----------\n";
}

const std::string kAnnounced = "     3 Accelerogram points at 100 pts/sec in units of g.       Format: (2f9.6)";
const std::string kCsmipSamples = " -.000011-1.000011\n  .000001\n";

TEST_CASE("samples without blanks between them are read by their columns") {
    const tests::TemporaryFolder folder;
    const auto path = folder.write("a", volume1_channel("360 Deg", "  360", kAnnounced, kCsmipSamples));

    const GroundMotion motion = read_record(path);

    CHECK(motion.format == "CSMIP V1");
    CHECK(motion.station == "China Lake");
    REQUIRE(motion.integration_corner);
    CHECK(motion.integration_corner->value() == 0.05);
    const Component& component = motion.find_component("360");
    CHECK(component.azimuth_deg == 360.0);
    CHECK(component.series.dt().value() == 0.01);
    REQUIRE(component.series.size() == 3);
    CHECK(component.series.samples()[0] == -0.000011 * 9.80665);
    CHECK(component.series.samples()[1] == -1.000011 * 9.80665);
    CHECK(component.series.samples()[2] == 0.000001 * 9.80665);
}

TEST_CASE("channels of one file keep their own names, and the vertical has no azimuth") {
    const tests::TemporaryFolder folder;
    const auto path = folder.write(
        "a", volume1_channel(" 90 Deg", "   90", kAnnounced, kCsmipSamples) + volume1_channel(" Up", "  500", kAnnounced, kCsmipSamples));

    const GroundMotion motion = read_record(path);

    CHECK(motion.component_names() == "90, Up");
    CHECK_FALSE(motion.find_component("up").azimuth_deg);
}

TEST_CASE("the start time of a CSMIP file is its clock's zero, where that is in UTC") {
    const tests::TemporaryFolder folder;
    const auto start_of = [&](const std::string& line) {
        std::string text = volume1_channel("360 Deg", "  360", kAnnounced, kCsmipSamples);
        text.replace(text.find("\nid\n"), 4, "\n" + line + "\n");
        return read_record(folder.write("a", text)).time_zero;
    };
    CHECK(start_of("38457487.CI.CLC.--.HN      Start time:  7/06/19, 03:16: 8.0 UTC (GPS)") == make_utc_time(2019, 7, 6, 3, 16, 8.0));
    CHECK(start_of("58667   START TIME: 12/31/99, 23:59:59.5 UTC") == make_utc_time(1999, 12, 31, 23, 59, 59.5));
    for (const char* const other : {"id", "Trigger time: 06/28/92, 15:05:37.4 UTC", "Start time: 06/28/92, 15:05:37.4 PDT",
                                    "Start time: 99/99/99, 1:1:1 UTC", "Start time: 1e99/1/19, 1:1:1 UTC", "Start time:"}) {
        CHECK_FALSE_MESSAGE(start_of(other), other);
    }
}

TEST_CASE("every defect of a CSMIP file is reported with its line") {
    struct Case {
        std::string content;
        std::string said;
    };
    const std::string title = "360 Deg";
    for (const Case& row : {
             Case{volume1_channel(title, "  900", kAnnounced, kCsmipSamples), "a:15: azimuth is 900 (line 7 says 360 Deg"},
             Case{volume1_channel(title, "  360", kAnnounced, " -.000011-1.000011\n"), "a:30: sample 3 is '/&  -----' (no decimal point"},
             Case{volume1_channel(title, "  360", kAnnounced, kCsmipSamples + "  .000001\n"),
                  "a:31: end mark '/&' of the channel is missing"},
             Case{volume1_channel(title, "  360", kAnnounced, " -.000011-1.000011\n  .000001  .000002\n"),
                  "a:30: line goes on after sample 3"},
             Case{volume1_channel(title, "  360", kAnnounced, " -.000011*********\n  .000001\n"), "a:29: sample 2 is '*********'"},
             Case{volume1_channel(title, "  360", kAnnounced, " -.000011     NaN \n  .000001\n"), "a:29: sample 2 is 'NaN'"},
             Case{volume1_channel(title, "  360", "     4 Accelerogram points at 100 pts/sec in units of g. (2f9.6)", kCsmipSamples),
                  "a:28: 4 points announced (line 11 says '3')"},
             Case{volume1_channel(title, "  360", "     3 Accelerogram points at   0 pts/sec in units of g. (2f9.6)", kCsmipSamples),
                  "a:28: time step is inf s (must be positive)"},
             Case{volume1_channel(title, "  360", "     3 Accelerogram points at  10 pts/sec in units of g. (2f9.6)", kCsmipSamples),
                  "a:28: 3 points of 0.1 s do not make the 0.03 s of line 11"},
             Case{volume1_channel(title, "  360", "     3 Accelerogram points at 100 pts/sec in units of volt. (2f9.6)", kCsmipSamples),
                  "a:28: unit 'volt.' is unknown"},
             Case{volume1_channel(title, "  360", kAnnounced, kCsmipSamples) + "junk\n", "a:32: channel header is missing"},
         }) {
        tests::check_refused(row.content, row.said);
    }
}

TEST_CASE("an uncorrected record has no velocity to offer") {
    const tests::TemporaryFolder folder;
    const auto path = folder.write("a", volume1_channel("360 Deg", "  360", kAnnounced, kCsmipSamples));

    CHECK(tests::message_of<ReadError>([&] {
              read_record(path, {.quantity = SampleQuantity::velocity});
          }).find("channel has no velocity") != std::string::npos);
}

}  // namespace
}  // namespace musim::records
