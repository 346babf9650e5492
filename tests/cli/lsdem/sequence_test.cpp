#include <doctest/doctest.h>

#include <string>

#include "tests/cli/program.hpp"

using namespace musim::cli;

namespace {

/// A column of two blocks; a jolt that it stands twice and one that throws it down.
std::string make_sequence_scene() {
    const std::string jolt = R"({"base_motion": {"signal": "sine", "direction": "x", "frequency": "6 Hz", "cycles": 1, "amplitude": )";
    return R"({"schema": "musim-scene/1", "name": "two blocks", "material": "wood",
 "structure": {"kind": "column", "layers": 2, "block": ["12.710 mm", "26.355 mm", "39.780 mm"]},
 "motions": [)" +
           jolt + R"("0.2 g"}, "name": "jolt", "repeat": 2}, )" + jolt + R"("1.5 g"}, "name": "blow", "duration": "0.5 s"}, )" + jolt +
           R"("0.2 g"}}], "output": {"spine_rate": "200 Hz"}})";
}

void check_same_stages(const Workplace& here) {
    for (const std::string name : {"sequence.json", "sequence.csv", "sequence_levels.csv", "stage-01-jolt/result.h5",
                                   "stage-02-jolt/result.h5", "stage-02-jolt/spine.csv", "stage-03-blow/result.h5"})
        CHECK_MESSAGE(here.read("out/" + name) == here.read("whole/" + name), name);
    CHECK(here.count("out") == here.count("whole"));
}

}  // namespace

TEST_CASE("a structure is shaken until it collapses, and every stage is a run that other commands read") {
    const Workplace here;
    here.write("scene.json", make_sequence_scene());
    const Outcome outcome = here.run("sequence scene.json -o whole --json");
    CHECK(outcome.exit_code == 0);
    CHECK(outcome.err.empty());
    const auto json = outcome.json();
    auto stored = nlohmann::json::parse(here.read("whole/sequence.json"));
    stored.erase("checksum");
    CHECK(json == stored);
    CHECK(json["status"] == "collapsed");
    CHECK(json["stages_run"] == 3);
    CHECK(json["motions"] == 4);
    CHECK(json["collapse"]["stage"] == 3);
    CHECK(json["stages"][0]["status"] == "completed");
    CHECK(json["stages"][0]["warnings"].empty());
    CHECK(nlohmann::json::parse(here.read("whole/stage-02-jolt/summary.json"))["stage"]["number"] == 2);
    CHECK(here.count("whole") == 7);
    const Outcome response = here.run("response whole/stage-03-blow --json");
    CHECK(response.exit_code == 0);
    CHECK(response.json()["status"] == "collapsed");
    CHECK(response.json()["collapse_time_s"] == json["collapse"]["time_s"]);
    // it shows the failure as the sequence does: since the first start
    CHECK(response.json()["failure"] == json["failure"]);
    CHECK(response.json()["damage_index"] == json["stages"][2]["since_stage_start"]["damage_index"]);

    // what is there is not run again
    here.shell("cp -r whole out");
    const Outcome text = here.run("sequence scene.json -o out");
    CHECK(text.exit_code == 0);
    CHECK_MESSAGE(text.out.find("3 of 4 motions") != std::string::npos, text.out);
    CHECK_MESSAGE(text.out.find("after the start of stage-03-blow") != std::string::npos, text.out);
    check_same_stages(here);
}

TEST_CASE("a sequence that is killed and resumed has the results of one that was not to the byte" * doctest::test_suite("slow")) {
    const Workplace here;
    here.write("scene.json", make_sequence_scene());
    REQUIRE(here.run("sequence scene.json -o whole").exit_code == 0);
    // once the first stage is there, at the next checkpoint
    here.write("kill.sh", MUSIM_PROGRAM
               " sequence scene.json -o out --checkpoint-interval 0 >first.out 2>first.err & pid=$!\n"
               "until [ -e out/stage-01-jolt/summary.json ] || ! kill -0 $pid 2>/dev/null; do sleep 0.002; done\n"
               "touch before; sleep 0.02\n"
               "until [ out/checkpoint -nt before ] || ! kill -0 $pid 2>/dev/null; do sleep 0.002; done\n"
               "kill -9 $pid; wait $pid\n");
    here.shell("sh kill.sh >/dev/null 2>&1");
    REQUIRE(here.has("out/checkpoint"));
    REQUIRE_FALSE(here.has("out/sequence.json"));
    // the two kinds of checkpoint are not taken for each other
    const Outcome other = here.run("run --resume out");
    CHECK(other.exit_code == 3);
    CHECK(other.has_one_error_line());
    CHECK(other.err.find("musim sequence --resume out") != std::string::npos);
    const Outcome outcome = here.run("sequence --resume out");
    CHECK(outcome.exit_code == 0);
    check_same_stages(here);
    const Outcome again = here.run("sequence --resume out");
    CHECK(again.exit_code == 3);
    CHECK(again.err.find("has finished") != std::string::npos);
}

