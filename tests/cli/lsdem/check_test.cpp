#include <doctest/doctest.h>

#include <string>

#include "tests/cli/program.hpp"

using namespace musim::cli;

namespace {

const std::string kExamples = MUSIM_SOURCE_DIR "/examples/";

}  // namespace

TEST_CASE("a scene is checked and drawn without a run") {
    const Workplace here;
    const Outcome text = here.run("check " + kExamples + "wall.json --no-timing -o wall.svg");
    CHECK(text.exit_code == 0);
    for (const char* const part : {"33 blocks in 6 levels", "friction 0.59", "half sine signal along x", "PGV 25 cm/s", "[b/H]",
                                   "of the critical step", "result.h5 about ", "Preview in wall.svg"}) {
        CHECK_MESSAGE(text.out.find(part) != std::string::npos, part, " in ", text.out);
    }
    CHECK(text.err.find("musim: warning: ") == 0);
    CHECK(text.err.find("output.frame_rate") != std::string::npos);
    CHECK(here.read("wall.svg").find("</svg>") != std::string::npos);
    CHECK(here.count() == 1);
}

TEST_CASE("a checked scene in JSON has the numbers of its run") {
    const Workplace here;
    CHECK(here.run("new blocks -o scene.json").exit_code == 0);
    const Outcome checked = here.run("check scene.json --json --threads 1");
    REQUIRE_MESSAGE(checked.exit_code == 0, checked.err);
    const auto json = checked.json();
    CHECK(json["blocks"] == 5);
    CHECK(json["levels"] == 3);
    CHECK(json["kinds"][0]["count"] == 5);
    CHECK(json["motions"][0]["axes"][0]["axis"] == "x");
    CHECK(json["estimates"]["sliding"]["value"] == 0.63);
    CHECK(json["warnings"].empty());
    CHECK(json["run_time"]["measured_steps"].get<int>() > 0);
    CHECK(json["run_time"]["run_s"].get<double>() > 0.0);
    CHECK_FALSE(here.run("check scene.json --json --no-timing").json().contains("run_time"));
    const auto sequence = here.run("check " + kExamples + "aftershocks.json --json --no-timing").json();
    CHECK(sequence["motions"].size() == 6);
    CHECK(sequence["motions"][2]["name"] == "aftershock");
}

TEST_CASE("what a run would warn of is a warning of the check") {
    const Workplace here;
    const auto check = [&](const std::string& more) {
        here.write("scene.json", R"({"schema": "musim-scene/1", "name": "column", "material": "wood",
            "structure": {"kind": "column", "layers": 2, "block": ["12.71 mm", "26.36 mm", "39.72 mm"]},
            "base_motion": {"signal": "sine", "amplitude": "0.1 g", "frequency": "10 Hz", "cycles": 2}, )" +
                                     more + "}");
        const Outcome outcome = here.run("check scene.json --no-timing");
        CHECK(outcome.exit_code == 0);
        return outcome.err;
    };
    const std::string rates = R"("output": {"spine_rate": "1 kHz", "frame_rate": "100 Hz"}, )";
    CHECK(check(rates + R"("time": {"duration": "0.3 s"})").empty());
    struct Case {
        std::string settings;
        const char* warning;
    };
    for (const Case& c : {Case{rates + R"("time": {"duration": "0.1 s"})", "\"duration\" cuts it"},
                          Case{rates + R"("time": {"duration": "0.3 s", "step": "10 us"})", "above the critical"},
                          Case{rates + R"("time": {"duration": "0.3 s"}, "preparation": "none")", "weight begins to act"},
                          Case{rates + R"("time": {"duration": 0.3})", "a number without a unit"},
                          Case{rates + R"("time": {"duration": "0.3 s"}, "contact": {"nodes": "both"})", "changes nothing"},
                          Case{R"("time": {"duration": "0.3 s"}, "output": {"frame_rate": "100 Hz"})", "every step is kept"},
                          Case{R"("time": {"duration": "0.3 s"}, "output": {"spine_rate": "1 kHz"})", "no film"}}) {
        CAPTURE(c.warning);
        const std::string err = check(c.settings);
        CHECK_MESSAGE(err.find(c.warning) != std::string::npos, err);
    }
}

TEST_CASE("what cannot be checked is refused in one line") {
    const Workplace here;
    here.write("wrong.json", R"({"schema": "musim-scene/1", "materiel": "wood"})");
    here.write("held.json", R"({"schema": "musim-scene/1", "material": "wood", "time": {"duration": "1 s"}, "structure": {"kind": "blocks",
        "blocks": [{"size": ["1 m", "1 m", "1 m"], "position": ["0 m", "0 m", "0.5 m"], "fixed": true}]}})");
    here.write("other.json", R"({"schema": "musim-table/1"})");
    struct Case {
        const char* arguments;
        int exit_code;
        const char* message;
    };
    for (const Case& wrong :
         {Case{"check", 2, "scene"}, Case{"check lost.json", 3, "lost.json: cannot be read"}, Case{"check wrong.json", 3, "did you mean"},
          Case{"check other.json", 3, "other.json: /"}, Case{"check held.json", 3, "held.json: /structure: all blocks are held"},
          Case{"check wrong.json -o wrong.json", 3, "it is also the input"}, Case{"check wrong.json -o a.txt", 2, "a.txt"}}) {
        CAPTURE(wrong.arguments);
        const Outcome outcome = here.run(wrong.arguments);
        CHECK(outcome.exit_code == wrong.exit_code);
        CHECK_MESSAGE(outcome.has_one_error_line(), outcome.err);
        CHECK_MESSAGE(outcome.err.find(wrong.message) != std::string::npos, outcome.err);
        CHECK(here.count() == 3);
    }
}
