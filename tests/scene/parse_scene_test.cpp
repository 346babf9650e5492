#include <doctest/doctest.h>

#include <array>
#include <fstream>
#include <limits>

#include "lsdem/scene/build_model.hpp"
#include "lsdem/scene/scale_scene.hpp"
#include "lsdem/scene/scene_json.hpp"
#include "scaling/laws/law_similitude.hpp"
#include "tests/scene/made_scene.hpp"

using namespace musim;
using namespace musim::lsdem;
using namespace musim::lsdem::testing;

namespace {

/// Message for a scene that is to be refused.
std::string refuse(const std::string& text) {
    return error_of([&] { parse_scene(text, "dir/tower.json"); });
}

std::string replace(std::string text, const std::string& what, const std::string& by) {
    const std::size_t at = text.find(what);
    REQUIRE(at != std::string::npos);
    return text.replace(at, what.size(), by);
}

/// Material given by its properties, so that each can be spoiled.
const std::string kFull = R"({"schema": "musim-scene/1", "name": "full",
    "material": {"density": "800 kg/m^3", "normal_stiffness": "30 MN/m", "shear_stiffness": "26 MN/m", "friction": "0.63", "restitution": 0.3},
    "structure": {"kind": "column", "layers": 2, "block": ["12.710 mm", "26.355 mm", "39.780 mm"]},
    "time": {"duration": "1 s", "step": "10 us"}, "output": {"spine_rate": "4800 Hz"}})";

}  // namespace

TEST_CASE("the scene of the contracts is read with its units") {
    const Scene scene = parse_scene(R"({ "schema": "musim-scene/1", "name": "wood tower 1:107",
        "gravity": "9.80665 m/s^2",
        "material": { "density": "800 kg/m^3", "normal_stiffness": "30 MN/m", "shear_stiffness": "26 MN/m", "friction": 0.63, "restitution": 0.3 },
        "shape": { "kind": "box", "level_set": "box", "nodes_per_face": 44 },
        "structure": { "kind": "tower", "layers": 38, "block": ["12.710 mm", "26.355 mm", "39.780 mm"], "height_deviation": "0 mm", "seed": 1 },
        "base_motion": { "record": "ridgecrest.v1", "components": { "x": "360" }, "scale": { "law": "mu", "length": "1/107" } },
        "time": { "duration": "2.5 s", "step": "auto", "safety": 0.8 },
        "output": { "spine_rate": "4800 Hz", "frame_rate": "100 Hz" } })",
                                    "/scenes/wood.json");
    CHECK(scene.name == "wood tower 1:107");
    CHECK(scene.gravity[0].value() == 0.0);
    CHECK(scene.gravity[2].value() == -9.80665);
    CHECK(scene.material.density.value() == 800.0);
    CHECK(scene.material.normal_stiffness.value() == 30e6);
    CHECK(scene.material.shear_stiffness.value() == 26e6);
    CHECK(scene.material.friction == 0.63);
    CHECK(scene.material.restitution == 0.3);
    CHECK(std::get<BoxShape>(scene.shape).nodes_per_face == 44);
    const Tower& tower = std::get<Tower>(scene.structure);
    CHECK(tower.layers == 38);
    CHECK(tower.block[0].value() == 0.01271);
    CHECK(tower.tiling == TilingSettings{});
    const RecordMotion& motion = std::get<RecordMotion>(scene.base_motion.source);
    CHECK(motion.file == "/scenes/ridgecrest.v1");
    CHECK(motion.components[0] == "360");
    CHECK_FALSE(motion.components[1]);
    CHECK(motion.scale->law == "mu");
    CHECK(motion.scale->set == std::map<std::string, double>{{"l", 1.0 / 107.0}});
    CHECK(scene.time.duration.value() == 2.5);
    CHECK_FALSE(scene.time.step);
    CHECK(scene.time.safety == 0.8);
    CHECK(scene.output.spine_rate.value() == 4800.0);
    CHECK(scene.output.frame_rate->value() == 100.0);
}

