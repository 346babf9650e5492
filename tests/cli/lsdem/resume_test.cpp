#include <doctest/doctest.h>

#include <string>

#include "tests/cli/program.hpp"

using namespace musim::cli;

namespace {

/// Two blocks on ground that is shaken by `base_motion`; 100 samples.
std::string make_resumed_scene(const std::string& base_motion) {
    return R"({"schema": "musim-scene/1", "name": "two blocks",
 "material": {"density": 2320, "normal_stiffness": "2 GN/m", "shear_stiffness": "2 GN/m", "friction": 0.3, "restitution": 0.3},
 "structure": {"kind": "blocks", "blocks": [
   {"size": ["2 m", "2 m", "1 m"], "position": ["0 m", "0 m", "0.5 m"]},
   {"size": ["2 m", "2 m", "1 m"], "position": ["0.2 m", "0 m", "1.5 m"]}]},
 "base_motion": )" +
           base_motion + R"(,
 "time": {"duration": "0.5 s", "step": "auto"}, "output": {"spine_rate": "200 Hz", "frame_rate": "40 Hz"}})";
}

const char* const kStrongSine = R"({"signal": "sine", "direction": "x", "amplitude": "0.6 g", "frequency": "2 Hz", "cycles": 2})";

/// Kills `musim ARGUMENTS` once it has written a checkpoint. One checkpoint per sample, so that there is time enough: each waits for the
/// disk.
void kill_halfway(const Workplace& here, const std::string& arguments, const std::string& meanwhile = ":") {
    here.kill_halfway(arguments + " --checkpoint-interval 0", "[ out/checkpoint -nt started ]", meanwhile);
}

void check_same_results(const Workplace& here) {
    for (const std::string name : {"result.h5", "result.xdmf", "spine.csv"})
        CHECK_MESSAGE(here.read("out/" + name) == here.read("whole/" + name), name);
    auto resumed = nlohmann::json::parse(here.read("out/summary.json")), whole = nlohmann::json::parse(here.read("whole/summary.json"));
    for (auto* summary : {&resumed, &whole}) {
        summary->erase("wall_s");
        summary->erase("checksum");  // of the wall time, too
    }
    CHECK(resumed == whole);
}

}  // namespace

TEST_CASE("a run that is killed twice and resumed has the results of one that was not, to the byte") {
    const Workplace here;
    here.write("scene.json", make_resumed_scene(kStrongSine));
    const Outcome whole = here.run("run scene.json -o whole --threads 1 --half-step --json");
    REQUIRE(whole.exit_code == 0);
    CHECK_FALSE(here.has("whole/checkpoint"));

    kill_halfway(here, "run scene.json -o out");
    REQUIRE(here.has("out/checkpoint"));
    REQUIRE_FALSE(here.has("out/summary.json"));
    // the scene file is not needed any more
    here.write("scene.json", "gone");
    kill_halfway(here, "run --resume out");
    REQUIRE(here.has("out/checkpoint"));
    REQUIRE_FALSE(here.has("out/summary.json"));
    const Outcome outcome = here.run("run --resume out --half-step --json");
    CHECK(outcome.exit_code == 0);
    CHECK(outcome.json()["half_step"] == whole.json()["half_step"]);
    CHECK(outcome.json()["state_hash"] == nlohmann::json::parse(here.read("whole/summary.json"))["state_hash"]);
    check_same_results(here);
    // nothing but results is left
    CHECK(here.count("out") == 6);

    const Outcome again = here.run("run --resume out");
    CHECK(again.exit_code == 3);
    CHECK(again.has_one_error_line());
    CHECK(again.err.find("has finished") != std::string::npos);
}

