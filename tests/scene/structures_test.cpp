#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <string>
#include <vector>

#include "lsdem/scene/as_listed.hpp"
#include "lsdem/scene/build_model.hpp"
#include "lsdem/scene/named_shape.hpp"
#include "lsdem/scene/reference_block.hpp"
#include "lsdem/scene/scale_scene.hpp"
#include "lsdem/solid/solid.hpp"
#include "scaling/laws/law_similitude.hpp"
#include "tests/scene/made_scene.hpp"

using namespace musim;
using namespace musim::lsdem;
using namespace musim::lsdem::testing;

namespace {

const std::string kArch =
    R"("kind": "arch", "radius": "1 m", "thickness": "0.15 m", "depth": "0.3 m", "embrace": "157.5 deg", "voussoirs": 7)";
const std::string kShapes = R"(, "shapes": {"plinth": {"kind": "box", "size": ["1 m", "1 m", "0.3 m"]},
    "drum": {"kind": "cylinder", "radius": "0.4 m", "height": "0.8 m"},
    "ball": {"kind": "sphere", "radius": "0.1 m", "voxel": "0.01 m"}})";
const std::string kDrums = R"("kind": "column", "blocks": ["plinth", "drum", "drum"])";

std::string make_several(const std::string& structures, const std::string& more = "") {
    return R"({"schema": "musim-scene/1", "name": "test", "material": "wood", "structures": [)" + structures + "]" + more +
           R"(, "time": {"duration": "1 s"}})";
}

std::vector<BlockEntry> list_blocks(const std::string& text, const std::string& origin = "") {
    return std::get<BlockList>(as_listed(parse_scene(text, origin)).structure).blocks;
}

/// Corners of a block of a model, in the world [m].
std::vector<Vector3> find_corners(const Model& model, std::size_t b) {
    const Block& block = model.blocks[b];
    std::vector<Vector3> corners;
    for (const Polyhedron& piece : model.shapes[block.shape].solid->pieces) {
        for (const Vector3& x : piece.corners) corners.push_back(block.position + block.orientation * x);
    }
    return corners;
}

/// Number of corners that two blocks share to within a distance [m].
int count_common(const Model& model, std::size_t a, std::size_t b, double within) {
    const std::vector<Vector3> of_b = find_corners(model, b);
    int common = 0;
    for (const Vector3& x : find_corners(model, a)) {
        common += std::any_of(of_b.begin(), of_b.end(), [&](const Vector3& y) { return (x - y).norm() <= within; }) ? 1 : 0;
    }
    return common;
}

/// A table beside a scene, for as long as this lives.
struct TableFile {
    std::filesystem::path folder = std::filesystem::temp_directory_path() / "musim_structures_test";
    explicit TableFile(const std::string& text) {
        std::filesystem::create_directories(folder);
        std::ofstream(folder / "blocks.csv") << text;
    }
    ~TableFile() { std::filesystem::remove_all(folder); }
    std::string scene() const { return (folder / "scene.json").string(); }
};

const std::string kTable = make_scene_text(R"({"kind": "blocks", "file": "blocks.csv"})", kShapes);

}  // namespace

