#include <doctest/doctest.h>

#include <algorithm>
#include <string>

#include "tests/cli/lsdem/two_blocks.hpp"
#include "tests/cli/program.hpp"
#include "tests/support/relative.hpp"

using namespace musim::cli;
using musim::lsdem::tests::relative;

TEST_CASE("run prints one JSON object with the keys of the contract and writes all result files") {
    const Workplace here;
    here.write("scene.json", SceneText().text());
    const Outcome outcome = here.run("run scene.json -o out/run --json");
    CHECK(outcome.exit_code == 0);
    const auto object = outcome.json();
    for (const char* key : {"status", "blocks", "steps", "dt_s", "substeps", "wall_s", "contacts", "contact_nodes", "state_hash",
                            "energy_closure", "max_overlap_over_height", "base_reaction_over_weight"}) {
        CHECK_MESSAGE(object.contains(key), key);
    }
    CHECK(object["status"] == "completed");
    CHECK(object["blocks"] == 2);
    // block on block on the ground, by overlap
    CHECK(object["contacts"] == 2);
    CHECK(object["contact_nodes"] == 0);
    for (const char* name : {"result.h5", "result.xdmf", "spine.csv", "summary.json"})
        CHECK_MESSAGE(here.has(std::string("out/run/") + name), name);
    CHECK(nlohmann::json::parse(here.read("out/run/summary.json"))["state_hash"] == object["state_hash"]);
}

TEST_CASE("run says which block left its place, when, and in how many substeps steps were taken from then on") {
    const Workplace here;
    here.write("stands.json", SceneText().text());
    here.write("drops.json", SceneText{.second_block_z = "\"2 m\""}.text());
    const auto stands = here.run("run stands.json --json").json();
    CHECK_FALSE(stands.contains("left_place"));
    CHECK(stands["substeps"] == stands["steps"]);
    const Outcome outcome = here.run("run drops.json");
    CHECK(outcome.exit_code == 0);
    CHECK_MESSAGE(outcome.out.find("block 1 left its place at 0 s; from then on each step was taken in 4 substeps") != std::string::npos,
                  outcome.out);
    const auto drops = here.run("run drops.json --json").json();
    CHECK(drops["left_place"] == nlohmann::json{{"block", 1}, {"time_s", 0.0}, {"substeps_per_step", 4}});
    CHECK(drops["substeps"].get<std::uint64_t>() == 4 * drops["steps"].get<std::uint64_t>());
}

TEST_CASE("run --half-step estimates the error of the step as a pair does, and without it a run says that nothing did") {
    const Workplace here;
    here.write("scene.json", SceneText().text());
    const Outcome plain = here.run("run scene.json");
    CHECK(plain.out.find("The error of the time step was not estimated (--half-step does).") != std::string::npos);
    const auto without = here.run("run scene.json --json").json(), with = here.run("run scene.json --half-step -o out --json").json();
    CHECK(without["half_step"].is_null());
    CHECK(with["state_hash"] == without["state_hash"]);
    const auto& error = with["half_step"];
    CHECK(error["status"] == "completed");
    CHECK(error["until_s"].get<double>() == relative(0.5, 1e-9));
    CHECK(here.has("out/half_step.json"));
    const auto of_pair = here.run("pair scene.json --length 1/16 --json").json()["half_step"];
    CHECK(error["parting_time_s"] == of_pair["parting_time_s"]);
    for (const char* key : {"rms_relative_velocity_difference", "largest_relative_velocity_difference"}) {
        CAPTURE(key);
        CHECK(error[key].get<double>() > 0.0);
        CHECK(error[key].get<double>() == relative(of_pair[key].get<double>(), 1e-6));
    }
    const Outcome text = here.run("run scene.json --half-step");
    CHECK(text.out.find("At half the time step velocities agree to 0.1 % ") != std::string::npos);
    CHECK(here.run("sequence scene.json --half-step -o seq").exit_code == 2);
}

