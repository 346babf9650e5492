#include <doctest/doctest.h>

#include <string>
#include <vector>

#include "tests/cli/program.hpp"

using musim::cli::Outcome;
using musim::cli::Workplace;

namespace {

/// Two or three wood blocks that are shaken for 10 ms, one of uneven height.
std::string make_scene(const std::string& blocks, const std::string& motion) {
    return R"({"schema": "musim-scene/1", "name": "column", "material": "wood", "time": {"duration": "10 ms"},
        "structure": {"kind": "column", "layers": )" +
           blocks + R"(, "block": ["12.710 mm", "26.355 mm", "39.780 mm"], "height_deviation": "0.1 mm"}, )" + motion +
           R"(, "output": {"spine_rate": "1 kHz"}})";
}

const std::string kJolt = R"({"signal": "ricker", "direction": "x", "amplitude": "0.2 g", "frequency": "200 Hz"})";

/// A command that writes a folder `out`, and the same for other results.
struct Overwriter {
    std::string first, other;
};

void check_command(const Workplace& here, const Overwriter& command) {
    here.shell("rm -rf out");
    REQUIRE_MESSAGE(here.run(command.first + " -o out").exit_code == 0, command.first);
    CHECK_MESSAGE(here.run(command.first + " -o out").exit_code == 0, command.first);
    const std::string before = here.read("out/contents.json");
    const Outcome refused = here.run(command.other + " -o out");
    CHECK_MESSAGE(refused.exit_code == 3, command.other);
    // warnings about the scene may come first
    const std::size_t error = refused.err.find("musim: error: ");
    CHECK((error != std::string::npos && refused.err.find('\n', error) + 1 == refused.err.size()));
    CHECK_MESSAGE(refused.err.find("out/contents.json: here are results of ") != std::string::npos, refused.err);
    CHECK_MESSAGE(refused.err.find("--force") != std::string::npos, refused.err);
    CHECK(here.read("out/contents.json") == before);
    CHECK_MESSAGE(here.run(command.other + " -o out --force").exit_code == 0, command.other);
    CHECK_MESSAGE(here.run(command.other + " -o out").exit_code == 0, command.other);
}

}  // namespace

TEST_CASE("commands do not write over results of another scene or other options unless they are forced to") {
    const Workplace here;
    here.write("two.json", make_scene("2", "\"base_motion\": " + kJolt));
    here.write("three.json", make_scene("3", "\"base_motion\": " + kJolt));
    here.write("one_motion.json", make_scene("2", "\"motions\": [{\"base_motion\": " + kJolt + "}]"));
    here.write("two_motions.json", make_scene("2", "\"motions\": [{\"base_motion\": " + kJolt + ", \"repeat\": 2}]"));
    const std::string pair = "pair two.json --twins 0 --no-half-step ";
    for (const Overwriter& command :
         std::vector<Overwriter>{{"run two.json", "run three.json"},
                                 {"run two.json", "run two.json --duration 0.005"},
                                 {"run two.json", pair + "--length 1/4"},
                                 {pair + "--length 1/4", pair + "--length 1/16"},
                                 {"sequence two_motions.json", "sequence one_motion.json"},
                                 {"ensemble two.json --members 2", "ensemble three.json --members 2"},
                                 {"ensemble two.json --members 2 --specimens laid", "ensemble two.json --members 2"},
                                 {"bench twins two.json --models 2", "bench twins two.json --models 1"}}) {
        check_command(here, command);
    }
    // before they compute
    for (const char* other : {"calibrate friction --material wood", "calibrate stiffness --material wood", "bench accuracy --quick",
                              "bench similitude --law mu"}) {
        CHECK_MESSAGE(here.run(std::string(other) + " -o out").exit_code == 3, other);
    }
}

TEST_CASE("a record that has changed makes other results and the path to the scene does not") {
    const Workplace here;
    here.write("record.csv", "0 0 0\n0.01 1 0\n0.02 -1 0\n0.03 0 0\n");
    here.write("scene.json", make_scene("2", R"("base_motion": {"record": "record.csv", "components": {"x": "1"}})"));
    REQUIRE(here.run("run scene.json -o out").exit_code == 0);
    here.shell("mkdir moved && cp scene.json record.csv moved");
    CHECK(here.run("run moved/scene.json -o out").exit_code == 0);
    here.write("record.csv", "0 0 0\n0.01 2 0\n0.02 -2 0\n0.03 0 0\n");
    const Outcome refused = here.run("run scene.json -o out");
    CHECK(refused.exit_code == 3);
    CHECK_MESSAGE(refused.err.find("these differ: base_motion") != std::string::npos, refused.err);
}

TEST_CASE("results of fewer models are a beginning and the same number in another way is the same option") {
    const Workplace here;
    here.write("two.json", make_scene("2", "\"base_motion\": " + kJolt));
    REQUIRE(here.run("bench twins two.json --models 1 --duration 1/100 -o out").exit_code == 0);
    CHECK(here.run("bench twins two.json --models 2 --duration 0.01 -o out").exit_code == 0);
    const Outcome fewer = here.run("bench twins two.json --models 1 --duration 0.01 -o out");
    CHECK(fewer.exit_code == 3);
    CHECK_MESSAGE(fewer.err.find("these differ: --models") != std::string::npos, fewer.err);
    // the default is more than two
    CHECK(here.run("bench twins two.json --duration 0.01 -o out").exit_code == 0);
    const std::string pair = "pair two.json --twins 0 --no-half-step -o paired ";
    REQUIRE(here.run(pair + "--length 1/25 --length 1/4").exit_code == 0);
    CHECK(here.run(pair + "--length 0.04 --length 0.25").exit_code == 0);
    CHECK(here.run(pair + "--length 0.04 --length 0.2").exit_code == 3);
}
