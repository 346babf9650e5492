#include <doctest/doctest.h>

#include <algorithm>
#include <iterator>
#include <sstream>
#include <string>
#include <vector>

#include "tests/cli/program.hpp"

using namespace musim::cli;

namespace {

/// A wall of three courses of unequal blocks that is shaken for 20 samples.
std::string make_ensemble_scene(const std::string& output = R"("spine_rate": "500 Hz")",
                                const std::string& time = R"("duration": "0.04 s")") {
    return R"({"schema": "musim-scene/1", "name": "small wall", "material": "concrete",
 "structure": {"kind": "wall", "layers": 3, "blocks_per_layer": 2, "block": ["54.4 mm", "112.8 mm", "170 mm"],
               "height_deviation": "0.3 mm", "seed": 5},
 "base_motion": {"signal": "half_sine", "direction": "x", "amplitude": "0.4 g", "duration": "0.03 s"},
 "time": {)" +
           time + R"(}, "output": {)" + output + "}}";
}

/// A wall whose lengths are multiplied by `length` and times by `time` = sqrt(length): similar by mu-scaling.
std::string make_similar_scene(double length, double time) {
    const double stiffness = 0x1p28 * length * length;
    const nlohmann::json scene{
        {"schema", "musim-scene/1"},
        {"name", "similar wall"},
        {"material",
         {{"density", 2320}, {"normal_stiffness", stiffness}, {"shear_stiffness", stiffness}, {"friction", 0.6}, {"restitution", 0.3}}},
        {"structure",
         {{"kind", "wall"},
          {"layers", 3},
          {"blocks_per_layer", 2},
          {"block", {0.5 * length, length, 1.5 * length}},
          {"pitch", 0.51 * length},
          {"height_deviation", 0.002 * length}}},
        {"base_motion", {{"signal", "half_sine"}, {"direction", "x"}, {"amplitude", 4.0}, {"duration", 0.125 * time}}},
        {"time", {{"duration", 0.25 * time}}},
        {"output", {{"spine_rate", 128 / time}}}};
    return scene.dump();
}

/// All numbers of a table without its first line.
std::vector<double> read_numbers(const std::string& csv) {
    std::string text = csv.substr(csv.find('\n'));
    std::replace(text.begin(), text.end(), ',', ' ');
    std::istringstream in(text);
    return {std::istream_iterator<double>(in), {}};
}

std::string name_of(const nlohmann::json& summary, std::size_t i) { return summary["members"][i]["name"]; }

}  // namespace

TEST_CASE("an ensemble has a summary and members that musim response reads, and the same command again runs nothing") {
    const Workplace here;
    here.write("wall.json", make_ensemble_scene());
    const Outcome first = here.run("ensemble wall.json -o out --members 3 --threads 2 --json");
    REQUIRE_MESSAGE(first.exit_code == 0, first.err);
    const nlohmann::json summary = first.json();
    CHECK(summary["counts"]["completed"] == 3);
    CHECK(summary["axis"] == "x");
    CHECK(summary["members"][2]["seed"] == 7);
    // unlike heights move unlike, if little
    CHECK(summary["spine"].back()["peak_velocity_m_s"]["sd"][0] > 0.0);
    CHECK(summary["spine"].back()["peak_velocity_m_s"]["count"] == 3);
    for (const char* file : {"out/ensemble.json", "out/ensemble.h5", "out/ensemble.csv", "out/ensemble.svg"}) CHECK(here.has(file));
    auto stored = nlohmann::json::parse(here.read("out/ensemble.json"));
    stored.erase("checksum");
    CHECK(stored == summary);
    CHECK(here.run("response out/members/" + name_of(summary, 1)).exit_code == 0);

    // nothing runs again: a member's files are those of before, marked here
    const std::string mark = "out/members/" + name_of(summary, 0) + "/spine.csv";
    here.write(mark, "mark");
    const Outcome again = here.run("ensemble wall.json -o out --members 3");
    CHECK(again.exit_code == 0);
    CHECK_MESSAGE(again.out.find("3 there before") != std::string::npos, again.out);
    CHECK(here.read(mark) == "mark");

    // one at a time, in another order, on one thread: the same bytes
    for (const char* index : {"3", "1", "2"})
        REQUIRE(here.run(std::string("ensemble wall.json -o jobs --members 3 --threads 1 --only ") + index).exit_code == 0);
    CHECK_FALSE(here.has("jobs/ensemble.json"));
    const auto list = here.run("ensemble wall.json -o jobs --members 4 --list --json").json()["members"];
    CHECK(list[2]["state"] == "finished");
    CHECK(list[3]["state"] == "waiting");
    REQUIRE(here.run("ensemble wall.json -o jobs --members 3").exit_code == 0);
    for (const std::string file : {"/ensemble.json", "/ensemble.h5", "/ensemble.csv", "/ensemble.svg"})
        CHECK_MESSAGE(here.read("jobs" + file) == here.read("out" + file), file);
}