TEST_CASE("run --until-collapse ends with the fall, which comes when it comes in the whole run") {
    const Workplace here;
    // a block that leans by 40 degrees on an edge
    here.write("leaning.json", R"({"schema": "musim-scene/1", "name": "leaning", "material": "wood", "output": {"spine_rate": "100 Hz"},
        "structure": {"kind": "blocks", "blocks": [{"size": ["10 mm", "20 mm", "40 mm"], "position": ["0 m", "0 m", "19 mm"],
                                                    "quaternion": [0.939693, 0, 0.342020, 0]}]}, "time": {"duration": "1 s"}})");
    const auto whole = here.run("run leaning.json --json").json(), cut = here.run("run leaning.json --until-collapse --json").json();
    REQUIRE(whole["status"] == "collapsed");
    CHECK(cut["status"] == "collapsed");
    CHECK(cut["collapse_time_s"] == whole["collapse_time_s"]);
    CHECK(whole["duration_s"].get<double>() == relative(1.0, 1e-9));
    CHECK(cut["duration_s"].get<double>() == relative(cut["collapse_time_s"].get<double>(), 1e-9));
    CHECK(here.run("run leaning.json --until-collapse -o out").exit_code == 2);
    // what stands is run to its end
    here.write("scene.json", SceneText().text());
    CHECK(here.run("run scene.json --until-collapse --json").json()["state_hash"] ==
          here.run("run scene.json --json").json()["state_hash"]);
}

TEST_CASE("a run holds its base against the record everywhere, and warns where peaks are others") {
    const Workplace here;
    // a triangle of 0.5 g at one sample: the base has means of two samples, half of it
    here.write("motion.txt", "0 0\n0.1 0\n0.2 4.903325\n0.3 0\n0.4 -4.903325\n0.5 0\n0.6 0\n");
    std::string text = SceneText().text();
    const std::size_t begin = text.find(R"({"signal")"), end = text.find('}', begin);
    here.write("scene.json",
               text.replace(begin, end - begin + 1, R"({"record": "motion.txt", "components": {"x": "1"}, "at_rest": false})"));
    const std::string both = "PGA 0.25 g (record 0.5 g, -50.0 %), PGV ";
    const std::string warning = "the base makes PGA 0.25 g where its record has 0.5 g (-50.0 %) along x (its velocity is linear";
    const Outcome check = here.run("check scene.json");
    CHECK_MESSAGE(check.out.find(both) != std::string::npos, check.out);
    CHECK_MESSAGE((check.out + check.err).find(warning) != std::string::npos, check.err);
    const Outcome run = here.run("run scene.json -o out --duration 0.6");
    CHECK_MESSAGE(run.out.find(both) != std::string::npos, run.out);
    const auto summary = nlohmann::json::parse(here.read("out/summary.json"))["outcome"];
    CHECK(run.err.find(warning) != std::string::npos);
    CHECK(summary["base_changes"][0]["source"]["pga_g"].get<double>() == doctest::Approx(0.5));
    CHECK(summary["base_changes"][0]["largest_difference"]["pgv_m_s"].get<double>() < 1e-12);
    const Outcome response = here.run("response out");
    CHECK_MESSAGE(response.out.find(both) != std::string::npos, response.out);
    CHECK(here.run("response out --json").json()["base_changes"] == summary["base_changes"]);
    CHECK(here.run("response out --json").json()["pga_g"] == summary["pga_g"]);
    REQUIRE(here.run("report out -o page.html").exit_code == 0);
    CHECK(here.read("page.html").find(both) != std::string::npos);
}

TEST_CASE("settings that change nothing get one line each, and change nothing") {
    const Workplace here;
    here.write("scene.json", SceneText().text());
    const Outcome plain = here.run("run scene.json --json");
    CHECK(plain.err.empty());
    std::string text = SceneText().text();
    text.insert(1, R"("shape": {"kind": "box", "nodes_per_face": 25}, "contact": {"nodes": "both"}, )");
    here.write("idle.json", text);
    const auto count_warnings = [](const Outcome& outcome) {
        std::size_t count = 0;
        for (std::size_t at = 0; (at = outcome.err.find("musim: warning: idle.json: /", at)) != std::string::npos; ++at) ++count;
        // and nothing else
        CHECK(static_cast<std::size_t>(std::count(outcome.err.begin(), outcome.err.end(), '\n')) == count);
        return count;
    };
    const Outcome idle = here.run("run idle.json -o out --json");
    CHECK(idle.exit_code == 0);
    CHECK(count_warnings(idle) == 2);
    for (const char* place : {"/shape/nodes_per_face: ", "/contact/nodes: "}) {
        CHECK_MESSAGE(idle.err.find(place) != std::string::npos, idle.err);
    }
    CHECK(idle.json()["state_hash"] == plain.json()["state_hash"]);
    CHECK(count_warnings(here.run("pair idle.json --length 1/16")) == 2);
    // by nodes these settings count, and nothing is said
    text = SceneText().text();
    text.insert(1, R"("shape": {"kind": "box", "nodes_per_face": 25}, "contact": {"faces": "nodes"}, "preparation": {}, )");
    here.write("nodes.json", text);
    const Outcome nodes = here.run("run nodes.json --json");
    CHECK(nodes.err.empty());
    CHECK(nodes.json()["contact_nodes"].get<int>() > 0);
    CHECK(nodes.json()["contacts"] == 2);
}