TEST_CASE("what is doubtful about a stage is a warning that names it") {
    const Workplace here;
    auto scene = nlohmann::json::parse(make_sequence_scene());
    // just above the critical step, with which it would not come to rest before
    scene["preparation"] = "none";
    scene["time"]["step"] = "13 us";
    auto jolt = scene["motions"][0];
    jolt.erase("repeat");
    jolt["base_motion"]["amplitude"] = "1e-9 g";
    jolt["duration"] = "0.01 s";
    scene["motions"] = nlohmann::json::array({jolt});
    here.write("scene.json", scene.dump());
    const Outcome outcome = here.run("sequence scene.json -o out");
    CHECK_MESSAGE(outcome.err.find("musim: warning: scene.json: stage-01-jolt: the time step") != std::string::npos, outcome.err);
}

TEST_CASE("a stage that diverges ends the sequence with its own exit code and is stored") {
    const Workplace here;
    std::string scene = make_sequence_scene();
    // the base throws the blocks farther in a step than they are thick
    scene.replace(scene.find("\"direction\": \"x\""), 16, "\"direction\": \"z\"");
    scene.replace(scene.find("0.2 g"), 5, "1e7 g");
    here.write("scene.json", scene);
    const Outcome outcome = here.run("sequence scene.json -o out");
    CHECK(outcome.exit_code == 4);
    CHECK(outcome.has_one_error_line());
    CHECK_MESSAGE(outcome.err.find("stage-01-jolt: diverged at") != std::string::npos, outcome.err);
    CHECK(nlohmann::json::parse(here.read("out/sequence.json"))["status"] == "diverged");
    CHECK(here.has("out/stage-01-jolt/result.h5"));
    CHECK_FALSE(here.has("out/checkpoint"));
}

TEST_CASE("commands that take one motion name the one that takes a list") {
    const Workplace here;
    here.write("scene.json", make_sequence_scene());
    for (const std::string command : {"run scene.json", "run scene.json --duration 1"}) {
        const Outcome outcome = here.run(command);
        CHECK(outcome.exit_code == 3);
        CHECK_MESSAGE(outcome.has_one_error_line(), outcome.err);
        CHECK_MESSAGE(outcome.err.find("use `musim sequence`") != std::string::npos, outcome.err);
    }
    const Outcome duration = here.run("pair scene.json --duration 1");
    CHECK(duration.exit_code == 3);
    CHECK_MESSAGE(duration.has_one_error_line(), duration.err);
    std::string uneven = make_sequence_scene();
    uneven.replace(uneven.find("\"layers\": 2"), 11, R"("layers": 2, "height_deviation": "0.1 mm")");
    here.write("uneven.json", uneven);
    const Outcome ensemble = here.run("ensemble uneven.json -o out");
    CHECK(ensemble.exit_code == 3);
    CHECK(ensemble.has_one_error_line());
    CHECK_MESSAGE(ensemble.err.find("an ensemble takes one motion") != std::string::npos, ensemble.err);
    // a specimen needs none
    CHECK(here.run("specimen uneven.json -o specimens").exit_code == 0);
}

TEST_CASE("usage of the sequence command is checked") {
    const Workplace here;
    here.write("scene.json", make_sequence_scene());
    for (const std::string wrong : {"sequence", "sequence scene.json", "sequence -o out", "sequence scene.json -o out --resume out",
                                    "sequence scene.json -o out --checkpoint-interval -1"}) {
        const Outcome outcome = here.run(wrong);
        CHECK_MESSAGE(outcome.exit_code == 2, wrong);
        CHECK_MESSAGE(outcome.has_one_error_line(), outcome.err);
    }
    const Outcome help = here.run("sequence --help");
    CHECK(help.exit_code == 0);
    CHECK(help.out.find("Examples:") != std::string::npos);
    const Outcome nothing = here.run("sequence --resume out");
    CHECK(nothing.exit_code == 3);
    CHECK(nothing.has_one_error_line());
    CHECK(here.count() == 1);
    // a full disk leaves no half of a stage
    const Outcome full = here.run("sequence scene.json -o out", kFullDisk);
    CHECK(full.exit_code == 3);
    CHECK_FALSE(here.has("out/stage-01-jolt/result.h5"));
}