TEST_CASE("plain numbers are SI and texts without unit are numbers") {
    const Scene scene = parse_scene(replace(replace(kFull, "\"800 kg/m^3\"", "800"), "\"30 MN/m\"", "3e7"));
    CHECK(scene.material.density.value() == 800.0);
    CHECK(scene.material.normal_stiffness.value() == 30e6);
    CHECK(scene.material.friction == 0.63);
}

TEST_CASE("a preset may be changed in part, and blocks may name presets") {
    const Scene changed = parse_scene(make_scene_text(kColumn, R"(, "ground": {"friction": 0.2})"));
    CHECK(changed.material == find_material_preset("wood").material);
    CHECK(changed.ground.friction == 0.2);

    Scene scene = parse_scene(replace(make_scene_text(kColumn), "\"wood\"", R"({"preset": "wood", "friction": "0.5"})"));
    BlockMaterial expected = find_material_preset("wood").material;
    expected.friction = 0.5;
    CHECK(scene.material == expected);

    scene = parse_scene(
        make_scene_text(R"({"kind": "blocks", "blocks": [{"size": [1, 1, 1], "position": [0, 0, 1], "material": "al_printed"}]})"));
    CHECK(scene.materials.at("al_printed") == find_material_preset("al_printed").material);
}

TEST_CASE("a scene written to text is read back bit for bit") {
    const std::vector<std::string> texts{
        kFull,
        make_scene_text(kTower, kRicker),
        make_scene_text(kWall, R"(, "base_motion": {"signal": "sine", "amplitude": "0.5 g", "frequency": "3 Hz", "cycles": "10/3"})"),
        make_scene_text(kBlocks, kSteel + R"(, "contact": {"nodes": "both", "faces": "nodes"}, "gravity": [0.1, "0.2 g", -9])"),
        make_scene_text(kColumn,
                        R"(, "base_motion": {"signal": "step", "velocity": "32 mm/s", "direction": "z"}, "ground": {"friction": "1/3"})"),
        make_scene_text(kColumn, R"(, "base_motion": {"signal": "half_sine", "amplitude": "1 g", "duration": "0.05 s", "dt": "1 ms"})"),
        make_scene_text(kColumn, R"(, "base_motion": {"signal": "synthetic", "pga": "0.511 g", "pgv": "42.4 cm/s", "duration": "10 s",
                                     "dt": "0.005 s", "seed": 7, "factors": {"time": "1/3", "velocity": 0.1}})"),
        make_scene_text(kColumn, R"(, "base_motion": {"record": "a.txt", "components": {"x": "1", "z": "2"}, "unit": "g", "dt": "0.01 s",
                                     "quantity": "velocity", "window": ["1 s", "2 s"], "highpass": "0.1 Hz", "at_rest": "displaced",
                                     "scale": {"law": "froude", "length": "1/25", "friction": 0.9, "gravity": 2, "density": 3}})"),
        make_scene_text(kColumn, R"(, "base_motion": {"record": "a.txt", "components": {"x": "1"},
                                     "scale": {"law": "centrifuge", "length": "1/25"}})"),
        make_scene_text(kColumn, R"(, "base_motion": {"record": "a.txt", "components": {"x": "x"}, "skip": 4,
                                     "columns": {"time": 2, "x": "Acc NS, corrected"}})"),
        make_scene_text(kColumn, R"(, "base_motion": {"record": "a.txt", "components": {"x": "1"},
                                     "scale": {"law": "restoring_force", "length": 0.25, "set": {"F_R": "1/500", "rho": 2}}})"),
        make_scene_text(kColumn, R"(, "shape": {"kind": "box", "level_set": "grid", "nodes_per_face": 21, "voxel": "0.65 mm"})"),
        make_scene_text(R"({"kind": "blocks", "blocks": [{"position": [0, 0, "0.1 m"]}]})",
                        R"(, "shape": {"kind": "sphere", "radius": "10 cm", "nodes": 100, "voxel": "1 cm"}, "ground": {"present": false})"),
        make_scene_text(R"({"kind": "tower", "layers": 2, "block": [1, 2, 3], "pitch": 1.1, "seed": 12,
                            "tiling": {"cells_across": 6, "inner_radius": 1, "outer_radius": 3.2, "file": "tiling.json"}})"),
    };
    for (const std::string& text : texts) {
        const Scene scene = parse_scene(text, "/scenes/a.json");
        const std::string written = write_scene(scene);
        CAPTURE(written);
        CHECK(parse_scene(written, "/elsewhere/b.json") == scene);
        CHECK(write_scene(parse_scene(written)) == written);
    }
}

