#include <doctest/doctest.h>

#include <algorithm>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "tests/cli/program.hpp"

using namespace musim::cli;

namespace {

/// Rows of a CSV file by the names in its first line.
std::vector<std::map<std::string, std::string>> parse_csv(const std::string& text) {
    const auto split = [](const std::string& line) {
        std::vector<std::string> cells;
        std::istringstream stream(line);
        for (std::string cell; std::getline(stream, cell, ',');) cells.push_back(cell);
        return cells;
    };
    std::istringstream stream(text);
    std::string line;
    std::getline(stream, line);
    const std::vector<std::string> names = split(line);
    std::vector<std::map<std::string, std::string>> rows;
    while (std::getline(stream, line)) {
        const std::vector<std::string> cells = split(line);
        REQUIRE(cells.size() == names.size());
        std::map<std::string, std::string> row;
        for (std::size_t c = 0; c < names.size(); ++c) row[names[c]] = cells[c];
        rows.push_back(row);
    }
    return rows;
}

}  // namespace

TEST_CASE("bench accuracy writes a table whose Pareto marks hold and a plot and prints JSON" * doctest::test_suite("slow")) {
    const Workplace here;
    const Outcome outcome = here.run("bench accuracy --quick -o out --json");
    REQUIRE_MESSAGE(outcome.exit_code == 0, outcome.err);
    CHECK(here.read("out/accuracy.svg").starts_with("<svg"));
    CHECK(here.read("out/accuracy.svg").ends_with("</svg>\n"));

    const auto rows = parse_csv(here.read("out/accuracy.csv"));
    std::map<std::string, int> fronts;
    for (const auto& row : rows) {
        const double error = std::stod(row.at("error")), seconds = std::stod(row.at("seconds"));
        CHECK(std::stoll(row.at("steps")) > 0);
        int beaten = 0;
        for (const auto& other : rows) {
            if (other.at("case") != row.at("case")) continue;
            beaten += std::stod(other.at("error")) < error && std::stod(other.at("seconds")) < seconds ? 1 : 0;
        }
        if (row.at("pareto") == "1") {
            CHECK_MESSAGE(beaten == 0, row.at("case"), " ", row.at("family"), " ", row.at("label"));
            ++fronts[row.at("case")];
        }
    }
    const auto cases = outcome.json()["cases"];
    for (const char* name :
         {"slide", "rock_ground", "rock_own_edge", "rock_other_edge", "lean", "wave", "settle", "bounce", "tower", "tower_peak"})
        CHECK_MESSAGE(fronts[name] > 0, name);
    std::size_t printed = 0;
    for (const auto& panel : cases) printed += panel["rows"].size();
    CHECK(printed == rows.size());
    CHECK(outcome.json()["earthquake"] == "synthetic record");
}

TEST_CASE("bench similitude writes a table and a figure of a law whose cases hold, and prints JSON") {
    const Workplace here;
    const Outcome outcome = here.run("bench similitude --law cauchy -o out --json");
    REQUIRE_MESSAGE(outcome.exit_code == 0, outcome.err);
    CHECK(outcome.json()["all_hold"] == true);
    CHECK(parse_csv(here.read("out/similitude.csv")).size() == outcome.json()["cases"].size());
    CHECK(here.read("out/similitude_cauchy.svg").starts_with("<svg"));
}

