#include <doctest/doctest.h>

#include <string>
#include <vector>

#include "lsdem/scene/scale_scene.hpp"
#include "scaling/laws/law_similitude.hpp"
#include "tests/scene/made_scene.hpp"

using namespace musim;
using namespace musim::lsdem;
using namespace musim::lsdem::testing;

namespace {

/// Blocks of given entries and shapes, both as members of JSON objects.
std::string make_shapes_text(const std::string& shapes, const std::string& blocks, const std::string& more = "") {
    return make_scene_text(R"({"kind": "blocks", "blocks": [)" + blocks + "]}", R"(, "shapes": {)" + shapes + "}" + more);
}

const std::string kWedge = R"("wedge": {"kind": "prism", "outline": [[0, 0], ["0.4 m", 0], [0, "0.3 m"]], "axis": "y", "length": "0.5 m"})";
const std::string kEveryKind = kWedge + R"(,
    "block": {"kind": "box", "size": ["0.1 m", "0.2 m", "0.3 m"], "quaternion": [1, 0, 0, 1]},
    "drum": {"kind": "cylinder", "radius": "0.3 m", "height": "0.2 m", "flats": 12, "top_radius": "0.25 m", "scale": [1, 1, "3/2"]},
    "stone": {"kind": "polyhedron", "vertices": [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]], "faces": [[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]],
              "mirror": "y", "mass": "300 kg", "centre": ["0.2 m", "-0.25 m", "0.25 m"], "inertia": [[9, 1, 0], [1, 8, "-0.5 kg m^2"], [0, -0.5, 7]]},
    "rock": {"kind": "mesh", "file": "rocks/rock.obj", "unit": "mm", "part": 2},
    "other": {"kind": "mesh", "file": "rocks/rock.obj", "unit": "mm", "part": "left"},
    "key": {"kind": "compound", "parts": [{"shape": "block"}, {"shape": "block", "position": ["0.1 m", 0, 0], "quaternion": [1, 0, 0, 0]}]},
    "cross": {"kind": "compound", "file": "cross.obj", "unit": "cm", "scale": 2})";
const std::string kWedgeBlock = R"({"shape": "wedge", "position": [0, 0, 0], "density": "2 g/cm^3"})";

scaling::Similitude make_quarter() { return scaling::make_similitude("mu", {.length = 0.25}); }

}  // namespace

TEST_CASE("shapes of every kind come back from what is written of them") {
    const Scene scene = parse_scene(make_shapes_text(kEveryKind, kWedgeBlock), "/scenes/scene.json");
    REQUIRE(scene.shapes.size() == 8);
    const auto& drum = std::get<CylinderForm>(scene.shapes.at("drum").form);
    CHECK(drum.top_radius->value() == 0.25);
    CHECK(scene.shapes.at("drum").scale == std::array{1.0, 1.0, 1.5});
    CHECK(scene.shapes.at("stone").inertia->at(1)[2].value() == -0.5);
    CHECK(std::get<MeshForm>(scene.shapes.at("rock").form).file == "/scenes/rocks/rock.obj");
    CHECK(scene.shapes.at("cross").scale == std::array{2.0, 2.0, 2.0});
    CHECK(std::get<BlockList>(scene.structure).blocks.front().density->value() == 2000.0);

    CHECK(parse_scene(write_scene(scene), "/elsewhere/scene.json") == scene);
    // what no scene before had is not written for those
    CHECK(write_scene(parse_scene(make_scene_text(kBlocks, kSteel))).find("\"shape") ==
          write_scene(parse_scene(make_scene_text(kBlocks, kSteel))).find("\"shape\": {"));
}

TEST_CASE("all lengths of a shape are scaled, and what is given apart from it by its own factor") {
    const Scene scene = parse_scene(make_shapes_text(kEveryKind, kWedgeBlock), "/scenes/scene.json");
    const Scene small = scale_scene(scene, make_quarter());
    CHECK(std::get<PrismForm>(small.shapes.at("wedge").form).outline[2][1].value() == 0.25 * 0.3);
    CHECK(std::get<PrismForm>(small.shapes.at("wedge").form).taper == 1.0);
    CHECK(std::get<CylinderForm>(small.shapes.at("drum").form).top_radius->value() == 0.0625);
    CHECK(small.shapes.at("drum").scale == std::array{1.0, 1.0, 1.5});
    const ShapeEntry& stone = small.shapes.at("stone");
    CHECK(std::get<PolyhedronForm>(stone.form).vertices[3][2].value() == 0.25);
    CHECK(stone.mass->value() == 300.0 / 64.0);              // λ_ρ λ_l³
    CHECK(stone.centre->at(1).value() == -0.0625);           // λ_l
    CHECK(stone.inertia->at(0)[0].value() == 9.0 / 1024.0);  // λ_ρ λ_l⁵
    CHECK(std::get<CompoundForm>(small.shapes.at("key").form).parts[1].position[0].value() == 0.025);
    // coordinates of files stay, and what multiplies them is scaled
    CHECK(small.shapes.at("rock").scale == std::array{0.25, 0.25, 0.25});
    CHECK(small.shapes.at("cross").scale == std::array{0.5, 0.5, 0.5});
    CHECK(std::get<BlockList>(small.structure).blocks.front().density->value() == 2000.0);
    CHECK(parse_scene(write_scene(small), "/scenes/small.json") == small);
}

