#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <pugixml.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "tests/cli/program.hpp"
#include "tests/support/shared_records.hpp"

using namespace musim::cli;

namespace {

/// A record of two components, 5 s at 100 Hz, in m/s²; the first one's largest value is -4 at 1.23 s.
std::string make_two_channels() {
    std::string text = "# musim ground motion 1\n# quantity: acceleration\n# unit: m/s^2\n# start_s: 0\n# dt_s: 0.01\ntime_s,360,90\n";
    for (int i = 0; i <= 500; ++i) {
        const double t = 0.01 * i;
        text += fmt::format("{},{},{}\n", t, i == 123 ? -4.0 : std::sin(9.0 * t), 0.5 * std::sin(5.0 * t));
    }
    return text;
}

/// The values of every component and quantity in a file of --csv, prototypes and models apart.
std::map<std::string, std::vector<double>> read_curves(const std::string& text) {
    std::map<std::string, std::vector<double>> curves;
    std::istringstream lines(text);
    std::string line;
    std::getline(lines, line);
    CHECK(line == "file,component,scale,quantity,over,x,value");
    while (std::getline(lines, line)) {
        std::vector<std::string> cells;
        std::istringstream row(line);
        for (std::string cell; std::getline(row, cell, ',');) cells.push_back(cell);
        REQUIRE(cells.size() == 7);
        const std::string key = cells[2] + " " + cells[1] + " " + cells[3];
        curves[key + " x"].push_back(std::stod(cells[5]));
        curves[key].push_back(std::stod(cells[6]));
    }
    return curves;
}

/// The curves of an SVG document, in their order; also checks that it is XML.
std::vector<std::string> read_paths(const std::string& svg) {
    pugi::xml_document document;
    REQUIRE(document.load_string(svg.c_str()));
    std::vector<std::string> paths;
    for (const pugi::xpath_node& path : document.select_nodes("//path")) paths.emplace_back(path.node().attribute("d").value());
    return paths;
}

}  // namespace

TEST_CASE("record plot draws every component with its peaks, and writes all samples beside it") {
    const Workplace here;
    here.write("a.csv", make_two_channels());
    const Outcome outcome = here.run("record plot a.csv -o a.svg --csv drawn.csv --json");
    REQUIRE_MESSAGE(outcome.exit_code == 0, outcome.err);
    CHECK(outcome.json()["components"].size() == 2);
    CHECK(outcome.json()["components"][0]["pga_time_s"] == doctest::Approx(1.23).epsilon(1e-12));
    const std::string svg = here.read("a.svg");
    // six panels, two components
    CHECK(read_paths(svg).size() == 12);
    // 4 / 9.80665
    CHECK(svg.find(">0.4079 at 1.23 s<") != std::string::npos);
    const auto curves = read_curves(here.read("drawn.csv"));
    CHECK(curves.at("prototype 360 acceleration_g").size() == 501);
    CHECK(curves.at("prototype 90 displacement_cm").size() == 501);
    CHECK(curves.at("prototype 90 arias_percent").back() == 100.0);
    // 501 samples: 250 frequencies above zero; 200 periods
    CHECK(curves.at("prototype 360 fourier_g_s").size() == 250);
    CHECK(curves.at("prototype 360 psa_g").size() == 200);

    // a part of the histories, the whole record's spectra
    REQUIRE(here.run("record plot a.csv -o a.svg --csv drawn.csv --component 090 --window 1 2").exit_code == 0);
    const auto part = read_curves(here.read("drawn.csv"));
    CHECK(part.count("prototype 360 acceleration_g") == 0);
    CHECK(part.at("prototype 90 velocity_cm_s").size() == 101);
    CHECK(part.at("prototype 90 psa_g") == curves.at("prototype 90 psa_g"));
}

TEST_CASE("a model's curves fall on its prototype's") {
    const Workplace here;
    here.write("a.csv", make_two_channels());
    // 1:16 in the same material: all factors are powers of two
    REQUIRE(here.run("record plot a.csv --component 360 --highpass 0.5 --length 1/16 -o a.svg").exit_code == 0);
    const std::vector<std::string> paths = read_paths(here.read("a.svg"));
    REQUIRE(paths.size() == 12);
    for (std::size_t i = 0; i < paths.size(); i += 2) CHECK(paths[i] == paths[i + 1]);
    CHECK(here.read("a.svg").find("λₜ = 0.25, λₐ = 1, λᵥ = 0.25, λₗ = 0.0625") != std::string::npos);

    // other factors: rounding of the sums, far below what the largest value shows
    REQUIRE(here.run("record plot a.csv --component 360 --length 1/107 --friction 0.63/0.59 -o a.svg --csv drawn.csv").exit_code == 0);
    const auto curves = read_curves(here.read("drawn.csv"));
    for (const char* quantity : {"acceleration_g", "velocity_cm_s", "displacement_cm", "arias_percent", "fourier_g_s", "psa_g"}) {
        for (const std::string& key : {std::string("360 ") + quantity, std::string("360 ") + quantity + " x"}) {
            const auto &prototype = curves.at("prototype " + key), &model = curves.at("model " + key);
            REQUIRE(prototype.size() == model.size());
            double largest = 0.0, difference = 0.0;
            for (std::size_t i = 0; i < model.size(); ++i) {
                largest = std::max(largest, std::abs(prototype[i]));
                difference = std::max(difference, std::abs(model[i] - prototype[i]));
            }
            CHECK_MESSAGE(largest > 0.0, key);
            CHECK_MESSAGE(difference < 1e-11 * largest, key);
        }
    }
}