TEST_CASE("columns of a record are an object or a text, with the time or without") {
    const auto columns = [](const std::string& value) {
        const std::string motion = R"(, "base_motion": {"record": "a.txt", "components": {"x": "x"}, "columns": )" + value + "}";
        return *std::get<RecordMotion>(parse_scene(make_scene_text(kColumn, motion), "/scenes/a.json").base_motion.source).columns;
    };
    const records::ColumnChoices chosen{{"time", "2"}, {"x", "3"}};
    CHECK(columns(R"({"time": 2, "x": 3})") == chosen);
    CHECK(columns(R"({"time": "2", "x": "3"})") == chosen);
    CHECK(columns(R"("time=2,x=3")") == chosen);
    for (const std::pair<const char*, const char*>& row :
         {std::pair<const char*, const char*>{R"({"time": 2})", "no component is among them"},
          {R"({"x": -1})", "columns/x"},
          {"[2, 3]", "write {\"time\": 2, \"x\": 3}"},
          {R"("x")", "'x' is not NAME=COLUMN"}}) {
        const std::string message = error_of([&] { columns(row.first); });
        CHECK_MESSAGE(message.find(row.second) != std::string::npos, message);
        CHECK_MESSAGE(message.find("/base_motion/columns") != std::string::npos, message);
    }
}

TEST_CASE("an unknown key is refused with its place and the nearest known key") {
    check_message(refuse(replace(kFull, "\"density\"", "\"densty\"")),
                  {"dir/tower.json: /material/densty: unknown key", "did you mean \"density\"?"});
    check_message(refuse(replace(kFull, "\"layers\"", "\"leyers\"")), {"/structure/leyers", "did you mean \"layers\"?"});
    check_message(refuse(replace(kFull, "\"name\"", "\"zzzzzzzz\"")), {"/zzzzzzzz: unknown key", "known are schema, name, gravity"});
    check_message(refuse(replace(kFull, "\"kind\": \"column\"", "\"kind\": \"tower\", \"tiling\": {\"outerradius\": 3}")),
                  {"/structure/tiling/outerradius", "did you mean \"outer_radius\"?"});
    check_message(refuse(replace(kFull, "\"column\"", "\"colum\"")), {"/structure/kind", "did you mean \"column\"?"});
    check_message(refuse(make_scene_text(kColumn, R"(, "base_motion": {"signal": "riker", "amplitude": 1, "frequency": 1})")),
                  {"/base_motion/signal", "did you mean \"ricker\"?"});
    check_message(refuse(make_scene_text(kColumn, R"(, "base_motion": {"signal": "step", "velocity": 1, "frequency": 1})")),
                  {"/base_motion/frequency: unknown key"});
    check_message(refuse(make_scene_text(kColumn, R"(, "base_motion": {"signal": "step", "velocity": 1, "direction": "u"})")),
                  {"/base_motion/direction", "x, y, z"});
}

