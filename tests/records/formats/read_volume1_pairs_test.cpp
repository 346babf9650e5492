#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "records/formats/read_record.hpp"
#include "tests/records/refusal.hpp"
#include "tests/support/relative.hpp"
#include "tests/support/shared_records.hpp"
#include "tests/support/temporary_folder.hpp"

namespace musim::records {
namespace {

using lsdem::tests::relative;

// uncorrected channel of (time, value) pairs: 13 lines of text, 14 of numbers, the pairs from line 28 on
std::string channel(const std::string& first_line, const std::string& count, const std::string& peak, const std::string& pairs,
                    const std::string& end) {
    std::string text = first_line + "\nEVENT\n\n\nSTATION USC# 0057   34 25 09N\nPLACE\n";
    text += first_line.starts_with("FILE") ? "COMP N08W   9\n" : "CHAN  1:  90 DEG\n";
    text += "EVENT\nHYPOCENTER\nINSTR\nNO. OF POINTS = " + count + "  RECORD LENGTH = .030 SEC\nUNITS OF UNCOR ACCEL ARE SEC AND G/10." +
            "     MAX  =  " + peak + " G, AT  .020 SEC.\nRMS\n";
    for (int i = 0; i < 14; ++i) text += "    0    0\n";
    return text + pairs + end;
}

const std::string kCsmip = "UNCORRECTED ACCELEROGRAM DATA              PROCESSED: 07/16/98";
const std::string kUsc = "FILE     0 OF UNCORRECTED ACCELEROGRAM DATA OF VOLUME I:";
const std::string kVolume1Pairs = "   .000  0.000   .010  0.010   .019  0.019   .030  0.030\n";
const std::string kEndMark = "/&  ----------  END OF DATA FOR CHANNEL  1  ----------\n";

TEST_CASE("pairs of CSMIP and USC become even samples in tenths of g") {
    const tests::TemporaryFolder folder;

    const GroundMotion csmip = read_record(folder.write("a", channel(kCsmip, "4", ".003", kVolume1Pairs, kEndMark)));
    const GroundMotion usc = read_record(folder.write("b", channel(kUsc, "4", ".003", " " + kVolume1Pairs, "")));

    CHECK(csmip.format == "CSMIP V1");
    CHECK(csmip.find_component("90").azimuth_deg == 90.0);
    CHECK(csmip.history.back() == "90: resampled from 4 uneven samples (0.009 to 0.011 s) to 0.01 s by straight lines");
    CHECK(usc.format == "USC uncorrected");
    CHECK(usc.station == "USC.0057 PLACE");
    CHECK(usc.find_component("N08W").azimuth_deg == 352.0);
    for (const GroundMotion& motion : {csmip, usc}) {
        REQUIRE(motion.integration_corner);
        const TimeSeries& series = motion.components.front().series;
        CHECK(series.dt().value() == 0.01);
        REQUIRE(series.size() == 4);
        for (std::size_t i = 0; i < 4; ++i) CHECK(series.samples()[i] == doctest::Approx(static_cast<double>(i) * 0.01 * 0.980665));
    }
}

TEST_CASE("every defect of pairs is reported with its line") {
    struct Case {
        std::string content;
        std::string said;
    };
    const auto with = [](const std::string& from, const std::string& to) {
        std::string pairs = kVolume1Pairs;
        return channel(kCsmip, "4", ".003", pairs.replace(pairs.find(from), from.size(), to), kEndMark);
    };
    for (const Case& row : {
             Case{channel(kCsmip, "5", ".003", kVolume1Pairs, kEndMark), "a:28: line has 56 letters (70 expected"},
             Case{channel(kCsmip, "3", ".003", kVolume1Pairs, kEndMark), "a:28: line has 56 letters (42 expected"},
             Case{channel(kCsmip, "4", ".003", kVolume1Pairs, ""), "a:28: end mark '/&' of the channel is missing"},
             Case{channel(kCsmip, "4", ".003", kVolume1Pairs + kVolume1Pairs, kEndMark), "a:29: end mark '/&' of the channel is missing"},
             Case{channel(kUsc, "4", ".003", kVolume1Pairs + kVolume1Pairs, ""), "a:29: line behind the last sample"},
             Case{channel(kCsmip, "4", ".005", kVolume1Pairs, kEndMark), "a:12: peak is 0.005 g (largest sample: 0.003;"},
             Case{channel(kCsmip, "1000000000000", ".003", kVolume1Pairs, kEndMark), "a:11: number of points '1000000000000' is unusable"},
             Case{channel(kCsmip, "4", ".003", "", ""), "a:27: sample 1 of 4 is missing"},
             Case{with("  .019", "  .009"), "a:28: time 3 is 0.009 s (not after the one before it)"},
             Case{with("  .019", "  .0x9"), "a:28: number 5 is '.0x9' (no finite number)"},
             Case{with("  .030", " 9.030"), "a:11: 4 points of 3.01 s do not make the 0.03 s"},
         }) {
        tests::check_refused(row.content, row.said);
    }
}

TEST_CASE("real records of pairs have their lengths, steps and peaks") {
    if (!tests::have_shared_records()) return;
    struct Case {
        std::string_view file;
        std::string_view names;
        double azimuth_deg;
        std::size_t size;
        double dt;
        double peak;  ///< of the first channel's pairs [g/10]
        double time;  ///< [s]; Vallenar's header says 22.880, where the samples are at a fifth of the peak
    };
    for (const Case& row : {Case{"csmip/NEWPORT.RAW", "90, UP, 360", 90.0, 12000, 0.005, -0.549, 15.992},
                            Case{"renadic/vallenar1002271.v1", "EW, NS, Z", 90.0, 6900, 0.01, 0.202, 42.88},
                            Case{"usc/017m30cc.y0a", "N00W", 0.0, 7757, 0.004, 4.064, 4.680}}) {
        CAPTURE(row.file);
        const GroundMotion motion = read_record(tests::shared_records() / row.file);
        CHECK(motion.component_names() == row.names);
        REQUIRE(motion.components[0].azimuth_deg);
        CHECK(*motion.components[0].azimuth_deg == row.azimuth_deg);
        const TimeSeries& series = motion.components[0].series;
        CHECK(series.size() == row.size);
        CHECK(series.dt().value() == row.dt);
        // the even clock may miss the peak by half a step: 2 %
        const auto peak = std::max_element(series.samples().begin(), series.samples().end(),
                                           [](double a, double b) { return std::abs(a) < std::abs(b); });
        CHECK(*peak / 0.980665 == relative(row.peak, 0.02));
        CHECK(std::abs(series.time(static_cast<std::size_t>(peak - series.samples().begin())).value() - row.time) <= row.dt);
    }
}

TEST_CASE("the corrected USC record gives the quantity asked for, with its header's peak") {
    if (!tests::have_shared_records()) return;
    const std::filesystem::path path = tests::shared_records() / "usc/017m30bt.s0a";

    const GroundMotion velocity = read_record(path, {.quantity = SampleQuantity::velocity});

    CHECK(velocity.format == "USC corrected");
    CHECK(velocity.station == "USC.0061 BIG TUJUNGA STATION, ANGELES NATIONAL FOREST, CA");
    CHECK(velocity.find_component("N08W").azimuth_deg == 352.0);
    CHECK_FALSE(velocity.integration_corner);
    // header: 12.05681 cm/s at 4.500 s, of the opposite sign
    CHECK(velocity.components.front().series.samples()[225] == relative(-0.12057, 1e-9));
}

}  // namespace
}  // namespace musim::records