TEST_CASE("the state hash is the same for any number of threads") {
    const Workplace here;
    here.write("scene.json", SceneText().text());
    const auto hash = [&](const std::string& threads) {
        return here.run("run scene.json --json --threads " + threads).json()["state_hash"];
    };
    const auto one = hash("1");
    CHECK(hash("2") == one);
    CHECK(hash("4") == one);
}

TEST_CASE("numbers without a unit are noted once for each file by the first key that is read, and zeros and units are not") {
    const Workplace here;
    here.write("plain.json", SceneText{.density = "2320", .second_block_z = "1.5"}.text());
    here.write("clear.json", SceneText{.second_block_z = "\"1.5 m\""}.text());
    const std::string note =
        "musim: note: plain.json: /structure/blocks/1/position/2: a number without a unit is taken as SI, here and elsewhere in the "
        "file; write text with a unit\n";
    const Outcome plain = here.run("run plain.json --duration 0.01 --json"), clear = here.run("run clear.json --duration 0.01 --json");
    CHECK(plain.exit_code == 0);
    CHECK(plain.err.ends_with(note));
    CHECK(clear.err.find("note:") == std::string::npos);
    CHECK(plain.json()["state_hash"] == clear.json()["state_hash"]);
}

TEST_CASE("what is wrong with a scene begins with its file and place in every command") {
    const Workplace here;
    here.write("b.json", SceneText().text());
    const std::string overlapping = SceneText{.second_block_z = "\"1.2 m\""}.text();
    here.write("deep.json", overlapping);
    struct Case {
        std::string arguments, message;
    };
    for (const Case& wrong : {Case{"run deep.json", "deep.json: "}, Case{"pair deep.json --length 1/4", "deep.json: "},
                              Case{"sequence b.json -o out", "b.json: has no list of motions"},
                              Case{"ensemble b.json -o out", "b.json: all members would be the same"},
                              Case{"specimen b.json -o out", "b.json: specimens differ by the heights of a column"},
                              Case{"run b.json --duration 1e18", "b.json: 1e+18 s in steps of"}}) {
        CAPTURE(wrong.arguments);
        const Outcome outcome = here.run(wrong.arguments);
        CHECK(outcome.exit_code == 3);
        CHECK_MESSAGE(outcome.has_one_error_line(), outcome.err);
        CHECK_MESSAGE(outcome.err.starts_with("musim: error: " + wrong.message), outcome.err);
        CHECK_FALSE(here.has("out"));
    }
}

TEST_CASE("a duration given as a fraction replaces the scene's") {
    const Workplace here;
    here.write("scene.json", SceneText().text());
    CHECK(here.run("run scene.json --json --duration 1/4").json()["duration_s"].get<double>() == doctest::Approx(0.25).epsilon(1e-9));
    CHECK(here.run("run scene.json --duration -1").exit_code == 2);
}

TEST_CASE("what cannot be counted is refused in one short line") {
    const Workplace here;
    here.write("scene.json", SceneText().text());
    SceneText tiny;
    tiny.step = "1e-300";
    here.write("tiny.json", tiny.text());
    for (const char* arguments : {"run scene.json --duration 1e18", "run tiny.json", "pair scene.json --duration 1e18"}) {
        const Outcome outcome = here.run(arguments);
        CHECK_MESSAGE(outcome.exit_code == 3, arguments);
        CHECK(outcome.has_one_error_line());
        CHECK(outcome.err.find("steps") != std::string::npos);
    }
    for (const char* arguments : {"run scene.json --threads -1", "bench twins scene.json --perturb 0"}) {
        const Outcome outcome = here.run(arguments);
        CHECK_MESSAGE(outcome.exit_code == 2, arguments);
        CHECK(outcome.err.size() < 120);
    }
}