TEST_CASE("a missing key is named") {
    check_message(refuse(R"({"schema": "musim-scene/1"})"), {"dir/tower.json: /: key \"material\" is missing; add it"});
    check_message(refuse(replace(kFull, "\"density\": \"800 kg/m^3\",", "")), {"/material: key \"density\" is missing"});
    check_message(refuse(replace(kFull, "\"duration\": \"1 s\",", "")), {"/time: key \"duration\" is missing"});
    check_message(refuse(replace(kFull, "musim-scene/1", "musim-scene/9")), {"/schema", "musim-scene/9", "write \"musim-scene/1\""});
    check_message(refuse(make_scene_text(kColumn, R"(, "base_motion": {})")), {"/base_motion", "\"record\" or a \"signal\""});
}

TEST_CASE("a value of the wrong type, unit or range is refused with its place") {
    struct Case {
        std::string what, by;
        std::vector<std::string> message;
    };
    const std::vector<Case> cases{
        {"\"800 kg/m^3\"", "\"-800 kg/m^3\"", {"/material/density: -800 kg/m^3 (must be positive)"}},
        {"\"800 kg/m^3\"", "0", {"/material/density", "must be positive"}},
        {"\"800 kg/m^3\"", "\"800 kg\"", {"/material/density", "800 kg"}},
        {"\"800 kg/m^3\"", "\"800 lumps/m^3\"", {"/material/density", "lumps"}},
        {"\"800 kg/m^3\"", "true", {"/material/density: boolean true found"}},
        {"\"800 kg/m^3\"", "[1]", {"/material/density: array found"}},
        {"\"30 MN/m\"", "-1", {"/material/normal_stiffness", "must be positive"}},
        {"\"26 MN/m\"", "\"26 MN\"", {"/material/shear_stiffness"}},
        {"\"0.63\"", "-0.1", {"/material/friction: -0.1 (must not be negative)"}},
        {"\"0.63\"", "\"1/0\"", {"/material/friction"}},
        {"0.3}", "0}", {"/material/restitution: 0 ("}},
        {"0.3}", "1.01}", {"/material/restitution: 1.01 ("}},
        {"\"layers\": 2", "\"layers\": 0", {"/structure/layers: 0"}},
        {"\"layers\": 2", "\"layers\": 2.5", {"/structure/layers", "whole number"}},
        {"\"12.710 mm\"", "\"-12.710 mm\"", {"/structure/block/0: -12.71 mm (must be positive)"}},
        {"\"12.710 mm\",", "", {"/structure/block", "three values"}},
        {"\"1 s\"", "0", {"/time/duration", "must be positive"}},
        {"\"1 s\"", "\"-1 s\"", {"/time/duration", "must be positive"}},
        {"\"10 us\"", "0", {"/time/step", "must be positive"}},
        {"\"10 us\"", "\"10 us\", \"safety\": 1.5", {"/time/safety: 1.5"}},
        {"\"4800 Hz\"", "-1", {"/output/spine_rate", "must not be negative"}},
        {"\"full\"", "5", {"/name", "a text is wanted"}},
        {"\"kind\": \"column\"",
         "\"kind\": \"tower\", \"height_deviation\": \"2 mm\"",
         {"/structure/height_deviation: 2 mm", "use at most 1.989 mm"}},
        {"\"kind\": \"column\"", "\"kind\": \"tower\", \"pitch\": \"13 mm\"", {"/structure/block", "overlap their neighbors"}},
        {"\"kind\": \"column\"", "\"kind\": \"tower\", \"seed\": -1", {"/structure/seed", "whole number from 0"}},
        {"\"kind\": \"column\"", "\"kind\": \"tower\", \"tiling\": \"ring_13\"", {"/structure/tiling", "ring_13", "ring_14"}},
    };
    for (const Case& c : cases) {
        CAPTURE(c.by);
        check_message(refuse(replace(kFull, c.what, c.by)), c.message);
    }
}

