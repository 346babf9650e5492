#include <doctest/doctest.h>
#include <fmt/format.h>

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

/// Values of a file made for a test; the rest is the same for all.
struct File {
    std::string title = "2 CORRECTED ACCELEROGRAM";
    std::string station = "station = Somewhere, FS 25   component=    360";
    int azimuth = 360;
    int comments = 1;
    long count = 9;
    int digits = -32768;
    double rate = 200.0;
    double largest = 8.0;
    double smallest = -9.0;
    std::string body =
        " 1.0000E+0-2.0000E+0 3.0000E+0 4.0000E+0 5.0000E+0 6.0000E+0 7.0000E+0 8.0000E+0\n"
        "-9.0000E+0\n";
};

// lines: 11 of text, 12 to 17 of integers, 18 to 27 of reals, 28 a comment, 29 the first samples
std::string smc_text_of(const File& file) {
    std::string text = file.title + "\n*\n*\n     2011  08  23    1751 MINERAL, VA\n*\n" + file.station + "\n*\n*\n*\n*\n*\n";
    for (int i = 1; i <= 48; ++i) {
        long value = -32768;
        const int date[] = {2011, 235, 17, 50, 56, 250};
        if (i >= 2 && i <= 7) value = date[i - 2];
        if (i == 14) value = file.azimuth;
        if (i == 16) value = file.comments;
        if (i == 17) value = file.count;
        if (i == 30) value = 2555;
        if (i == 47) value = file.digits;
        text += fmt::format("{:10}{}", value, i % 8 == 0 ? "\n" : "");
    }
    for (int i = 1; i <= 50; ++i) {
        double value = 1.7e38;
        if (i == 2) value = file.rate;
        if (i == 30) value = file.largest;
        if (i == 32) value = file.smallest;
        text += fmt::format("{:15.7E}{}", value, i % 5 == 0 ? "\n" : "");
    }
    return text + "| comment\n" + file.body;
}

const std::string kPairs = " 0.0000E+0 0.0000E+0 1.0000E-2 1.0000E+0 1.9000E-2 1.9000E+0 3.0000E-2 3.0000E+0\n 4.0000E-2 4.0000E+0\n";

TEST_CASE("an SMC file has the station, component, start and unit of its header") {
    const tests::TemporaryFolder folder;

    const GroundMotion motion = read_record(folder.write("a", smc_text_of({})));

    CHECK(motion.format == "SMC");
    CHECK(motion.station == "2555 Somewhere, FS 25");
    CHECK(motion.event == "2011  08  23    1751 MINERAL, VA");
    CHECK(motion.time_zero == make_utc_time(2011, 8, 23, 17, 50, 56.25));
    CHECK_FALSE(motion.integration_corner);
    const Component& component = motion.find_component("360");
    CHECK(component.azimuth_deg == 360.0);
    CHECK(component.series.dt().value() == 0.005);
    REQUIRE(component.series.size() == 9);
    CHECK(component.series.samples()[8] == relative(-0.09, 1e-14));
}

TEST_CASE("samples of eight digits stand five a line, and the first letter gives the quantity") {
    const tests::TemporaryFolder folder;
    const File fine{
        .title = "3 VELOCITY", .count = 2, .digits = 8, .largest = 3.0, .smallest = 1.5, .body = " 1.5000000E+00 3.0000000E+00\n"};

    const TimeSeries series = read_record(folder.write("a", smc_text_of(fine))).components.front().series;

    CHECK(series.quantity() == SampleQuantity::velocity);
    CHECK(series.samples()[1] == relative(0.03, 1e-14));
}

TEST_CASE("an SMC file without a sampling rate holds times and values, which become even") {
    const tests::TemporaryFolder folder;
    const File uneven{.title = "1 UNCORRECTED ACCELEROGRAM", .count = 10, .rate = 1.7e38, .largest = 4.0, .smallest = 0.0, .body = kPairs};

    const GroundMotion motion = read_record(folder.write("a", smc_text_of(uneven)));

    REQUIRE(motion.integration_corner);
    const TimeSeries& series = motion.components.front().series;
    CHECK(series.dt().value() == 0.01);
    REQUIRE(series.size() == 5);
    // the line through the pairs is 100 t, in cm/s²
    for (std::size_t i = 0; i < 5; ++i) CHECK(std::abs(series.samples()[i] - series.time(i).value()) <= 1e-13 * series.end().value());
    REQUIRE(motion.history.size() == 2);
    CHECK(motion.history.back() == "resampled from 5 uneven samples (0.009 to 0.011 s) to 0.01 s by straight lines");
}

TEST_CASE("times of an SMC file that rounding made equal are spread within their last digit") {
    const tests::TemporaryFolder folder;
    // 10.001 and 10.004 s print as 1.0000E+1, whose last digit is a millisecond
    const std::string pairs = " 9.9900E+0 0.0000E+0 1.0000E+1 1.0000E+0 1.0000E+1 2.0000E+0 1.0010E+1 3.0000E+0\n 1.0020E+1 4.0000E+0\n";
    const File rounded{.title = "1 UNCORRECTED ACCELEROGRAM", .count = 10, .rate = 1.7e38, .largest = 4.0, .smallest = 0.0, .body = pairs};

    const GroundMotion motion = read_record(folder.write("a", smc_text_of(rounded)));

    CHECK(motion.history.back().find("2 times that are printed alike spread within their last digit") != std::string::npos);
    const TimeSeries& series = motion.components.front().series;
    // the two lie 0.25 ms before and behind 10.000 s
    CHECK(series.dt().value() == relative(0.00975, 1e-9));
    CHECK(series.samples()[0] == 0.0);
    CHECK(series.samples()[1] == relative(0.01, 1e-9));
}

