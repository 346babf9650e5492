#include <doctest/doctest.h>
#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <string>

#include "tests/cli/program.hpp"

using namespace musim::cli;

namespace {

/// Number, time [s], sine of 1 Hz and half of it [m/s²] at 100 Hz, under three lines of text.
std::string make_table() {
    std::string text = "by hand\nof a table\nsample,t,a,b\n";
    for (int i = 0; i <= 400; ++i) {
        const double a = std::sin(2.0 * std::numbers::pi * 0.01 * i);
        text += fmt::format("{},{:.2f},{:.9f},{:.9f}\n", i, 0.01 * i, a, 0.5 * a);
    }
    return text;
}

constexpr const char* kColumnsScene = R"({"schema": "musim-scene/1", "material": "wood",
    "structure": {"kind": "column", "layers": 2, "block": ["12.710 mm", "26.355 mm", "39.780 mm"]},
    "base_motion": {"record": "a.csv", "components": {"x": "x"}, "columns": {"time": 2, "x": 4}, "skip": 3}, "time": {"duration": "1 s"}})";

}  // namespace

TEST_CASE("columns and lines of a text record are chosen by options and by keys of a scene") {
    const Workplace here;
    here.write("a.csv", make_table());
    const Outcome outcome = here.run("record info --json a.csv --unit m/s^2 --skip 3 --columns time=2,up=4,x=3");
    REQUIRE_MESSAGE(outcome.exit_code == 0, outcome.err);
    const auto components = outcome.json()["components"];
    REQUIRE(components.size() == 2);
    CHECK(components[0]["component"] == "up");
    CHECK(components[0]["dt_s"] == 0.01);
    CHECK(components[0]["pga_g"].get<double>() == doctest::Approx(0.5 / 9.80665).epsilon(1e-6));
    CHECK(components[1]["component"] == "x");
    CHECK(components[1]["pga_g"].get<double>() == doctest::Approx(1.0 / 9.80665).epsilon(1e-6));

    CHECK(here.run("rescale a.csv --unit m/s^2 --columns time=2,x=3 --length 1/4 -o b.csv").exit_code == 0);
    CHECK(here.run("new column --record a.csv --columns time=2,x=3 --skip 3 --component x=x -o new.json").exit_code == 0);
    here.write("scene.json", kColumnsScene);
    for (const char* const scene : {"scene.json", "new.json"}) {
        const Outcome checked = here.run(std::string("check ") + scene);
        CHECK_MESSAGE(checked.exit_code == 0, checked.err);
    }
    CHECK(here.run("record info a.csv --columns time").err.find("'time' is not NAME=COLUMN") != std::string::npos);
    CHECK(here.run("record info a.csv --columns x=7").err.find("no column '7'") != std::string::npos);
    CHECK(here.run("record info a.csv --skip 9000").err.ends_with("correct --skip LINES\n"));
}

TEST_CASE("record info says what of a table of text it leaves out") {
    const Workplace here;
    here.write("a.csv", "Time (s),Acc (g),Temp (degC)\n0,0,20\n0.01,0.1,20\n0.02,-0.1,20\n0.03,0,20\n");
    const Outcome outcome = here.run("record info a.csv");
    CHECK(outcome.exit_code == 0);
    CHECK_MESSAGE(outcome.err.find("musim: note: a.csv: column 3 'Temp (degC)' is left out (a temperature)") != std::string::npos,
                  outcome.err);
}
