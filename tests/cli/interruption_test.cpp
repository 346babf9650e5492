#include <doctest/doctest.h>

#include <string>
#include <vector>

#include "tests/cli/program.hpp"

using musim::cli::Outcome;
using musim::cli::Workplace;

namespace {

/// Two blocks that are shaken for so long that nobody waits for the end; one sample in all.
std::string make_long_scene(const std::string& motion, const std::string& time = R"("time": {"duration": "3000 s"},)") {
    return R"({"schema": "musim-scene/1", "name": "two blocks", "material": "wood",
 "structure": {"kind": "column", "layers": 2, "block": ["12.71 mm", "26.355 mm", "39.78 mm"], "height_deviation": "0.01 mm"},)" +
           motion + time + R"("output": {"spine_rate": "1 mHz"}})";
}

const std::string kSine = R"({"signal": "sine", "direction": "x", "amplitude": "0.1 g", "frequency": "1 Hz", "cycles": 3000})";
const std::string kMotion = "\"base_motion\": " + kSine + ",";

struct Case {
    const char* command;
    const char* halfway;  ///< condition of the shell: it has kept something
    const char* go_on;    ///< what it says
};

}  // namespace

TEST_CASE("a command that is interrupted keeps what it has and says how to go on") {
    for (const Case& c :
         {Case{"run scene.json -o out --checkpoint-interval 0.01", "[ -e out/checkpoint ]", "continue with `musim run --resume out`"},
          Case{"sequence motions.json -o out --checkpoint-interval 0.01", "[ -e out/checkpoint ]",
               "continue with `musim sequence --resume out`"},
          Case{"pair scene.json --length 1/16 -o out --checkpoint-interval 0.01", "ls out/unfinished-*/prototype.checkpoint",
               "the same command again goes on from what is in out"},
          Case{"ensemble scene.json -o out --members 3 --checkpoint-interval 0.01", "ls out/members/*/checkpoint",
               "the same command again goes on from what is in out"},
          Case{"run scene.json", "sleep 0.3", "nothing was written; with -o DIR the command could be continued"},
          Case{"calibrate friction --material wood --resolution 1e-12", "sleep 0.3", "nothing was written; start the command again"},
          Case{"bench twins scene.json", "sleep 0.3", "nothing was written; with -o DIR the command could be continued"}}) {
        CAPTURE(c.command);
        const Workplace here;
        here.write("scene.json", make_long_scene(kMotion));
        here.write("motions.json", make_long_scene("\"motions\": [{\"base_motion\": " + kSine + "}],", ""));
        const Outcome terminated = here.interrupt(c.command, "TERM", c.halfway);
        CHECK(terminated.exit_code == 143);
        CHECK_MESSAGE(terminated.err == "musim: interrupted by SIGTERM: " + std::string(c.go_on) + "\n", terminated.err);
        // nothing half-written: a folder has checkpoints, no results
        here.shell("find . -name '*.tmp' -o -name '.unfinished' -o -name progress.json -o -name '*.h5' >found.txt");
        CHECK(here.read("found.txt").empty());
    }
}

TEST_CASE("an interrupted run goes on from its last step and can be interrupted again") {
    const Workplace here;
    here.write("scene.json", make_long_scene(kMotion));
    const std::string halfway = "[ -e out/checkpoint ]";
    CHECK(here.interrupt("run scene.json -o out --checkpoint-interval 0.01", "INT", halfway).exit_code == 130);
    const std::string first = here.read("out/checkpoint");
    // no checkpoint of its own before: what it leaves is written when it is interrupted, after some steps
    const Outcome again =
        here.interrupt("run --resume out --checkpoint-interval 1000", "INT", "grep '\"running\"' out/progress.json && sleep 0.2");
    CHECK(again.exit_code == 130);
    CHECK(again.err == "musim: interrupted by SIGINT: continue with `musim run --resume out`\n");
    CHECK(here.read("out/checkpoint") != first);
}

TEST_CASE("an interrupted preparation goes on with the same command") {
    const Workplace here;
    here.write("scene.json", R"({"schema": "musim-scene/1", "name": "wall", "material": "wood", "time": {"duration": "1 s"},
 "structure": {"kind": "wall", "layers": 40, "blocks_per_layer": 20, "block": ["12.71 mm", "26.355 mm", "39.78 mm"],
               "height_deviation": "0.1 mm"}})");
    const std::string command = "specimen scene.json -o out --checkpoint-interval 0.01";
    const Outcome outcome = here.interrupt(command, "TERM", "ls out/*.checkpoint");
    CHECK(outcome.exit_code == 143);
    CHECK(outcome.err == "musim: interrupted by SIGTERM: the same command again goes on from what is in out\n");
    CHECK(here.count("out") == 1);
}

TEST_CASE("scales and spectra that are interrupted say that nothing was written") {
    const Workplace here;
    REQUIRE(here.run("rescale synthetic --length 1 --law froude -o record.csv").exit_code == 0);
    const std::string drawn = " --monte-carlo 1000000";
    for (const std::string& command :
         std::vector<std::string>{"scale --length 1/25+/-1% --friction 1+/-5%" + drawn,
                                  "rescale record.csv --length 1/25+/-1% --friction 1+/-5% -o out.csv" + drawn,
                                  "design '" MUSIM_SOURCE_DIR "/examples/design/uncertain.json'" + drawn,
                                  std::string("record spectrum record.csv --periods 0.001 10 100000 -o out.csv --threads 1")}) {
        CAPTURE(command);
        const Outcome outcome = here.interrupt(command, "TERM", "sleep 0.3");
        CHECK(outcome.exit_code == 143);
        CHECK_MESSAGE(outcome.err == "musim: interrupted by SIGTERM: nothing was written; start the command again\n", outcome.err);
        CHECK(outcome.out.empty());
        CHECK_FALSE(here.has("out.csv"));
        // nothing but the record
        CHECK(here.count() == 1);
    }
    CHECK(here.interrupt("scale --length 1/25+/-1% --friction 1+/-5%" + drawn, "INT", "sleep 0.3").exit_code == 130);
}
