#include <doctest/doctest.h>

#include <string>

#include "tests/cli/program.hpp"

using namespace musim::cli;

namespace {

constexpr const char* kScene = R"({"schema": "musim-scene/1", "name": "two columns",
    "material": {"density": 2320, "normal_stiffness": "2 GN/m", "shear_stiffness": "2 GN/m", "friction": 0.3, "restitution": 0.3},
    "shape": {"kind": "box", "nodes_per_face": 25}, "structure": {"kind": "column", "layers": 3, "block": ["2 m", "2 m", "1 m"]},
    "base_motion": {"signal": "sine", "direction": "x", "amplitude": "0.4 g", "frequency": "4 Hz", "cycles": 1},
    "time": {"duration": "0.3 s"}, "output": {"spine_rate": "500 Hz", "frame_rate": "50 Hz"}})";

}  // namespace

TEST_CASE("report makes one page of a pair, and its plots as files with their data") {
    const Workplace here;
    here.write("scene.json", kScene);
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
    for (const char* name : {"spine_velocity", "difference", "energy_prototype", "slip", "residual_displacement"}) {
        CHECK_MESSAGE(here.has(std::string("figures/") + name + ".svg"), name);
        CHECK_MESSAGE(here.read(std::string("figures/") + name + ".csv").find(',') != std::string::npos, name);
    }
    CHECK(here.run("report out -o page.html").out.starts_with("page.html: 3 runs, "));
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
    here.write("scene.json", kScene);
    REQUIRE(here.run("run scene.json -o out").exit_code == 0);
    const Outcome full = here.run("report out -o page.html", kFullDisk);
    CHECK(full.exit_code == 3);
    CHECK(full.has_one_error_line());
    CHECK_FALSE(here.has("page.html"));
}
