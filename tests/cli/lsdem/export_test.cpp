#include <doctest/doctest.h>

#include <string>

#include "tests/cli/program.hpp"
#include "tests/support/gltf_check.hpp"

using namespace musim::cli;
using musim::tests::GltfCheck;

namespace {

/// A column that is shaken for 20 ms; with frames, 11 of them.
std::string make_stack_of_two(bool frames) {
    return std::string(R"({"schema": "musim-scene/1", "name": "column", "material": "wood",
        "structure": {"kind": "column", "layers": 3, "block": ["12.710 mm", "26.355 mm", "39.780 mm"]},
        "base_motion": {"signal": "half_sine", "direction": "x", "amplitude": "0.5 g", "duration": "20 ms"},
        "time": {"duration": "20 ms"}, "output": {"spine_rate": "5000 Hz")") +
           (frames ? R"(, "frame_rate": "500 Hz")" : "") + "}}";
}

}  // namespace

TEST_CASE("export writes a run as glTF, with its motion, and a scene as drawn") {
    const Workplace here;
    here.write("scene.json", make_stack_of_two(true));
    REQUIRE(here.run("run scene.json -o out").exit_code == 0);
    const Outcome outcome = here.run("export out -o column.glb --json");
    REQUIRE(outcome.exit_code == 0);
    CHECK(outcome.json()["blocks"] == 3);
    CHECK(outcome.json()["frames"] == 11);
    CHECK(outcome.json()["duration_s"].get<double>() == doctest::Approx(0.02));
    CHECK(outcome.json()["bytes"] == here.read("column.glb").size());
    const GltfCheck moving(here.read("column.glb"));
    CHECK(moving.faults == std::vector<std::string>{});
    CHECK(moving.json["nodes"].size() == 4);
    CHECK(moving.json["meshes"].size() == 1);
    CHECK(moving.json["animations"][0]["channels"].size() == 6);
    CHECK(moving.json["asset"]["extras"]["name"] == "column");

    // the same bytes again, in place of the file
    REQUIRE(here.run("export out -o again.glb").exit_code == 0);
    REQUIRE(here.run("export out -o again.glb").exit_code == 0);
    CHECK(here.read("again.glb") == here.read("column.glb"));

    REQUIRE(here.run("export scene.json -o drawn.glb").exit_code == 0);
    const GltfCheck drawn(here.read("drawn.glb"));
    CHECK(drawn.faults == std::vector<std::string>{});
    CHECK_FALSE(drawn.json.contains("animations"));
    // the middle of the lowest block is half a block above the ground
    CHECK(drawn.json["nodes"][1]["translation"][2].get<double>() == doctest::Approx(0.5 * 0.03978).epsilon(1e-6));
}

TEST_CASE("export writes one instant as OBJ or STL, by the name or by an option") {
    const Workplace here;
    here.write("scene.json", make_stack_of_two(true));
    REQUIRE(here.run("run scene.json -o out").exit_code == 0);
    const Outcome outcome = here.run("export out -o column.OBJ --at 0.01");
    REQUIRE(outcome.exit_code == 0);
    CHECK(outcome.out == "column.OBJ: 3 blocks\n");
    CHECK(here.read("column.OBJ").starts_with("# column: 3 blocks, in m, z up\no block_0\nv "));
    REQUIRE(here.run("export scene.json -o triangles --format stl").exit_code == 0);
    CHECK(here.read("triangles").size() == 84 + 50 * 3 * 12);
    // a glTF at one time has no motion
    REQUIRE(here.run("export out -o still.gltf --at 0.01").exit_code == 0);
    CHECK_FALSE(nlohmann::json::parse(here.read("still.gltf")).contains("animations"));
}

TEST_CASE("export says that nothing moves where a run has kept no frames") {
    const Workplace here;
    here.write("scene.json", make_stack_of_two(false));
    REQUIRE(here.run("run scene.json -o out").exit_code == 0);
    const Outcome outcome = here.run("export out -o column.glb");
    CHECK(outcome.exit_code == 0);
    CHECK(outcome.err.find("the run has kept no frames, so nothing moves") != std::string::npos);
    const Outcome at = here.run("export out -o column.glb --at 0.01");
    CHECK(at.exit_code == 3);
    CHECK(at.has_one_error_line());
}

TEST_CASE("what export cannot do is refused in one line, and leaves no file") {
    const Workplace here;
    here.write("scene.json", make_stack_of_two(true));
    REQUIRE(here.run("run scene.json -o out").exit_code == 0);
    struct Refused {
        const char *arguments, *why;
        int code;
    };
    for (const Refused& refused : {Refused{"export out -o column.dae", "its name ends in none of .glb, .gltf, .obj, .stl", 2},
                                   Refused{"export out -o column.glb --at 5", "there is no frame at 5 s", 3},
                                   Refused{"export scene.json -o column.glb --at 0", "a scene has no times", 2},
                                   Refused{"export nowhere -o column.glb", "nowhere", 3},
                                   Refused{"export scene.json -o scene.json --format glb", "cannot be written", 3},
                                   Refused{"export out -o no/such/column.glb", "no/such/column.glb", 3}}) {
        CAPTURE(refused.arguments);
        const Outcome outcome = here.run(refused.arguments);
        CHECK(outcome.exit_code == refused.code);
        CHECK(outcome.has_one_error_line());
        CHECK(outcome.err.find(refused.why) != std::string::npos);
    }
    CHECK(here.count(".") == 2);
}