TEST_CASE("a run that is killed while it prepares its specimen goes on from there, and so does a specimen") {
    const Workplace here;
    here.write("wall.json", R"({"schema": "musim-scene/1", "name": "uneven wall", "material": "wood", "structure": {"kind": "wall",
        "layers": 3, "blocks_per_layer": 2, "block": ["12.710 mm", "26.355 mm", "39.780 mm"], "height_deviation": "0.155 mm", "seed": 3},
        "time": {"duration": "5 ms"}, "output": {"spine_rate": "4800 Hz"}})");
    REQUIRE(here.run("run wall.json -o whole").exit_code == 0);
    kill_halfway(here, "run wall.json -o out");
    REQUIRE(here.has("out/checkpoint"));
    here.shell("mv wall.json scene.json");
    CHECK(here.run("run --resume out").exit_code == 0);
    check_same_results(here);

    REQUIRE(here.run("specimen scene.json -o made").exit_code == 0);
    here.shell("rm -rf out");
    here.kill_halfway("specimen scene.json -o out --checkpoint-interval 0", "ls out | grep -q 'h5.checkpoint$'");
    const Outcome outcome = here.run("specimen scene.json -o out --json");
    REQUIRE(outcome.exit_code == 0);
    CHECK(outcome.json()["specimens"][0]["resumed"] == true);
    here.shell("diff -r made out >difference.txt");
    CHECK(here.read("difference.txt").empty());
}

TEST_CASE("nothing else works on the directory of a run, nor starts anew over its checkpoint") {
    const Workplace here;
    here.write("scene.json", make_resumed_scene(kStrongSine));
    kill_halfway(here, "run scene.json -o out",
                 MUSIM_PROGRAM " run --resume out 2>resume.txt; echo $? >>resume.txt\n" MUSIM_PROGRAM
                               " run scene.json -o out 2>anew.txt; echo $? >>anew.txt");
    REQUIRE(here.has("out/checkpoint"));
    for (const char* name : {"resume.txt", "anew.txt"}) {
        CHECK_MESSAGE(here.read(name).find("another musim is working in this directory") != std::string::npos, here.read(name));
        CHECK(here.read(name).ends_with("\n3\n"));
    }
    const Outcome anew = here.run("run scene.json -o out");
    CHECK(anew.exit_code == 3);
    CHECK(anew.has_one_error_line());
    CHECK(anew.err.find("musim run --resume out") != std::string::npos);
    CHECK(here.run("run --resume out").exit_code == 0);
    // and over a finished run one may
    CHECK(here.run("run scene.json -o out").exit_code == 0);
}

TEST_CASE("a run whose record has changed or gone cannot be resumed, until it is back") {
    const Workplace here;
    REQUIRE(here.run("rescale synthetic --length 1 --law froude -o record.csv").exit_code == 0);
    here.write("scene.json", make_resumed_scene(R"({"record": "record.csv", "components": {"x": "1"}})"));
    REQUIRE(here.run("run scene.json -o whole").exit_code == 0);
    kill_halfway(here, "run scene.json -o out");
    REQUIRE(here.has("out/checkpoint"));
    REQUIRE_FALSE(here.has("out/summary.json"));
    here.shell("mv record.csv kept.csv");
    const Outcome gone = here.run("run --resume out");
    CHECK(gone.exit_code == 3);
    CHECK_MESSAGE(gone.err.find("record.csv") != std::string::npos, gone.err);
    REQUIRE(here.run("rescale synthetic --length 1/2 --law froude -o record.csv").exit_code == 0);
    const Outcome changed = here.run("run --resume out");
    CHECK(changed.exit_code == 3);
    CHECK(changed.has_one_error_line());
    CHECK_MESSAGE(changed.err.find("has the scene's record or the program changed") != std::string::npos, changed.err);
    here.shell("mv kept.csv record.csv");
    CHECK(here.run("run --resume out").exit_code == 0);
    check_same_results(here);
}

