#include <doctest/doctest.h>

#include <cmath>
#include <string>

#include "tests/cli/program.hpp"

using namespace musim::cli;

namespace {

std::string make_scene(const std::string& structure) {
    return R"({"schema": "musim-scene/1", "name": "wall", "material": "wood", "shape": {"kind": "box", "nodes_per_face": 9},
 "structure": )" +
           structure + R"(, "time": {"duration": "2 ms"}, "output": {"spine_rate": "2000 Hz"}})";
}

const std::string kWall = R"({"kind": "wall", "layers": 3, "blocks_per_layer": 1, "block": ["12.710 mm", "26.355 mm", "39.780 mm"],
               "height_deviation": "0.155 mm", "seed": 5})";

}  // namespace

TEST_CASE("specimens are made for several seeds, found again, and used by a scene that names one") {
    const Workplace place;
    place.write("wall.json", make_scene(kWall));
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

    std::string scene = make_scene(kWall);
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

TEST_CASE("what cannot be a specimen is refused in one line") {
    const Workplace place;
    place.write("wall.json", make_scene(kWall));
    place.write("blocks.json",
                make_scene(R"({"kind": "blocks", "blocks": [{"size": ["1 cm", "1 cm", "1 cm"], "position": [0, 0, "5 mm"]}]})"));
    place.write("file", "in the way");
    const auto refused = [&](const std::string& arguments, int exit_code) {
        const Outcome outcome = place.run("specimen " + arguments);
        CHECK(outcome.exit_code == exit_code);
        CHECK(outcome.has_one_error_line());
    };
    refused("wall.json --placing thrown", 2);
    refused("wall.json --seeds 0", 2);
    refused("nothing.json", 3);
    refused("blocks.json", 3);
    refused("wall.json -o file/below", 3);
}