TEST_CASE("voussoirs of an arch share the corners of their joints and have the volume of its polygon") {
    const Scene scene = parse_scene(make_scene_text("{" + kArch + "}"));
    const BuiltModel built = build_model(scene);
    const Model& model = built.model;
    REQUIRE(model.blocks.size() == 9);
    // corners are rotated points of a circle of about a metre: a few roundings
    constexpr double kRounding = 1e-14;
    for (std::size_t k = 0; k + 1 < 7; ++k) CHECK(count_common(model, k, k + 1, kRounding) == 4);
    CHECK(count_common(model, 0, 7, kRounding) == 4);
    CHECK(count_common(model, 6, 8, kRounding) == 4);
    CHECK(built.structure.name[2] == "voussoir 3");
    CHECK(built.structure.name[8] == "abutment 2");

    // a trapezoid between chords of two circles has the area sin(δ)/2 (R_o² - R_i²)
    const double part = 157.5 / 7.0 * std::numbers::pi / 180.0;
    const double volume = 0.3 * 0.5 * std::sin(part) * (1.075 * 1.075 - 0.925 * 0.925);
    for (std::size_t k = 0; k < 7; ++k) {
        CHECK(model.shapes[model.blocks[k].shape].volume == doctest::Approx(volume).epsilon(1e-13));
        CHECK_FALSE(model.blocks[k].fixed);
    }
    // its joint is the base that stiffnesses are of
    CHECK(reference_area(scene).value() == doctest::Approx(0.15 * 0.3).epsilon(0.02));
    for (const std::size_t k : {7U, 8U}) {
        CHECK(model.blocks[k].fixed);
        CHECK(model.blocks[k].with_base);
    }
    // the abutments stand on the ground, the lower edge of the springings is a thickness above it
    double low = 1.0, springing = 1.0;
    for (const Vector3& x : find_corners(model, 7)) low = std::min(low, x.z());
    for (const Vector3& x : find_corners(model, 0)) springing = std::min(springing, x.z());
    CHECK(low == doctest::Approx(0.0).epsilon(kRounding));
    CHECK(springing == doctest::Approx(0.15).epsilon(kRounding));
    // mirror images: equal heights
    CHECK(model.blocks[0].position.z() == doctest::Approx(model.blocks[6].position.z()).epsilon(kRounding));
    CHECK(model.blocks[0].position.x() == doctest::Approx(-model.blocks[6].position.x()).epsilon(kRounding));
}

TEST_CASE("an arch of half a circle without abutments stands on the ground") {
    const Model model = make_model(parse_scene(make_scene_text(
        R"({"kind": "arch", "radius": "2 m", "thickness": "0.4 m", "depth": "1 m", "embrace": "180 deg", "voussoirs": 9, "abutments": false})")));
    REQUIRE(model.blocks.size() == 9);
    for (const std::size_t b : {0U, 8U}) {
        int on_ground = 0;
        for (const Vector3& x : find_corners(model, b)) on_ground += std::abs(x.z()) < 1e-14 ? 1 : 0;
        CHECK(on_ground == 4);
    }
}

TEST_CASE("shapes of a column stand one on the other") {
    const std::vector<BlockEntry> blocks = list_blocks(make_scene_text("{" + kDrums + "}", kShapes));
    REQUIRE(blocks.size() == 3);
    CHECK(blocks[0].position[2].value() == doctest::Approx(0.15).epsilon(1e-15));
    CHECK(blocks[1].position[2].value() == doctest::Approx(0.7).epsilon(1e-15));
    CHECK(blocks[2].position[2].value() == doctest::Approx(1.5).epsilon(1e-15));
    CHECK(blocks[0].name == "plinth");
    CHECK(blocks[1].name == "drum 1");
    CHECK(blocks[2].name == "drum 2");
}

TEST_CASE("a structure that is turned and placed is its list, turned and placed") {
    const std::string column = R"({"kind": "column", "layers": 2, "block": ["0.1 m", "0.2 m", "0.4 m"])";
    const std::vector<BlockEntry> blocks =
        list_blocks(make_several(column + R"(, "name": "left", "place": ["1 m", "2 m", "0 m"], "turn": "90 deg"},
        {"kind": "blocks", "name": "right", "turn": "-90 deg", "blocks": [
            {"size": ["0.1 m", "0.2 m", "0.4 m"], "position": ["3 m", "0 m", "0.2 m"], "velocity": ["1 m/s", 0, 0], "name": "last"}]},
        {)" + kArch + R"(, "name": "arch", "place": ["0 m", "8 m", "0 m"]})"));
    REQUIRE(blocks.size() == 12);
    CHECK(blocks[0].name == "left 0");
    CHECK(blocks[1].position[0].value() == 1.0);
    CHECK(blocks[1].position[1].value() == 2.0);
    CHECK(blocks[1].position[2].value() == doctest::Approx(0.6).epsilon(1e-15));
    CHECK(blocks[1].quaternion == std::array{1.0, 0.0, 0.0, 1.0});
    CHECK(blocks[2].name == "right last");
    CHECK(blocks[2].position[0].value() == 0.0);
    CHECK(blocks[2].position[1].value() == -3.0);
    CHECK(blocks[2].velocity[1].value() == -1.0);
    CHECK(blocks[2].quaternion == std::array{1.0, 0.0, 0.0, -1.0});
    CHECK(blocks[5].name == "arch voussoir 3");
    CHECK(blocks[5].position[1].value() == 8.0);
}

TEST_CASE("arches, columns of shapes and several structures come back from what is written of them, and scale") {
    const std::string several = make_several("{" + kArch + R"(, "name": "a", "turn": "30 deg"}, {)" + kDrums +
                                                 R"(, "place": ["5 m", 0, 0]}, {"kind": "tower", "layers": 2, "tiling": "ring_14",
        "block": ["12.710 mm", "26.355 mm", "39.780 mm"], "place": ["9 m", 0, 0]})",
                                             kShapes);
    for (const std::string& text : {make_scene_text("{" + kArch + "}"), make_scene_text("{" + kDrums + "}", kShapes), several}) {
        const Scene scene = parse_scene(text);
        CHECK(parse_scene(write_scene(scene)) == scene);
        const Model full = make_model(scene);
        const Model small = make_model(scale_scene(scene, scaling::make_similitude("mu", {.length = 1.0 / 64.0})));
        REQUIRE(small.blocks.size() == full.blocks.size());
        for (std::size_t b = 0; b < full.blocks.size(); ++b) {
            CHECK(small.blocks[b].position == full.blocks[b].position / 64.0);
            CHECK(small.blocks[b].orientation.coeffs() == full.blocks[b].orientation.coeffs());
        }
    }
}

