#include <doctest/doctest.h>
#include <fmt/format.h>

#include <cmath>
#include <string>

#include "records/formats/read_record.hpp"
#include "tests/records/refusal.hpp"
#include "tests/support/relative.hpp"

namespace musim::records {
namespace {

using lsdem::tests::relative;
using tests::replaced;

const scaling::Time kShakeStep = 0.02 * scaling::si::seconds;

double shake_sample(std::size_t i) { return (i % 2 == 0 ? 0.25 : -0.5) * std::sin(0.3 * static_cast<double>(i)); }

/// Samples in columns of a Fortran format, with line numbers or without.
std::string shake_columns(std::size_t count, std::size_t per_line, const std::string& format, bool is_numbered) {
    std::string text;
    for (std::size_t i = 0; i < count; ++i) {
        text += fmt::format(fmt::runtime(format), shake_sample(i));
        if ((i + 1) % per_line == 0 || i + 1 == count) text += is_numbered ? fmt::format("{:7}\n", i / per_line + 1) : "\n";
    }
    return text;
}

void check_shake_samples(const GroundMotion& motion, std::size_t count, double digits) {
    CHECK(motion.format == "SHAKE columns");
    const TimeSeries& series = motion.components.front().series;
    REQUIRE(series.size() == count);
    for (std::size_t i = 0; i < count; ++i) CHECK(std::abs(series.samples()[i] / 9.80665 - shake_sample(i)) <= digits);
}

TEST_CASE("columns that touch are distinguished by their decimal points, in g") {
    const tests::TemporaryFolder folder;
    const GroundMotion motion = read_record(folder.write("a", shake_columns(21, 8, "{:9.6f}", false)), {.dt = kShakeStep});
    check_shake_samples(motion, 21, 0.5e-6);
    CHECK(motion.components.front().series.dt() == kShakeStep);
    CHECK(motion.history.back().find("8 a line in columns of 9 letters, in g (no unit given)") != std::string::npos);

    CHECK(read_record(folder.write("a", shake_columns(21, 8, "{:9.6f}", false)), {.dt = kShakeStep, .unit = "gal"})
              .components.front()
              .series.samples()[1] == relative(std::round(1e6 * shake_sample(1)) * 1e-8, 1e-12));
}

TEST_CASE("SHAKE's own columns are in g though blanks part them") {
    const tests::TemporaryFolder folder;
    // as Fortran writes a third: .333333, and -.333333 leaves a blank
    std::string text;
    for (int i = 0; i < 48; ++i) text += std::string(i % 2 == 0 ? "  .333333" : " -.333333") + (i % 8 == 7 ? "\n" : "");
    const TimeSeries series = read_record(folder.write("a", text), {.dt = kShakeStep}).components.front().series;
    REQUIRE(series.size() == 48);
    CHECK(series.samples()[1] == relative(-0.333333 * 9.80665, 1e-12));
}

TEST_CASE("numbers of lines behind the columns are no samples") {
    const tests::TemporaryFolder folder;
    check_shake_samples(read_record(folder.write("a", shake_columns(24, 8, "{:9.6f}", true)), {.dt = kShakeStep}), 24, 0.5e-6);
    check_shake_samples(read_record(folder.write("b", shake_columns(24, 8, "{:10.6f}", true)), {.dt = kShakeStep}), 24, 0.5e-6);
}

TEST_CASE("a header of any lines may name the format, the time step, the number of values and the unit") {
    const tests::TemporaryFolder folder;
    const std::string columns = shake_columns(21, 5, "{:15.7E}", false);
    const std::string lines = "SOME EARTHQUAKE\nSOME STATION\n";
    for (const std::string_view header : {"21 0.02\n", "Units of g, dt = 0.02 s\n"})
        check_shake_samples(read_record(folder.write("a", lines + std::string(header) + columns)), 21, 0.5e-7);
    CHECK(read_record(folder.write("a", "Units: cm/sec/sec\nTime step: 0.02\n" + columns)).components.front().series.samples()[1] ==
          relative(0.01 * shake_sample(1), 1e-6));
    for (const std::string_view header : {"21 0.02 (5E15.7)\n", "NO. OF POINTS = 21, DT = 0.02 SEC (5E15.7)\n",
                                          "(5e15.7)\nTime step (s): 0.02\nNumber of values: 21 (g)\n"}) {
        const GroundMotion motion = read_record(folder.write("a", lines + std::string(header) + columns));
        check_shake_samples(motion, 21, 0.5e-7);
        CHECK(motion.components.front().series.dt() == kShakeStep);
        CHECK(motion.event == "SOME EARTHQUAKE");
    }
}

TEST_CASE("a last line filled up with zeros is cut to the number of values in the header") {
    const tests::TemporaryFolder folder;
    const std::string filled = "20 0.02\n" + shake_columns(20, 8, "{:9.6f}", false);
    const std::string more = filled.substr(0, filled.size() - 1) + " 0.000000 0.000000 0.000000 0.000000\n";
    CHECK(read_record(folder.write("a", more)).components.front().series.size() == 20);

    tests::check_refused(replaced(more, "20 0.02", "15 0.02"), "a:1: 15 values announced (found: 24)");
    tests::check_refused(replaced(filled, "20 0.02", "25 0.02"), "a:1: 25 values announced (found: 20)");
}

TEST_CASE("every defect of columns is reported with its line") {
    using tests::check_refused;
    const std::string good = shake_columns(24, 8, "{:9.6f}", false);
    const std::string numbered = shake_columns(24, 8, "{:9.6f}", true);
    const ReadOptions step{.dt = kShakeStep};
    check_refused(good, "a: time step is unknown (columns of one component, no time); give the time step");
    check_refused(good, "a: time step is 0 s (must be positive)", {.dt = 0.0 * kShakeStep});
    check_refused(good.substr(0, 80) + good.substr(81), "a:2: '", step);               // a letter is lost
    check_refused(good.substr(0, 110) + "\n" + good.substr(146), "a:2: '", step);      // the second line is cut
    check_refused(replaced(good, good.substr(100, 9), " 0.0x0000"), "a:2: ' ", step);  // no number
    check_refused(replaced(numbered, "      2\n", "      3\n"), "a:2: line is numbered 3 (expected: 2; a line is missing or repeated)",
                  step);
    check_refused(good.substr(0, 20) + good.substr(21), "a:1: '", step);  // a letter of the first line is lost
    check_refused(replaced(good, good.substr(10, 9), " 0.0x0000"), "a:1: '", step);
    check_refused(good + "END\n", "a:4: 'END' does not stand in the columns of line 1", step);
    check_refused("(8F10.6)\n" + good, "a:2: 8 numbers, 9 letters apart (the header's format has 8 of 10 letters)", step);
    check_refused("DT = 0 s\n" + good, "a:1: time step is 0 s (must be positive)", step);
    check_refused("DT = 0.01 s\n" + good, "a: file states its time step 0.01 s (asked for: 0.02 s)", step);
    check_refused("values in (cm/s/s)\n" + good, "a: file states its unit cm/s^2 (asked for: g)", {.dt = kShakeStep, .unit = "g"});
}

TEST_CASE("tables that blanks part are left to the reader of text") {
    const tests::TemporaryFolder folder;
    CHECK(read_record(folder.write("a", "0.00 0.10 1\n0.01 0.20 2\n0.02 0.30 3\n")).format == "text");
    CHECK(read_record(folder.write("b", "0.00 -0.10\n0.01 -0.20\n0.02 -0.30\n")).format == "text");
    // times in columns that touch their values are no samples
    tests::check_refused("  0.00-0.10\n  0.01-0.20\n  0.02-0.30\n  0.03-0.20\n  0.04-0.10\n", "a:", {.dt = kShakeStep});
}

}  // namespace
}  // namespace musim::records