TEST_CASE("record plot draws what a velocity record has") {
    const Workplace here;
    here.write("v.txt", "0.0 1.0\n0.1 2.0\n0.2 1.0\n0.3 0.5\n");
    REQUIRE(here.run("record plot v.txt --quantity velocity --unit m/s -o v.svg").exit_code == 0);
    CHECK(read_paths(here.read("v.svg")).size() == 2);
    // on a page as wide as with the spectra that it has not
    here.write("a.csv", make_two_channels());
    REQUIRE(here.run("record plot a.csv -o a.svg").exit_code == 0);
    const auto width = [&](const char* file) {
        pugi::xml_document document;
        REQUIRE(document.load_string(here.read(file).c_str()));
        return document.first_child().attribute("width").as_int();
    };
    CHECK(width("v.svg") == 864);
    CHECK(width("a.svg") == 864);
}

TEST_CASE("record plot says which record was integrated how") {
    const Workplace here;
    here.write("a.csv", make_two_channels());
    std::string uncorrected = make_two_channels();
    uncorrected.insert(uncorrected.find("time_s"), "# integration_corner_hz: 0.5\n");
    here.write("b.csv", uncorrected);
    here.write("c.csv", make_two_channels());
    REQUIRE(here.run("record plot a.csv b.csv c.csv -o a.svg").exit_code == 0);
    CHECK(here.read("a.svg").find(">Integrated: no filter (a, c), high-pass 0.5 Hz (b).<") != std::string::npos);
    REQUIRE(here.run("record plot a.csv c.csv -o a.svg").exit_code == 0);
    CHECK(here.read("a.svg").find(">Integrated: no filter.<") != std::string::npos);
    REQUIRE(here.run("record plot a.csv b.csv --length 1/4 -o a.svg").exit_code == 0);
    const std::string svg = here.read("a.svg");
    CHECK(svg.find("no filter (prototype of a), no filter (model of a), high-pass 0.5 Hz (prototype of") != std::string::npos);
    REQUIRE(here.run("record plot a.csv --length 1/4 -o a.svg").exit_code == 0);
    CHECK(here.read("a.svg").find(">Integrated: no filter (prototype), no filter (model).<") != std::string::npos);
}

TEST_CASE("more curves than look different are refused") {
    const Workplace here;
    here.write("a.csv", make_two_channels());
    const std::string three = " a.csv a.csv a.csv", nine = three + three + three;
    // 18 components
    CHECK(here.run("record plot" + nine + " -o a.svg").exit_code == 0);
    const Outcome outcome = here.run("record plot a.csv" + nine + " -o b.svg");
    CHECK(outcome.exit_code == 3);
    CHECK(outcome.err ==
          "musim: error: record plot: 20 components are too many for one figure (at most 18 look different); draw fewer files, or one "
          "--component\n");
    CHECK_FALSE(here.has("b.svg"));
    // 5 pairs
    CHECK(here.run("record plot --component 360 a.csv a.csv" + three + " --length 1/4 -o a.svg").exit_code == 0);
    CHECK(here.run("record plot --component 360" + three + three + " --length 1/4 -o b.svg").exit_code == 3);
}

TEST_CASE("what record plot cannot draw is one error line and no file") {
    const Workplace here;
    here.write("a.csv", make_two_channels());
    struct Case {
        const char* arguments;
        int exit_code;
    };
    for (const Case& wrong : {Case{"-o a.gif", 2}, Case{"-o a", 2}, Case{"-o a.svg --component Up", 3}, Case{"-o a.svg --window 1 6", 3},
                              Case{"-o a.svg --window 2 1", 2}, Case{"-o a.svg --damping -1", 2}, Case{"-o a.svg --length 0", 2},
                              Case{"-o a.svg --highpass 70", 3}}) {
        CAPTURE(wrong.arguments);
        const Outcome outcome = here.run(std::string("record plot a.csv ") + wrong.arguments);
        CHECK(outcome.exit_code == wrong.exit_code);
        CHECK_MESSAGE(outcome.has_one_error_line(), outcome.err);
        CHECK_FALSE(here.has("a.svg"));
    }
    CHECK(here.run("record plot a.csv").exit_code == 2);
    CHECK(here.run("record plot a.csv -o a.svg --law mu").exit_code == 2);
    CHECK(here.run("record plot --help").out.find("Examples:") != std::string::npos);
}

TEST_CASE("a long record makes a small picture") {
    if (!musim::tests::have_shared_records()) return;
    const Workplace here;
    const std::string record = "'" + (musim::tests::shared_records() / "csmip" / "CICLC.v1").string() + "'";
    REQUIRE(here.run("record plot " + record + " -o a.svg").exit_code == 0);
    const std::string svg = here.read("a.svg");
    CHECK(svg.size() < 500000);
    // docs/theory/records.md: 0.5108 g and 43.6 cm/s
    CHECK(svg.find(">0.5108 at ") != std::string::npos);
    CHECK(svg.find(">43.64 at ") != std::string::npos);
}