TEST_CASE("faults of blocks, motions and materials are refused with their place") {
    const auto blocks = [](const std::string& entry) { return make_scene_text(R"({"kind": "blocks", "blocks": [)" + entry + "]}"); };
    check_message(refuse(blocks("")), {"/structure/blocks: no block"});
    check_message(refuse(blocks(R"({"position": [0, 0, 1]})")), {"/structure/blocks/0: key \"size\" is missing"});
    check_message(refuse(blocks(R"({"size": [1, 1, 1], "position": [0, 0, 1], "quaternion": [0, 0, 0, 0]})")),
                  {"/structure/blocks/0/quaternion"});
    check_message(refuse(blocks(R"({"size": [1, 1, 1], "position": [0, 0, 1], "quaternion": [1, 0, 0]})")),
                  {"/structure/blocks/0/quaternion"});
    check_message(refuse(blocks(R"({"size": [1, 1, 1], "position": [0, 0, 1], "material": "basalt"})")),
                  {"/structure/blocks/0/material", "\"basalt\" is not a known material"});
    const auto motion = [](const std::string& text) { return make_scene_text(kColumn, R"(, "base_motion": )" + text); };
    check_message(refuse(motion(R"({"record": "a.txt", "components": {}})")), {"/base_motion/components", "no component"});
    check_message(refuse(motion(R"({"record": "a.txt", "components": {"x": "1"}, "window": [2, 1]})")),
                  {"/base_motion/window", "is empty"});
    check_message(refuse(motion(R"({"record": "a.txt", "components": {"x": "1"}, "window": 2})")), {"/base_motion/window"});
    check_message(refuse(motion(R"({"record": "a.txt", "components": {"x": "1"}, "at_rest": "no"})")),
                  {"/base_motion/at_rest", "\"displaced\" (at rest elsewhere) or false (as given)"});
    check_message(refuse(motion(R"({"record": "a.txt", "components": {"x": "1"}, "scale": {"law": "nu"}})")),
                  {"/base_motion/scale/law", "mu"});
    check_message(refuse(motion(R"({"record": "a.txt", "components": {"x": "1"}, "scale": {"length": -1}})")), {"/base_motion/scale"});
    check_message(refuse(motion(R"({"record": "a.txt", "components": {"x": "1"}, "scale": {"law": "restoring_force", "length": 0.1}})")),
                  {"/base_motion/scale", "the factor of F_R (restoring force) is missing"});
    check_message(refuse(motion(R"({"record": "a.txt", "components": {"x": "1"}, "scale": {"law": "mine.json", "length": 0.1}})")),
                  {"/base_motion/scale", "there is no law \"/"});
    check_message(
        refuse(motion(R"({"record": "a.txt", "components": {"x": "1"}, "scale": {"law": "froude", "length": 0.1, "set": {"l": 0.1}}})")),
        {"/base_motion/scale/set/l", "given twice"});
    check_message(refuse(motion(R"({"record": "a.txt", "components": {"x": "1"}, "scale": {"law": "froude", "set": 3}})")),
                  {"/base_motion/scale/set", "an object of factors is wanted"});
    check_message(refuse(motion(R"({"signal": "sine", "amplitude": 1, "frequency": 0, "cycles": 1})")), {"/base_motion/frequency"});
    check_message(refuse(motion(R"({"signal": "step", "velocity": 1, "start": -1})")), {"/base_motion/start"});
    check_message(refuse(make_scene_text(kColumn, R"(, "ground": {"present": false})" + kRicker)), {"/base_motion", "no ground to move"});
    check_message(refuse(make_scene_text(kColumn, R"(, "shape": {"kind": "sphere", "radius": 1, "voxel": 0.1})")),
                  {"/shape/kind", "spheres cannot"});
    check_message(refuse(make_scene_text(kColumn, R"(, "shape": {"kind": "box", "nodes_per_face": 3})")), {"/shape/nodes_per_face"});
    check_message(refuse(make_scene_text(kWall, R"(, "materials": {"steel": {"preset": "iron"}})")),
                  {"/materials/steel/preset", "\"iron\""});
}