TEST_CASE("a table of blocks is the list of them") {
    const TableFile table(
        "# two blocks\n"
        "shape; size_x [mm]; size_y [mm]; size_z [mm]; x [m]; y [m]; z [m]; turn [deg]; density [g/cm^3]; fixed; name\r\n"
        "; 100; 200; 300; 0; 0; 0.15; 90; ; true; \"the \"\"base\"\"\"\n"
        "\n"
        "drum; ; ; ; 1; 2.5; 0.4; ; 2.4; 0;\n");
    std::string scene = kTable;
    // quotes are for no name: the name is refused, the cell is read
    check_message(error_of([&] { parse_scene(scene, table.scene()); }), {"/structure/blocks/0/name", "quote"});
    const TableFile plain(
        "shape,size_x,size_y,size_z,x [m],y [m],z [m],turn [deg],density [g/cm^3],fixed,name\n"
        ",100,200,300,0,0,0.15,90,,true,base block\n"
        "drum,,,,1,2.5,0.4,,2.4,0,\n");
    const Scene read = parse_scene(make_scene_text(R"({"kind": "blocks", "file": "blocks.csv", "unit": "mm"})", kShapes), plain.scene());
    const Scene listed = parse_scene(make_scene_text(R"({"kind": "blocks", "blocks": [
        {"size": ["100 mm", "200 mm", "300 mm"], "position": ["0 m", "0 m", "0.15 m"], "quaternion": [1, 0, 0, 1], "fixed": true, "name": "base block"},
        {"shape": "drum", "position": ["1 m", "2.5 m", "0.4 m"], "density": "2.4 g/cm^3"}]})",
                                                     kShapes));
    CHECK(read == listed);
}

TEST_CASE("a table says in which line and column it is wrong") {
    const auto error = [](const std::string& text) {
        const TableFile table(text);
        return error_of([&] { parse_scene(kTable, table.scene()); });
    };
    check_message(error("shape,x [m],y [m],z [m]\ndrum,0,0,0.4\ndrum,1,zero,0.4\n"),
                  {"blocks.csv:3: column 3 (\"y\")", "\"zero\" is no number"});
    check_message(error("shape,x [m],y [m]\ndrum,0,0\n"), {"blocks.csv:1", "\"z\" is missing"});
    check_message(error("shape,x,y,z\ndrum,0,0,0.4\n"), {"blocks.csv:1", "has no unit", "x [m]"});
    check_message(error("shape,x [m],y [m],z [m],colour\ndrum,0,0,0.4,red\n"), {"blocks.csv:1", "\"colour\" is not known"});
    check_message(error("shape,x [m],y [m],z [m]\ndrum,0,0\n"), {"blocks.csv:2", "3 cells, but 4 columns"});
    check_message(error("x [m],y [m],z [m]\n0,0,0.4\n"), {"blocks.csv:2", "size"});
    check_message(error("shape,x [m],y [m],z [m],fixed\ndrum,0,0,0.4,maybe\n"), {"blocks.csv:2: column 5", "neither true nor false"});
    check_message(error("shape,x [m],y [m],z [m]\n"), {"blocks.csv", "no block"});
}

