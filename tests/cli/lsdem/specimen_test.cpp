#include <doctest/doctest.h>

#include <cmath>
#include <string>

#include "tests/cli/program.hpp"

using namespace musim::cli;

namespace {

std::string make_uneven_scene(const std::string& structure) {
    return R"({"schema": "musim-scene/1", "name": "wall", "material": "wood",
 "structure": )" +
           structure + R"(, "time": {"duration": "2 ms"}, "output": {"spine_rate": "2000 Hz"}})";
}

const std::string kWall = R"({"kind": "wall", "layers": 3, "blocks_per_layer": 1, "block": ["12.710 mm", "26.355 mm", "39.780 mm"],
               "height_deviation": "0.155 mm", "seed": 5})";

}  // namespace

TEST_CASE("specimens are made for several seeds, found again, and used by a scene that names one") {
    const Workplace place;
    place.write("wall.json", make_uneven_scene(kWall));
    const Outcome made = place.run("specimen wall.json -o made --seeds 2 --json");
    REQUIRE(made.exit_code == 0);
    const auto specimens = made.json()["specimens"];
    REQUIRE(specimens.size() == 2);
    CHECK(specimens[0]["seed"] == 5);
    CHECK(specimens[1]["seed"] == 6);
    for (const auto& specimen : specimens) {
        CHECK(specimen["at_rest"] == true);
        CHECK(specimen["reused"] == false);
        CHECK(specimen["layers"].size() == 3);
        CHECK(std::abs(specimen["base_reaction_over_weight"].get<double>() - 1.0) < 1e-4);
    }
    const Outcome again = place.run("specimen wall.json -o made --seeds 2 --json");
    CHECK(again.json()["specimens"][1]["reused"] == true);
    CHECK(again.json()["specimens"][1]["file"] == specimens[1]["file"]);

    std::string scene = make_uneven_scene(kWall);
    scene.insert(scene.size() - 1, R"(, "preparation": {"specimen": ")" + specimens[0]["file"].get<std::string>() + "\"}");
    place.write("with.json", scene);
    const Outcome run = place.run("run with.json --json");
    REQUIRE(run.exit_code == 0);
    CHECK(run.json()["rest"]["at_rest"] == true);
    // another seed has other blocks
    scene.replace(scene.find("\"seed\": 5"), 9, "\"seed\": 9");
    place.write("other.json", scene);
    const Outcome refused = place.run("run other.json");
    CHECK(refused.exit_code == 3);
    CHECK(refused.has_one_error_line());
    CHECK(refused.err.find("prepare a specimen of this scene") != std::string::npos);
}

TEST_CASE("specimens laid in two ways are compared by what was printed of them") {
    const Workplace place;
    place.write("wall.json", make_uneven_scene(kWall));
    const Outcome layers = place.run("specimen wall.json -o layers --seeds 3 --placing layers --json");
    const Outcome quick = place.run("specimen wall.json -o quick --seeds 2 --json");
    REQUIRE(layers.exit_code == 0);
    REQUIRE(quick.exit_code == 0);
    place.write("layers.json", layers.out);
    place.write("quick.json", quick.out);
    const Outcome compared = place.run("specimen --compare layers.json quick.json --json");
    REQUIRE(compared.exit_code == 0);
    const auto given = compared.json();
    CHECK(given["first"]["specimens"] == 3);
    CHECK(given["second"]["specimens"] == 2);
    REQUIRE(given["compared"].size() == 1);
    const auto& tilt = given["compared"][0]["mean_tilt_deg"];
    CHECK(given["compared"][0]["layers"][1] == 3);
    CHECK(tilt["pairs"] == 2);
    const auto mean_of = [](const nlohmann::json& specimens) {
        double sum = 0.0;
        for (const auto& specimen : specimens) {
            sum += 0.5 * (specimen["layers"][1]["mean_tilt_deg"].get<double>() + specimen["layers"][2]["mean_tilt_deg"].get<double>());
        }
        return sum / static_cast<double>(specimens.size());
    };
    CHECK(tilt["first_mean"].get<double>() == doctest::Approx(mean_of(layers.json()["specimens"])));
    CHECK(tilt["second_mean"].get<double>() == doctest::Approx(mean_of(quick.json()["specimens"])));
    const Outcome text = place.run("specimen --compare layers.json quick.json");
    CHECK(text.out.find("layers 2-3") != std::string::npos);

    const auto refuses = [&](const std::string& arguments, int exit_code, const std::string& why) {
        const Outcome refused = place.run(arguments);
        CHECK(refused.exit_code == exit_code);
        CHECK(refused.has_one_error_line());
        CAPTURE(refused.err);
        CHECK(refused.err.find(why) != std::string::npos);
    };
    place.write("again.json", place.run("specimen wall.json -o quick --seeds 2 --json").out);
    refuses("specimen --compare layers.json again.json", 3, "was there before");
    refuses("specimen --compare layers.json wall.json", 3, "is no list of specimens");
    refuses("specimen --compare layers.json none.json", 3, "cannot be opened");
    place.write("none.json", R"({"specimens": []})");
    refuses("specimen --compare none.json layers.json", 3, "has no specimen");
    refuses("specimen --compare layers.json", 2, "2 required");
    refuses("specimen wall.json --compare layers.json quick.json", 2, "excludes");
    refuses("specimen", 2, "is required");
}

TEST_CASE("what cannot be a specimen is refused in one line") {
    const Workplace place;
    place.write("wall.json", make_uneven_scene(kWall));
    place.write("blocks.json",
                make_uneven_scene(R"({"kind": "blocks", "blocks": [{"size": ["1 cm", "1 cm", "1 cm"], "position": [0, 0, "5 mm"]}]})"));
    place.write("file", "not a folder");
    const auto refused = [&](const std::string& arguments, int exit_code) {
        const Outcome outcome = place.run("specimen " + arguments);
        CHECK(outcome.exit_code == exit_code);
        CHECK(outcome.has_one_error_line());
    };
    refused("wall.json --placing thrown", 2);
    refused("wall.json --seeds 0", 2);
    refused("nothing.json", 3);
    refused("blocks.json", 3);
    std::string sudden = make_uneven_scene(kWall);
    sudden.insert(1, R"("preparation": "none", )");
    place.write("sudden.json", sudden);
    refused("sudden.json", 3);
    refused("wall.json -o file/below", 3);
}

TEST_CASE("a specimen that another process makes is refused, and what killed ones left is removed") {
    const Workplace here;
    here.write("wall.json", make_uneven_scene(kWall));
    const std::string command = "specimen wall.json -o out --json";
    const std::string file = here.run(command).json()["specimens"][0]["file"];
    const std::string hidden = "out/." + file.substr(4);
    here.shell("rm " + file);
    const Outcome second = here.run(command, "exec 9>" + hidden + ".lock; flock 9;");
    CHECK(second.exit_code == 3);
    CHECK(second.has_one_error_line());
    CHECK_MESSAGE(second.err.find(file + ": another musim is making it") != std::string::npos, second.err);
    // the lock went with its process, its file and what was half-written did not
    here.shell("touch " + hidden + ".17.1.tmp " + hidden + ".checkpoint.17.2.tmp");
    CHECK(here.has(hidden + ".lock"));
    CHECK(here.run(command).exit_code == 0);
    CHECK(here.count("out") == 1);
    // nor is a checkpoint left that a kill left beside the finished file
    here.shell("touch " + file + ".checkpoint");
    CHECK(here.run(command).json()["specimens"][0]["reused"] == true);
    CHECK(here.count("out") == 1);
}