// in a centrifuge at 1:16 every factor is a power of two

TEST_CASE("a folder of results given as a scene is refused with the way to resume") {
    const Workplace here;
    here.shell("mkdir out");
    const Outcome outcome = here.run("run out");
    CHECK(outcome.exit_code == 3);
    CHECK_MESSAGE(outcome.has_one_error_line(), outcome.err);
    CHECK(outcome.err.find("out: is a folder, not a scene") != std::string::npos);
    CHECK(outcome.err.find("`musim run --resume out`") != std::string::npos);
}

TEST_CASE("a broken scene is one error line that names file and key, exit code 3, and no output") {
    struct Case {
        std::string text;
        const char* word;
    };
    const SceneText good;
    const auto with = [&](auto change) {
        SceneText scene = good;
        change(scene);
        return scene.text();
    };
    const Case cases[] = {{with([](SceneText& s) { s.density = "-1"; }), "density"},
                          {with([](SceneText& s) { s.stiffness = "\"2 GN/furlong\""; }), "furlong"},
                          {with([](SceneText& s) { s.stiffness = "\"2 kg\""; }), "normal_stiffness"},
                          {with([](SceneText& s) { s.second_block_z = "\"1.4 m\""; }), "overlap"},
                          {with([](SceneText& s) { s.step = "\"0 s\""; }), "step"},
                          {with([](SceneText& s) { s.step = "\"auto\", \"durration\": 1"; }), "duration"},
                          {"{ not json", "scene.json"},
                          {"", "scene.json"}};
    for (const Case& broken : cases) {
        const Workplace here;
        here.write("scene.json", broken.text);
        for (const std::string command : {"run", "pair"}) {
            const Outcome outcome = here.run(command + " scene.json -o out --json");
            CHECK_MESSAGE(outcome.exit_code == 3, broken.word);
            CHECK_MESSAGE(outcome.has_one_error_line(), outcome.err);
            // the file, or the name of the scene in it
            CHECK_MESSAGE(outcome.err.find("error: scene") != std::string::npos, outcome.err);
            CHECK_MESSAGE(outcome.err.find(broken.word) != std::string::npos, broken.word, " not in ", outcome.err);
            CHECK(outcome.out.empty());
        }
        CHECK(here.count() == 1);
    }
    CHECK(Workplace().run("run missing.json").exit_code == 3);
}

TEST_CASE("a diverged run is exit code 4 with block and time, and its results are kept") {
    const Workplace here;
    SceneText scene;
    scene.restitution = "1";
    here.write("scene.json", scene.text());
    const double critical = here.run("run scene.json --json").json()["critical_dt_s"];
    scene.step = "\"" + std::to_string(1e6 * 1.45 * critical) + " us\"";
    here.write("scene.json", scene.text());
    const Outcome outcome = here.run("run scene.json --duration 5 -o out --json");
    CHECK(outcome.exit_code == 4);
    CHECK(outcome.has_one_error_line());
    for (const char* word : {"block ", " s, ", "time step 0.00264 s", "critical", "take at most"})
        CHECK_MESSAGE(outcome.err.find(word) != std::string::npos, word, " not in ", outcome.err);
    CHECK(outcome.json()["status"] == "diverged");
    CHECK(here.has("out/result.h5"));

    // the step it names works
    const std::string text = outcome.err.substr(outcome.err.find("take at most ") + 13);
    scene.step = "\"" + text.substr(0, text.find(" s,")) + " s\"";
    here.write("scene.json", scene.text());
    const Outcome again = here.run("run scene.json --duration 1 --json");
    CHECK(again.exit_code == 0);
    CHECK(again.err.empty());
    CHECK(again.json()["warnings"].empty());
}

