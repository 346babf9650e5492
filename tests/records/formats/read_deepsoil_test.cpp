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

const std::string kDeepsoilFile = "4 0.005\n0.0000\t0.001\n0.0050\t-0.002\n0.0100\t0.003\n0.0150\t0.5\n";

TEST_CASE("a DEEPSOIL motion is in g, and an option may say otherwise") {
    const tests::TemporaryFolder folder;
    const auto path = folder.write("a", kDeepsoilFile);

    const GroundMotion motion = read_record(path);
    CHECK(motion.format == "DEEPSOIL");
    const TimeSeries& series = motion.components.front().series;
    CHECK(series.start().value() == 0.0);
    CHECK(series.dt().value() == 0.005);
    REQUIRE(series.size() == 4);
    CHECK(series.samples()[3] == relative(0.5 * 9.80665, 1e-15));
    CHECK(motion.history.back().find(kUnitNotGiven) != std::string::npos);

    CHECK(read_record(path, {.unit = "cm/s^2"}).components.front().series.samples()[3] == relative(0.005, 1e-15));
    CHECK(read_record(path, {.unit = "cm/s^2"}).history.back().find(kUnitNotGiven) == std::string::npos);
}

TEST_CASE("the time step is the more precise one of header and times") {
    const tests::TemporaryFolder folder;
    // 1/128 s: times of four digits, then a header of two
    std::string fine = "9 0.0078125\n", rough = "9 0.0078\n";
    for (int i = 0; i < 9; ++i) {
        fine += fmt::format("{:.4f} 0.1\n", i / 128.0);
        rough += fmt::format("{:.7f} 0.1\n", i / 128.0);
    }
    CHECK(read_record(folder.write("a", fine)).components.front().series.dt().value() == 0.0078125);
    CHECK(read_record(folder.write("b", rough)).components.front().series.dt().value() == 0.0078125);
}

TEST_CASE("every defect of a DEEPSOIL motion is reported with its line") {
    using tests::check_refused;
    check_refused(replaced(kDeepsoilFile, "4 0", "5 0"), "a:5: 4 rows for number of points = 5 (file is truncated)");
    check_refused(replaced(kDeepsoilFile, "4 0", "3 0"), "a:5: more rows than number of points = 3");
    check_refused(replaced(kDeepsoilFile, "-0.002", "-0.00x"), "sample");
    check_refused(replaced(kDeepsoilFile, "0.0100\t", "0.0110\t"), "a:4: time is 0.011 s (even sampling gives 0.01 s)");
    check_refused(replaced(kDeepsoilFile, "0.003", "0.003 1"), "a:4: 3 values (the header names 2 columns)");
    check_refused(kDeepsoilFile, "a: file states its time step 0.005 s (asked for: 0.01 s)", {.dt = 0.01 * scaling::si::seconds});
    // the first step alone is that of the header
    check_refused("4 0.005\n0.000 1\n0.005 2\n0.010 3\n0.035 4\n", "a:5: time is 0.035 s (even sampling gives 0.015 s)");
}

TEST_CASE("rows of times and values that do not follow a row of counts are no DEEPSOIL motion") {
    const tests::TemporaryFolder folder;
    CHECK(read_record(folder.write("a", "0 0.005\n0.01 0\n0.02 0.005\n0.03 0.01\n")).format == "text");
}

}  // namespace
}  // namespace musim::records
