#include <doctest/doctest.h>

#include <string>

#include "tests/cli/program.hpp"

using namespace musim::cli;

namespace {

constexpr const char* kTwoColumns = R"({"schema": "musim-scene/1", "name": "two columns",
    "material": {"density": 2320, "normal_stiffness": "2 GN/m", "shear_stiffness": "2 GN/m", "friction": 0.3, "restitution": 0.3},
    "structure": {"kind": "column", "layers": 3, "block": ["2 m", "2 m", "1 m"]},
    "base_motion": {"signal": "sine", "direction": "x", "amplitude": "0.4 g", "frequency": "4 Hz", "cycles": 1},
    "time": {"duration": "0.3 s"}, "output": {"spine_rate": "500 Hz", "frame_rate": "50 Hz"}})";

}  // namespace

TEST_CASE("report makes one page of a pair, and its plots as files with their data") {
    const Workplace here;
    here.write("scene.json", kTwoColumns);
    REQUIRE(here.run("pair scene.json --length 1/16 --length 1/25 -o out").exit_code == 0);
    const Outcome outcome = here.run("report out -o page.html --figures figures --json");
    REQUIRE(outcome.exit_code == 0);
    const nlohmann::json json = outcome.json();
    CHECK(json["runs"] == 3);
    CHECK(json["remarks"].empty());
    const std::string page = here.read("page.html");
    CHECK(page.size() == json["bytes"].get<std::size_t>());
    // a power of four
    CHECK(page.find("the same as the prototype, bit for bit") != std::string::npos);
    CHECK(page.find("No group is distorted") != std::string::npos);
    CHECK(page.find("t √(μ g / l)") != std::string::npos);
    for (const char* name : {"spine_velocity", "departure", "energy_prototype", "slip", "residual_displacement_x"}) {
        CHECK_MESSAGE(here.has(std::string("figures/") + name + ".svg"), name);
        CHECK_MESSAGE(here.read(std::string("figures/") + name + ".csv").find(',') != std::string::npos, name);
    }
    CHECK(here.run("report out -o page.html").out.starts_with("page.html: 3 runs, "));
}

TEST_CASE("report shows files of records, specimens and printed results, and names what it cannot read") {
    const Workplace here;
    REQUIRE(here.run("record make ricker --frequency 2 --pga 0.3 -o made.at2").exit_code == 0);
    here.write("scale.json", here.run("scale --length 1/107 --friction 0.63/0.59 --json").out);
    here.write("columns.txt", "0.1\n0.2\n-0.1\n0.3\n");
    const Outcome outcome = here.run("report made.at2 scale.json columns.txt -o page.html --json");
    REQUIRE(outcome.exit_code == 0);
    const nlohmann::json json = outcome.json();
    CHECK(json["runs"] == 0);
    CHECK(json["records"] == 1);
    CHECK(json["documents"] == 1);
    REQUIRE(json["remarks"].size() == 1);
    CHECK(json["remarks"][0].get<std::string>().find("columns.txt") != std::string::npos);
    CHECK(here.read("page.html").find("scale.json: 6 groups are distorted") != std::string::npos);
    // what a text file does not say is given by options as for every command that reads records
    CHECK(here.run("report columns.txt --dt 0.01 --unit g -o text.html").out.starts_with("text.html: 1 record, "));
    CHECK(here.run("report columns.txt -o none.html").exit_code == 3);
    CHECK_FALSE(here.has("none.html"));
}

TEST_CASE("report refuses what holds no results and leaves no page") {
    const Workplace here;
    for (const char* arguments : {"report nowhere -o page.html", "report . -o page.html"}) {
        const Outcome outcome = here.run(arguments);
        CHECK(outcome.exit_code == 3);
        CHECK(outcome.has_one_error_line());
        CHECK_FALSE(here.has("page.html"));
    }
    CHECK(here.run("report").exit_code == 2);
    CHECK(here.run("report . --format pdf").exit_code == 2);
    here.write("scene.json", kTwoColumns);
    REQUIRE(here.run("run scene.json -o out").exit_code == 0);
    // not over what it shows, by whatever name
    const std::string summary = here.read("out/summary.json");
    CHECK(here.run("report out -o out/summary.json").exit_code == 2);
    CHECK(here.read("out/summary.json") == summary);
    here.write("notes.html", summary);
    CHECK(here.run("report notes.html -o notes.html").exit_code == 3);
    CHECK(here.read("notes.html") == summary);
    const Outcome full = here.run("report out -o page.html", kFullDisk);
    CHECK(full.exit_code == 3);
    CHECK(full.has_one_error_line());
    CHECK_FALSE(here.has("page.html"));
}