TEST_CASE("bench twins measures how models and moved copies part, goes on where it was, and prints JSON") {
    const Workplace here;
    here.write("wall.json", R"({"schema": "musim-scene/1", "name": "wall", "material": "wood",
        "structure": {"kind": "wall", "layers": 2, "blocks_per_layer": 2, "block": ["12.71 mm", "26.355 mm", "39.78 mm"]},
        "base_motion": {"signal": "half_sine", "direction": "y", "amplitude": "1.2 g", "duration": "0.05 s"},
        "time": {"duration": "1 s"}, "output": {"spine_rate": "1 kHz"}})");
    const std::string command = "bench twins wall.json --duration 1/20 --models 2 -o out";
    const Outcome outcome = here.run(command + " --json");
    REQUIRE_MESSAGE(outcome.exit_code == 0, outcome.err);
    const auto scene = outcome.json()["scenes"][0];
    CHECK(scene["samples"] == 51);
    CHECK(scene["twins"].size() == 2);
    CHECK(scene["largest_growth"]["factor"] >= 1.0);
    CHECK(scene["log10_difference"]["count"] == 2);
    CHECK(parse_csv(here.read("out/twins.csv")).size() == 102);
    const std::string spread = here.read("out/spread.csv");
    CHECK(std::count(spread.begin(), spread.end(), '\n') == 52);
    CHECK(here.read("out/summary.json").find("horizon_s") != std::string::npos);

    // the same again is read, and of three models two are there
    CHECK(here.run(command + " --json").json() == outcome.json());
    const Outcome three = here.run("bench twins wall.json --duration 1/20 --models 3 -o out --json --force");
    CHECK(three.json()["scenes"][0]["twins"][1] == scene["twins"][1]);
    const Outcome text = here.run("bench twins wall.json --duration 1/20 --models 1 --perturb 1e-11,1e-9");
    CHECK_MESSAGE(text.out.find("Directions 1: difference over shift differs") != std::string::npos, text.out);
}

TEST_CASE("bench verdict calls no exact model different and finds errors of a millionth" * doctest::test_suite("slow")) {
    const Workplace here;
    const std::string examples = MUSIM_SOURCE_DIR "/examples/";
    const Outcome exact = here.run("bench verdict " + examples + "twins/corners.json " + examples + "twins/rocking.json " + examples +
                                   "twins/shocks.json --sets 1 --models 5 --seed 7 --json");
    REQUIRE_MESSAGE(exact.exit_code == 0, exact.err);
    CHECK(exact.json()["differ"]["count"] == 0);
    CHECK(exact.json()["differ"]["of"] == 15);
    for (const auto& scene : exact.json()["scenes"]) CHECK(scene["sets"][0]["lead_of_images_sd"] < 3.5);

    const std::string wall =
        "bench verdict " + examples + "uneven_wall.json --sets 1 --models 5 --errors all --sizes 1e-6 --images 3 -o out";
    const Outcome wrong = here.run(wall + " --json");
    REQUIRE_MESSAGE(wrong.exit_code == 0, wrong.err);
    CHECK(wrong.json()["differ"]["count"] == 0);
    const auto errors = wrong.json()["scenes"][0]["errors"];
    CHECK(errors.size() == 9);
    for (const auto& error : errors) {
        const std::string name = error["error"];
        CAPTURE(name);
        CHECK(error["in_one_model"]["found"]["count"] == 3);
        CHECK(error["in_models_and_images"]["found"]["count"] == 3);
    }
    // the table, from what the runs have left
    const Outcome table = here.run(wall);
    CHECK(table.out.find("record_step") != std::string::npos);
    CHECK(table.out.find("Called different: 0 of 5") != std::string::npos);
}

TEST_CASE("bench refuses what it cannot do with one line") {
    const Workplace here;
    here.write("file", "");
    for (const char* arguments :
         {"bench", "bench nonsense", "bench accuracy --component 360", "bench accuracy --threads -1", "bench similitude --law newton",
          "bench similitude --threads -1", "bench twins", "bench twins file --models 0", "bench twins file --perturb 1e-12,0",
          "bench twins file --seed -1", "bench verdict file --seed -1", "bench verdict", "bench verdict file --errors luck",
          "bench verdict file --sizes 0"}) {
        const Outcome outcome = here.run(arguments);
        CHECK_MESSAGE(outcome.exit_code == 2, arguments);
        CHECK_MESSAGE(outcome.has_one_error_line(), outcome.err);
    }
    for (const char* arguments : {"bench accuracy --quick --record missing.v1", "bench accuracy --quick -o file/out",
                                  "bench similitude -o file/out", "bench twins missing.json", "bench verdict missing.json"}) {
        const Outcome outcome = here.run(arguments);
        CHECK_MESSAGE(outcome.exit_code == 3, arguments);
        CHECK_MESSAGE(outcome.has_one_error_line(), outcome.err);
    }
    CHECK(here.count() == 1);
}