TEST_CASE("a syntax error is refused with line and column") {
    check_message(refuse("{\n  \"schema\": \"musim-scene/1\",\n  \"name\" \"x\"\n}"), {"dir/tower.json:3:", "not valid JSON"});
    check_message(refuse(""), {"dir/tower.json:1:1", "not valid JSON"});
    check_message(refuse("[]"), {"dir/tower.json: /: array found"});
    check_message(refuse(replace(kFull, "\"name\": \"full\"", "\"name\": \"a\", \"name\": \"b\"")), {"\"name\" is given twice"});
}

TEST_CASE("every object of a scene may have a comment, which changes nothing and must be text") {
    std::string commented = kFull;
    for (std::size_t at = commented.find('{'); at != std::string::npos; at = commented.find('{', at + 1)) {
        commented.insert(at + 1, R"("comment": ["for", "people"], )");
    }
    CHECK(parse_scene(commented) == parse_scene(kFull));
    CHECK(write_scene(parse_scene(commented)) == write_scene(parse_scene(kFull)));
    CHECK(parse_scene(make_scene_text(kColumn, R"(, "comment": "a column")")) == parse_scene(make_scene_text(kColumn)));
    for (const char* const wrong : {"1", "null", "{}", R"(["a", 1])"}) {
        check_message(refuse(make_scene_text(kColumn, std::string(R"(, "comment": )") + wrong)),
                      {"/comment: a text or a list of texts is wanted"});
    }
}

TEST_CASE("a scene file that is not there is refused") {
    check_message(error_of([] { read_scene("/nowhere/scene.json"); }), {"/nowhere/scene.json", "cannot be read"});
    check_message(error_of([] { read_scene("/tmp"); }), {"/tmp", "cannot be read"});
}

TEST_CASE("a scene made in code is checked for values that no file can hold") {
    Scene scene = parse_scene(kFull);
    scene.material.density = scaling::Density::from_value(std::numeric_limits<double>::quiet_NaN());
    check_message(error_of([&] { check_scene(scene, "code"); }), {"code: /material/density: nan (must be positive)"});
    scene = parse_scene(kFull);
    scene.gravity[1] = scaling::Acceleration::from_value(std::numeric_limits<double>::infinity());
    check_message(error_of([&] { check_scene(scene, "code"); }), {"code: /gravity/1: inf (must be finite)"});
}

TEST_CASE("listed blocks may have names, each its own, that survive writing, reading and scaling") {
    const auto text = [](const std::string& first, const std::string& second) {
        return R"({"schema": "musim-scene/1", "material": "wood", "time": {"duration": 1}, "structure": {"kind": "blocks", "blocks": [
            {"size": [1, 1, 1], "position": [0, 0, 0.5], "name": ")" +
               first + R"("}, {"size": [1, 1, 1], "position": [2, 0, 0.5])" + second + "}]}}";
    };
    const Scene scene = parse_scene(text("left post", ""), "test");
    const Scene again = parse_scene(write_scene(scene), "test");
    CHECK(again == scene);
    CHECK(std::get<BlockList>(again.structure).blocks[0].name == "left post");
    CHECK(write_scene(scene).find("\"name\": \"\"", 40) == std::string::npos);
    const Scene scaled = scale_scene(scene, musim::scaling::make_similitude("exact", {.length = 0.25}));
    CHECK(std::get<BlockList>(scaled.structure).blocks[0].name == "left post");
    CHECK(build_model(scene).structure.name == std::vector<std::string>{"left post", ""});
    for (const auto& [first, second, why] :
         {std::array{"post", R"(, "name": "post")", "block 0 is called \"post\" as well"},
          std::array{"block 1", "", "what blocks without a name"}, std::array{"17", "", "what blocks without a name"},
          std::array{"base", "", "the ground in results"}, std::array{"a,b", "", "no comma"}, std::array{" a", "", "blank at an end"}}) {
        CHECK_THROWS_WITH_AS(parse_scene(text(first, second), "test"), doctest::Contains(why), SceneError);
    }
}