TEST_CASE("members use the specimens of a folder, and what is missing there is prepared once") {
    const Workplace here;
    here.write("wall.json", make_ensemble_scene());
    REQUIRE(here.run("specimen wall.json -o specimens").exit_code == 0);
    here.shell("ls specimens > before; cp -a specimens kept");
    const Outcome first = here.run("ensemble wall.json -o out --members 2 --specimens specimens --json");
    REQUIRE_MESSAGE(first.exit_code == 0, first.err);
    here.shell("ls specimens > after; diff before after > added; for f in kept/*; do cmp $f specimens/${f#kept/} || touch differs; done");
    CHECK_FALSE(here.has("differs"));
    CHECK(here.read("added").find("> specimen-") != std::string::npos);

    // what musim run makes of the same file, in every bit
    std::string file = here.read("before");
    file.erase(file.find('\n'));
    nlohmann::json scene = nlohmann::json::parse(make_ensemble_scene());
    scene["preparation"] = {{"specimen", "specimens/" + file}};
    here.write("one.json", scene.dump());
    REQUIRE(here.run("run one.json -o one").exit_code == 0);
    const auto summary = nlohmann::json::parse(here.read("one/summary.json"));
    CHECK(first.json()["members"][0]["state_hash"] == summary["state_hash"]);

    // another job than one that lays its own; the same wherever the folder is
    here.shell("mv specimens elsewhere");
    const auto own = here.run("ensemble wall.json -o out --members 2 --list --json").json()["members"];
    const auto with = here.run("ensemble wall.json -o out --members 2 --specimens elsewhere --list --json").json()["members"];
    for (std::size_t i = 0; i < 2; ++i) {
        CHECK(own[i]["state"] == "waiting");
        CHECK(with[i]["state"] == "finished");
        CHECK(with[i]["name"] == name_of(first.json(), i));
    }
    const Outcome missing = here.run("ensemble wall.json -o out --members 3 --specimens elsewhere --list");
    CHECK(missing.exit_code == 3);
    CHECK_MESSAGE(missing.has_one_error_line(), missing.err);
}

TEST_CASE("an ensemble that is killed goes on from its checkpoints to the same bytes") {
    const Workplace here;
    // 50 samples with a checkpoint each: the kill comes long before the first member's end
    here.write("wall.json", make_ensemble_scene(R"("spine_rate": "500 Hz")", R"("duration": "0.1 s")"));
    REQUIRE(here.run("ensemble wall.json -o whole --members 2 --threads 1").exit_code == 0);
    here.kill_halfway("ensemble wall.json -o out --members 2 --threads 1 --checkpoint-interval 0", "ls out/members/*/checkpoint");
    REQUIRE_FALSE(here.has("out/ensemble.json"));
    const Outcome outcome = here.run("ensemble wall.json -o out --members 2 --threads 1");
    CHECK(outcome.exit_code == 0);
    CHECK_MESSAGE(outcome.out.find("1 resumed") != std::string::npos, outcome.out);
    for (const std::string file : {"/ensemble.json", "/ensemble.h5", "/ensemble.csv"})
        CHECK_MESSAGE(here.read("out" + file) == here.read("whole" + file), file);
    // how a member came to rest is known although that was before the kill
    const auto summary = nlohmann::json::parse(here.read("out/ensemble.json"));
    for (std::size_t i = 0; i < 2; ++i) {
        const std::string file = "/members/" + name_of(summary, i) + "/summary.json";
        auto killed = nlohmann::json::parse(here.read("out" + file)), whole = nlohmann::json::parse(here.read("whole" + file));
        for (auto* member : {&killed, &whole}) {
            member->erase("wall_s");
            member->erase("checksum");  // of the wall time, too
        }
        CHECK(killed == whole);
        CHECK(killed["rest"]["at_rest"] == true);
    }
    // nothing else is left
    CHECK(here.count("out") == here.count("whole"));
}