TEST_CASE("structures that cannot be built say where and why") {
    const auto error = [](const std::string& text) { return error_of([&] { make_model(parse_scene(text)); }); };
    const auto arch = [&](const std::string& key, const std::string& value) {
        std::string text = kArch;
        const std::size_t at = text.find(key) + key.size() + 3;
        text.replace(at, text.find_first_of(",}", at) == std::string::npos ? std::string::npos : text.find(',', at) - at, value);
        return error(make_scene_text("{" + text + "}"));
    };
    check_message(arch("embrace", "\"361 deg\""), {"/structure/embrace", "360 deg"});
    check_message(arch("voussoirs", "0"), {"/structure/voussoirs"});
    check_message(arch("voussoirs", "0.5"), {"/structure/voussoirs"});
    check_message(arch("thickness", "\"2.5 m\""), {"/structure/thickness"});
    check_message(arch("radius", "\"-1 m\""), {"/structure/radius"});
    check_message(error(make_scene_text(R"({"kind": "column", "blocks": ["plinth", "drm"]})", kShapes)),
                  {"/structure/blocks/1", "\"drm\" is not among", "drum"});
    check_message(error(make_scene_text(R"({"kind": "column", "blocks": []})", kShapes)), {"/structure/blocks", "no block"});
    check_message(error(make_scene_text(R"({"kind": "column", "blocks": ["ball"]})", kShapes)), {"/structure/blocks/0", "sphere"});
    check_message(error(make_several("{" + kDrums + R"(, "name": "a"}, {)" + kDrums + R"(, "name": "a"})", kShapes)),
                  {"/structures/1/name", "\"a\""});
    check_message(
        error(make_several("{" + kDrums + R"(, "name": "a"}, {)" + kDrums + R"(, "name": "b", "place": ["0.9 m", 0, 0]})", kShapes)),
        {"\"a plinth\"", "\"b plinth\"", "overlap by 100 mm"});
    check_message(error(make_several("{" + kDrums + R"(}, {"kind": "arch"})", kShapes)), {"/structures/1", "radius"});
    check_message(error(R"({"schema": "musim-scene/1", "material": "wood", "structures": [], "time": {"duration": "1 s"}})"),
                  {"/structures", "at least one"});
}

TEST_CASE("a tower of a named shape has its layers, and keys that do not fit are named with their layer") {
    const std::string keyed = R"(, "shapes": {"body": {"kind": "box", "size": ["54 mm", "113 mm", "170 mm"]},
        "key": {"kind": "box", "size": ["20 mm", "20 mm", "18 mm"]},
        "keyed": {"kind": "compound", "parts": [{"shape": "body"}, {"shape": "key", "position": ["0 mm", "0 mm", "94 mm"]}]}})";
    const auto tower = [&](const std::string& shape, const std::string& layers) {
        return make_scene_text(R"({"kind": "tower", "layers": )" + layers + R"(, "block": ["54 mm", "113 mm", "170 mm"], "pitch": "57.5 mm",
            "tiling": "ring_14", "shape": ")" +
                                   shape + "\"}",
                               keyed);
    };
    const BuiltModel boxes = build_model(parse_scene(tower("body", "3")));
    CHECK(boxes.structure.layer.back() == 3);
    CHECK(boxes.structure.name.empty());
    const BuiltModel one = build_model(parse_scene(tower("keyed", "1")));
    CHECK(one.model.shapes.front().solid != nullptr);
    const Scene scene = parse_scene(tower("keyed", "2"));
    CHECK(parse_scene(write_scene(scene)) == scene);
    check_message(error_of([&] { build_model(scene); }), {"(layer 1)", "(layer 2)", "overlap by"});
    check_message(error_of([&] { parse_scene(tower("keyd", "2")); }), {"/structure/shape", "keyed"});
}