TEST_CASE("a run of an older format cannot be resumed: one line names file and format") {
    const Workplace here;
    here.write("scene.json", make_resumed_scene(kStrongSine));
    kill_halfway(here, "run scene.json -o out");
    REQUIRE(here.has("out/checkpoint"));
    std::string old = here.read("out/checkpoint");
    old[12] = 11;  // the format, behind a name of eight bytes and the byte order
    here.write("out/checkpoint", old);
    const Outcome outcome = here.run("run --resume out");
    CHECK(outcome.exit_code == 3);
    CHECK(outcome.has_one_error_line());
    for (const char* part : {"out/checkpoint: ", "format 11", "format 17", "start it anew"}) {
        CHECK_MESSAGE(outcome.err.find(part) != std::string::npos, outcome.err);
    }
}

TEST_CASE("there is one clear line when there is nothing to resume from") {
    const Workplace here;
    const auto refused = [&](const std::string& word) {
        const Outcome outcome = here.run("run --resume out");
        CHECK(outcome.exit_code == 3);
        CHECK(outcome.has_one_error_line());
        CHECK_MESSAGE(outcome.err.find(word) != std::string::npos, outcome.err);
    };
    refused("no checkpoint");
    // a directory that is not there is not made
    CHECK(here.count() == 0);
    here.shell("mkdir out");
    refused("no checkpoint");
    here.write("out/checkpoint", "not a checkpoint, but longer than the head of one");
    refused("out/checkpoint: the run cannot be continued");
    here.write("out/checkpoint", "");
    refused("cut off");
}

TEST_CASE("usage of --resume and --checkpoint-interval is checked") {
    const Workplace here;
    here.write("scene.json", make_resumed_scene(kStrongSine));
    for (const std::string wrong : {"run", "run scene.json --resume out", "run --resume out -o out", "run --resume out --duration 1",
                                    "run scene.json --checkpoint-interval -1", "run scene.json --checkpoint-interval often"}) {
        const Outcome outcome = here.run(wrong);
        CHECK_MESSAGE(outcome.exit_code == 2, wrong);
        CHECK_MESSAGE(outcome.has_one_error_line(), outcome.err);
    }
    CHECK(here.run("run scene.json --checkpoint-interval 1/2").exit_code == 0);
}

TEST_CASE("a pair that is killed and begun again has the results of one that was not, and leaves nothing else") {
    const Workplace here;
    here.write("scene.json", make_resumed_scene(kStrongSine));
    const std::string pair = "pair scene.json --length 1/25 --twins 2 --threads 1 -o ";
    REQUIRE(here.run(pair + "whole").exit_code == 0);
    here.kill_halfway(pair + "out --checkpoint-interval 0", "ls out/unfinished-*/1-25.checkpoint", ":");
    REQUIRE_FALSE(here.has("out/pair.json"));
    const Outcome outcome = here.run(pair + "out");
    CHECK(outcome.exit_code == 0);
    CHECK(outcome.err.find("went on") != std::string::npos);
    CHECK(here.read("out/1-25/result.h5") == here.read("whole/1-25/result.h5"));
    auto resumed = nlohmann::json::parse(here.read("out/pair.json")), whole = nlohmann::json::parse(here.read("whole/pair.json"));
    for (auto* pairs : {&resumed, &whole}) {
        pairs->erase("checksum");  // of the wall times, too
        for (auto& run : (*pairs)["runs"]) run.erase("wall_s");
    }
    CHECK(resumed == whole);
    CHECK(here.count("out") == here.count("whole"));
}

TEST_CASE("a checkpoint is not read while another musim may write it") {
    const Workplace here;
    for (const char* checkpoint : {"", "touch out/checkpoint; "}) {
        here.shell("rm -rf out; mkdir out; " + std::string(checkpoint) + "touch out/kept");
        for (const std::string command : {"run", "sequence"}) {
            // as another one holds it
            const Outcome outcome = here.run(command + " --resume out", "flock out");
            CHECK(outcome.exit_code == 3);
            CHECK_MESSAGE(outcome.err.find("another musim is working in this directory") != std::string::npos, outcome.err);
        }
        CHECK(here.has("out/kept"));
    }
}