TEST_CASE("an SMC file of unknown content is acceleration unless another quantity is asked for") {
    const tests::TemporaryFolder folder;
    const auto path = folder.write("a", smc_text_of({.title = "0 UNKNOWN"}));

    CHECK(read_record(path).components.front().series.quantity() == SampleQuantity::acceleration);
    CHECK(read_record(path, {.quantity = SampleQuantity::displacement}).components.front().series.quantity() ==
          SampleQuantity::displacement);
}

TEST_CASE("every defect of an SMC file is reported with its line") {
    struct Case {
        std::string content;
        std::string said;
    };
    const std::string body = File{}.body;
    const File uneven{.count = 10, .rate = 1.7e38, .largest = 4.0, .smallest = 0.0, .body = kPairs};
    const auto uneven_with = [&](const std::string& from, const std::string& to) {
        File changed = uneven;
        changed.body.replace(changed.body.find(from), from.size(), to);
        return smc_text_of(changed);
    };
    for (const Case& row : {
             Case{smc_text_of({.count = 10}), "a:30: sample 10 of 10 is missing (file is truncated)"},
             Case{smc_text_of({.count = 8, .smallest = 0.0}), "a:30: line behind the last sample"},
             Case{smc_text_of({.body = body + " 1.0000E+0\n"}), "a:31: line behind the last sample"},
             Case{smc_text_of({.body = ""}), "a:28: sample 1 of 9 is missing"},
             Case{smc_text_of({.count = 9999999999}), "a:30: sample 10 of 9999999999 is missing"},
             Case{smc_text_of({.count = 0}), "a:14: number of values is 0 (must be a positive integer)"},
             Case{smc_text_of({.count = -32768}), "a:14: number of values is -32768"},
             Case{smc_text_of({.rate = 0.0}), "a:18: time step is inf s (must be positive)"},
             Case{smc_text_of({.rate = -5.0}), "a:18: time step is -0.2 s (must be positive)"},
             Case{smc_text_of({.smallest = -9.1}), "a:23: peak is 9.1 cm/s^2 (largest sample: 9;"},
             Case{smc_text_of({.azimuth = 90}), "a:13: azimuth is 90 (line 6 says 360 Deg"},
             Case{smc_text_of({.comments = 2}), "a:13: 2 comments announced (found: 1"},
             Case{smc_text_of({.digits = 7}), "a:17: 7 digits a value (known: 5 and 8)"},
             Case{smc_text_of({.title = "5 RESPONSE SPECTRA"}), "a:1: file holds spectra"},
             Case{smc_text_of({.body = " 1.0000E+x" + body.substr(10)}), "a:29: sample 1 is '1.0000E+x' (no finite number)"},
             Case{smc_text_of({}).substr(0, 1000), "a:23: real-header value 27 of 50 is missing (file is truncated)"},
             Case{uneven_with("1.9000E-2", "0.9000E-2"), "a:29: time 3 is 0.009 s (not after the one before it)"},
             Case{uneven_with("4.0000E-2", "9.9000E+9"), "a:29: times are too uneven to resample"},
             Case{smc_text_of({.rate = 1.7e38}), "a:29: 9 numbers announced (pairs of time and value need an even count)"},
         }) {
        tests::check_refused(row.content, row.said);
    }
}

TEST_CASE("the uneven SMC record of Redwood City becomes even without losing its peak") {
    if (!tests::have_shared_records()) return;

    const GroundMotion motion = read_record(tests::shared_records() / "smc/np01002r_4225a_u.smc");

    // 49758 numbers are 24879 pairs, up to 35.963 s; the median step is 1.4 ms
    const TimeSeries& series = motion.find_component("133").series;
    CHECK(motion.station == "1002 APEEL Array #2 - Redwood City");
    CHECK_FALSE(motion.time_zero);  // the header's time is the earthquake's, to the minute
    CHECK(series.dt().value() == 0.0014);
    CHECK(series.size() == 25688);
    CHECK(motion.history.back() == "resampled from 24879 uneven samples (0.0005 to 0.0095 s) to 0.0014 s by straight lines");
    // header: -228.4229 cm/s² at 7.555369 s; 1 %: the even clock may miss the peak by half a step
    const auto peak = std::min_element(series.samples().begin(), series.samples().end());
    CHECK(*peak * 100.0 == relative(-228.4229, 0.01));
    CHECK(std::abs(series.time(static_cast<std::size_t>(peak - series.samples().begin())).value() - 7.555369) <= 0.0014);
    CHECK(*std::max_element(series.samples().begin(), series.samples().end()) * 100.0 == relative(179.6, 0.01));
}

TEST_CASE("real SMC records have their stations, directions and, where given, their start") {
    if (!tests::have_shared_records()) return;
    const GroundMotion reston = read_record(tests::shared_records() / "smc/2516b_a.smc");
    const GroundMotion alhambra = read_record(tests::shared_records() / "smc/0165b_a.smc");

    CHECK(reston.station == "2555 VA: Reston; Fire Station #25");
    CHECK(reston.components.front().azimuth_deg == 360.0);
    CHECK(reston.time_zero == make_utc_time(2011, 8, 23, 17, 50, 56.0));
    CHECK(alhambra.component_names() == "up");
    CHECK_FALSE(alhambra.components.front().azimuth_deg);
    CHECK_FALSE(alhambra.time_zero);
}

}  // namespace
}  // namespace musim::records
