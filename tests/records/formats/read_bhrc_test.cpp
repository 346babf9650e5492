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

// one channel: 13 lines of text, 14 of numbers, the samples from line 28 on, the end mark
std::string channel(const std::string& count, const std::string& rate, const std::string& samples) {
    std::string text = "* VOL1DS FILE:  5526/01\nInst Type = SSA-2\nOrigin Time : 2012/08/11   12:23:16\n\nT\n\nCOMP T3\n";
    text += "Avin                      Station   37.734 N 47.801 E   Altitude 2026m   Azimuth L 50    T 140\nEpicenter\nINSTR\n";
    text += "NO. OF POINTS = " + count + "      DURATION =   .010\nUNITS ARE SECONDS AND G/10\n\n";
    for (int i = 0; i < 8; ++i) text += "    0    0\n";
    text += "  " + rate + "  .000000E+00\n";
    for (int i = 0; i < 5; ++i) text += "  .000000E+00\n";
    return text + samples + "/&\n";
}

const std::string kSamples = "  .100000E+00 -.200000E+00\n";

TEST_CASE("a BHRC channel is in tenths of g, its direction beside the station") {
    const tests::TemporaryFolder folder;

    const GroundMotion motion = read_record(folder.write("a", channel("2", ".200000E+03", kSamples)));

    CHECK(motion.format == "BHRC");
    CHECK(motion.station == "Avin");
    REQUIRE(motion.integration_corner);
    const Component& component = motion.find_component("T");
    CHECK(component.azimuth_deg == 140.0);
    CHECK(component.series.dt().value() == 0.005);
    CHECK(component.series.samples()[1] == relative(-0.02 * 9.80665, 1e-14));
}

TEST_CASE("every defect of a BHRC file is reported with its line") {
    struct Case {
        std::string content;
        std::string said;
    };
    const std::string rate = ".200000E+03";
    for (const Case& row : {
             Case{channel("3", rate, kSamples), "a:28: sample 3 of 3 is missing (file is truncated)"},
             Case{channel("1", rate, kSamples), "a:28: line goes on after sample 1"},
             Case{channel("2", rate, kSamples + kSamples), "a:29: end mark '/&' of the channel is missing"},
             Case{channel("2", rate, "  .100000E+00 -.20x000E+00\n"), "a:28: sample 2 is '-.20x000E+00' (no finite number)"},
             Case{channel("0", rate, kSamples), "a:11: number of points '0' is unusable"},
             Case{channel("1000000000000", rate, kSamples), "a:11: 1000000000000 points of 0.005 s do not make the 0.01 s"},
             Case{channel("2", ".000000E+00", kSamples), "a:22: time step is inf s (must be positive)"},
             Case{channel("2", rate, ""), "a:28: sample 1 is '/&'"},
             Case{channel("2", rate, kSamples) + "junk\n", "a:30: channel header is missing"},
             Case{channel("2", rate, kSamples).substr(0, 150), "unit is missing"},
         }) {
        tests::check_refused(row.content, row.said);
    }
}

TEST_CASE("the BHRC record of Avin has its channels and its peak") {
    if (!tests::have_shared_records()) return;

    const GroundMotion motion = read_record(tests::shared_records() / "bhrc/5526-1.V1");

    CHECK(motion.component_names() == "L, V, T");
    CHECK(motion.components[0].azimuth_deg == 50.0);
    CHECK_FALSE(motion.components[1].azimuth_deg);
    CHECK(motion.components[2].azimuth_deg == 140.0);
    CHECK(motion.station == "Avin");
    CHECK_FALSE(motion.time_zero);
    const TimeSeries& series = motion.components[0].series;
    CHECK(series.size() == 9472);
    CHECK(series.dt().value() == 0.005);
    // README of the records: -0.05915 g/10
    const auto [smallest, largest] = std::minmax_element(series.samples().begin(), series.samples().end());
    CHECK(*smallest / 0.980665 == relative(-0.05915, 5e-4));
    CHECK(*largest < -*smallest);
}

}  // namespace
}  // namespace musim::records