TEST_CASE("shapes that cannot be are refused with their place") {
    struct Case {
        std::string shapes, block;
        std::vector<std::string> parts;
    };
    const std::string at_origin = R"("position": [0, 0, 0]})";
    const auto stone = [](const std::string& more) {
        return R"("stone": {"kind": "polyhedron", "vertices": [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]])" + more + "}";
    };
    for (const Case& c : std::vector<Case>{
             {kWedge,
              R"({"shape": "wege", )" + at_origin,
              {"/structure/blocks/0/shape: \"wege\" is not among the scene's shapes (wedge); did you mean \"wedge\"?"}},
             {kWedge, R"({"shape": "capital", )" + at_origin, {"/structure/blocks/0/shape", "(wedge); add it under /shapes"}},
             {kWedge, R"({"shape": "wedge", "size": [1, 1, 1], )" + at_origin, {"/structure/blocks/0/size", "leave one of the two out"}},
             {kWedge, "{" + at_origin, {"/structure/blocks/0: key \"size\" is missing"}},
             {R"("a": {"kind": "cone"})", kWedgeBlock, {"/shapes/a/kind: \"cone\" is not known"}},
             {R"("a": {"kind": "box", "size": [1, 1, 0]})", kWedgeBlock, {"/shapes/a/size/2: 0 m (must be positive)"}},
             {R"("a": {"kind": "box", "size": [1, 1, 1], "radius": 1})", kWedgeBlock, {"/shapes/a/radius: unknown key"}},
             {R"("a": {"kind": "box", "size": [1, 1, 1], "scale": [1, -1, 1]})", kWedgeBlock, {"/shapes/a/scale/1: -1 (must be positive)"}},
             {R"("a": {"kind": "box", "size": [1, 1, 1], "mirror": "w"})", kWedgeBlock, {"/shapes/a/mirror", "use one of x, y, z"}},
             {R"("a": {"kind": "cylinder", "radius": 1, "height": 1, "flats": 2})", kWedgeBlock, {"/shapes/a/flats: 2 (must be from 3"}},
             {R"("a": {"kind": "prism", "outline": [[0, 0], [1, 0]], "length": 1})", kWedgeBlock, {"/shapes/a/outline: 2 corners"}},
             {R"("a": {"kind": "prism", "outline": [[0, 0], [1, 0, 0]], "length": 1})",
              kWedgeBlock,
              {"/shapes/a/outline/1: two coordinates"}},
             {R"("a": {"kind": "polyhedron", "vertices": [[0, 0, 0], [1, 0, 0], [0, 1, 0]]})",
              kWedgeBlock,
              {"/shapes/a/vertices: 3 points"}},
             {stone(R"(, "faces": [[0, 2, 4]])"), kWedgeBlock, {"/shapes/stone/faces/0/2: 4 is no vertex (they are 0 to 3)"}},
             {stone(R"(, "faces": [[0, 2]])"), kWedgeBlock, {"/shapes/stone/faces/0: 2 corners"}},
             {stone(R"(, "inertia": [[1, 0, 0], [0, 1, 0], [0, 0, 1]])"), kWedgeBlock, {"/shapes/stone/inertia", "give \"mass\" as well"}},
             {stone(R"(, "mass": 3, "centre": [0, 0, 0])"), kWedgeBlock, {"/shapes/stone/centre", "give \"inertia\" as well"}},
             {stone(R"(, "mass": 3, "inertia": [[1, 0, 0], [0.1, 1, 0], [0, 0, 1]])"),
              kWedgeBlock,
              {"/shapes/stone/inertia/1/0: 0.1 is not 0 on the other side"}},
             {stone(R"(, "mass": 3)"),
              R"({"shape": "stone", "density": 1000, )" + at_origin,
              {"/structure/blocks/0/density", "has a mass"}},
             {R"("a": {"kind": "mesh", "file": "a.obj"})", kWedgeBlock, {"/shapes/a: key \"unit\" is missing"}},
             {R"("a": {"kind": "mesh", "file": "a.obj", "unit": "kg"})", kWedgeBlock, {"/shapes/a/unit: \"kg\" is no unit of length"}},
             {R"("a": {"kind": "compound"})", kWedgeBlock, {"/shapes/a: either \"parts\" or a \"file\"", "add one of the two"}},
             {R"("a": {"kind": "compound", "parts": [{"shape": "b"}]})", kWedgeBlock, {"/shapes/a/parts/0/shape: \"b\" is not among"}},
             {R"("a": {"kind": "compound", "parts": [{"shape": "b"}]}, "b": {"kind": "compound", "parts": [{"shape": "a"}]})",
              kWedgeBlock,
              {"/shapes/a/parts/0/shape: \"b\" has \"a\" as a part of itself"}},
             {kWedge + R"(, "ball": {"kind": "sphere", "radius": 1, "voxel": 0.1})",
              kWedgeBlock + R"(, {"shape": "ball", "position": [9, 0, 1]})",
              {"/structure/blocks/1/shape: spheres and bodies of flat faces in one scene"}}}) {
        const std::string message = error_of([&] { parse_scene(make_shapes_text(c.shapes, c.block), "scene.json"); });
        check_message(message, c.parts);
    }
    check_message(error_of([&] { parse_scene(make_shapes_text(kWedge, kWedgeBlock, R"(, "contact": {"faces": "nodes"})")); }),
                  {"/structure/blocks/0/shape: \"wedge\" has no surface nodes", "leave \"faces\": \"nodes\""});
}