TEST_CASE("a step far above the critical one is refused before anything is computed") {
    const Workplace here;
    SceneText scene;
    here.write("scene.json", scene.text());
    const double critical = here.run("run scene.json --json").json()["critical_dt_s"];
    const auto write = [&](double over_critical) {
        scene.step = "\"" + std::to_string(1e6 * over_critical * critical) + " us\"";
        here.write("scene.json", scene.text());
    };
    write(1.51);
    for (const char* command : {"run scene.json -o out", "pair scene.json --length 1/16 -o out", "bench twins scene.json"}) {
        const Outcome outcome = here.run(command);
        CAPTURE(outcome.err);
        CHECK(outcome.exit_code == 3);
        CHECK(outcome.has_one_error_line());
        CHECK(outcome.err.find("scene.json: the \"step\" ") != std::string::npos);
        CHECK(outcome.err.find("1.51 times the critical one") != std::string::npos);
        CHECK_FALSE(here.has("out"));
    }
    write(1.49);
    CHECK(here.run("run scene.json").exit_code == 0);
}

TEST_CASE("a run that reached its end with too large a step is a warning that names the step to take") {
    const Workplace here;
    SceneText scene;
    here.write("scene.json", scene.text());
    const double critical = here.run("run scene.json --json").json()["critical_dt_s"];
    // stable by luck: the critical step is a bound on the safe side for blocks that can turn
    scene.step = "\"" + std::to_string(1e6 * 1.01 * critical) + " us\"";
    here.write("scene.json", scene.text());
    const Outcome outcome = here.run("run scene.json --json");
    CHECK(outcome.exit_code == 0);
    CHECK_MESSAGE(outcome.err.starts_with("musim: warning: scene.json: the time step "), outcome.err);
    CHECK(outcome.err.find("take at most") != std::string::npos);
    CHECK(outcome.json()["warnings"].size() == 1);
}

TEST_CASE("blocks that pass deep into each other are a warning with the depth") {
    const Workplace here;
    SceneText scene;
    // 9.3 t on 1 MN/m sink 0.09 m in, of a height of 1 m
    scene.stiffness = "\"1 MN/m\"";
    here.write("scene.json", scene.text());
    const Outcome outcome = here.run("run scene.json");
    CHECK(outcome.exit_code == 0);
    CHECK_MESSAGE(outcome.err.find("musim: warning: scene.json: blocks passed into each other by 0.") != std::string::npos, outcome.err);
}

TEST_CASE("a coefficient of restitution of zero is refused and one close to it runs") {
    const Workplace here;
    SceneText scene;
    scene.restitution = "0";
    here.write("scene.json", scene.text());
    const Outcome refused = here.run("run scene.json");
    CHECK(refused.exit_code == 3);
    CHECK(refused.has_one_error_line());
    CHECK(refused.err.find("/material/restitution") != std::string::npos);
    scene.restitution = "1e-3";
    here.write("scene.json", scene.text());
    CHECK(here.run("run scene.json --duration 1/20").exit_code == 0);
}

TEST_CASE("results that cannot be written leave nothing behind") {
    const Workplace here;
    here.write("scene.json", SceneText().text());
    for (const std::string command : {"run", "pair"}) {
        const Outcome full = here.run(command + " scene.json -o out/deep", kFullDisk);
        CHECK(full.exit_code == 3);
        CHECK_MESSAGE(full.has_one_error_line(), full.err);
        const Outcome below_file = here.run(command + " scene.json -o scene.json/out");
        CHECK(below_file.exit_code == 3);
        CHECK_MESSAGE(below_file.has_one_error_line(), below_file.err);
    }
    CHECK(here.count() == 1);
}

TEST_CASE("a motion that is cut by the duration is said in one line and one that is run to its end is not") {
    const Workplace here;
    here.write("scene.json", SceneText().text());
    // one cycle of 2 Hz
    for (const char* whole : {"run scene.json", "run scene.json --duration 0.6", "pair scene.json --length 1/16"}) {
        CHECK(here.run(whole).err.empty());
    }
    for (const char* cut : {"run scene.json --duration 0.3", "pair scene.json --length 1/16 --duration 0.3"}) {
        const Outcome outcome = here.run(cut);
        CHECK(outcome.exit_code == 0);
        CHECK_MESSAGE(
            outcome.err.starts_with("musim: warning: scene.json: /base_motion: the motion lasts 0.5 s, and \"duration\" cuts it at 0.3 s"),
            outcome.err);
        CHECK(std::count(outcome.err.begin(), outcome.err.end(), '\n') == 1);
    }
}