TEST_CASE("a similar ensemble at 1:16 has the same bands to the last bit, and overlaps wholly") {
    const Workplace here;
    here.write("prototype.json", make_similar_scene(1.0, 1.0));
    here.write("model.json", make_similar_scene(1.0 / 16.0, 1.0 / 4.0));
    for (const std::string name : {"prototype", "model"})
        REQUIRE(here.run("ensemble " + name + ".json -o " + name + " --members 2").exit_code == 0);
    const auto prototype = read_numbers(here.read("prototype/ensemble.csv")), model = read_numbers(here.read("model/ensemble.csv"));
    // 33 samples of time, base, count, and mean and deviation of two levels; times and velocities are a quarter, the count is the same
    REQUIRE(prototype.size() == 33 * 7);
    REQUIRE(model.size() == prototype.size());
    for (std::size_t i = 0; i < model.size(); ++i) CHECK((i % 7 == 2 ? 1.0 : 4.0) * model[i] == prototype[i]);
    CHECK(*std::max_element(prototype.begin(), prototype.end()) > 0.0);

    const Outcome compared = here.run("ensemble --compare prototype model --json");
    REQUIRE_MESSAGE(compared.exit_code == 0, compared.err);
    CHECK(compared.json()["compared"][0]["within_sd"] == 1.0);
    CHECK(compared.json()["compared"][0]["within_error"] == 1.0);
    CHECK(compared.json()["compared"][0]["points"] == 66);

    const Outcome none = here.run("ensemble --compare prototype nowhere");
    CHECK(none.exit_code == 3);
    CHECK(none.has_one_error_line());
    CHECK(here.run("ensemble --compare prototype").exit_code == 2);
    CHECK(here.run("ensemble model.json --compare prototype model").exit_code == 2);
}

TEST_CASE("diverged members are kept and reported with the reason, and end in exit code 4") {
    const Workplace here;
    // the base throws the blocks farther in a step than they are thick
    std::string wall = make_ensemble_scene();
    wall.replace(wall.find("\"direction\": \"x\""), 16, "\"direction\": \"z\"");
    wall.replace(wall.find("0.4 g"), 5, "1e7 g");
    here.write("wall.json", wall);
    const Outcome outcome = here.run("ensemble wall.json -o out --members 2");
    CHECK(outcome.exit_code == 4);
    CHECK_MESSAGE(outcome.err.find("diverged at") != std::string::npos, outcome.err);
    CHECK(std::count(outcome.err.begin(), outcome.err.end(), '\n') == 2);
    const auto summary = nlohmann::json::parse(here.read("out/ensemble.json"));
    CHECK(summary["counts"]["diverged"] == 2);
    CHECK(here.has("out/members/" + name_of(summary, 0) + "/result.h5"));
    CHECK_FALSE(here.has("out/ensemble.h5"));
}

TEST_CASE("a member that cannot be run does not stop the others") {
    const Workplace here;
    here.write("wall.json", make_ensemble_scene());
    const auto list = here.run("ensemble wall.json -o out --members 2 --list --json").json();
    // a file is where the first member's folder should be
    here.shell("mkdir -p out/members && touch out/members/" + name_of(list, 0));
    const Outcome outcome = here.run("ensemble wall.json -o out --members 2 --json");
    CHECK(outcome.exit_code == 3);
    CHECK(outcome.has_one_error_line());
    CHECK(outcome.json()["counts"]["failed"] == 1);
    CHECK(outcome.json()["counts"]["completed"] == 1);
    // once the place is free, that one alone is run
    here.shell("rm out/members/" + name_of(list, 0));
    const Outcome again = here.run("ensemble wall.json -o out --members 2");
    CHECK(again.exit_code == 0);
    CHECK_MESSAGE(again.out.find("1 there before") != std::string::npos, again.out);
}

TEST_CASE("what makes no ensemble is refused in one line, before anything runs") {
    const Workplace here;
    here.write("wall.json", make_ensemble_scene());
    for (const std::string wrong :
         {"ensemble", "ensemble wall.json", "ensemble wall.json -o out --members 0", "ensemble wall.json -o out --members 2 --only 3",
          "ensemble wall.json -o out --only 1 --list", "ensemble --compare out out --specimens specimens"}) {
        const Outcome outcome = here.run(wrong);
        CHECK_MESSAGE(outcome.exit_code == 2, wrong);
        CHECK_MESSAGE(outcome.has_one_error_line(), outcome.err);
    }
    here.write("every_step.json", make_ensemble_scene(R"("spine_rate": "0 Hz")"));
    here.write("broken.json", "{");
    for (const std::string wrong : {"every_step.json", "broken.json", "none.json"}) {
        const Outcome outcome = here.run("ensemble " + wrong + " -o out");
        CHECK_MESSAGE(outcome.exit_code == 3, wrong);
        CHECK_MESSAGE(outcome.has_one_error_line(), outcome.err);
    }
    CHECK_FALSE(here.has("out"));
}
