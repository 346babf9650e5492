#include "lsdem/scene/measured_material.hpp"

#include <doctest/doctest.h>

#include <fstream>
#include <string>

#include "lsdem/scene/scene_error.hpp"
#include "tests/support/temporary_folder.hpp"

using namespace musim::lsdem;
using musim::tests::TemporaryFolder;

namespace {

const std::string kMaterial =
    R"({"density": 2200, "normal_stiffness": "900 MN/m", "shear_stiffness": "850 MN/m", "friction": 0.6, "restitution": 0.4})";

std::string write(const TemporaryFolder& folder, const std::string& text) {
    std::string file = (folder.path() / "stone.json").string();
    std::ofstream(file) << text;
    return file;
}

}  // namespace

TEST_CASE("a measured material is a preset, a file of its own, or a scene's") {
    const TemporaryFolder folder;
    CHECK(find_measured_material("wood").material == find_material_preset("wood").material);
    const MeasuredMaterial stone = find_measured_material(
        write(folder, R"({"schema": "musim-material/1", "block": ["50 mm", "0.1 m", "0.2 m"], "material": )" + kMaterial + "}"));
    CHECK(stone.name == "stone");
    CHECK(stone.material.density.value() == 2200.0);
    CHECK(stone.reference_block[2].value() == 0.2);
    const MeasuredMaterial scene = find_measured_material(write(
        folder, R"({"schema": "musim-scene/1", "name": "a column", "material": )" + kMaterial +
                    R"(, "structure": {"kind": "column", "layers": 2, "block": ["50 mm", "0.1 m", "0.2 m"]}, "time": {"duration": 1}})"));
    CHECK(scene.name == "a column");
    CHECK(scene.material == stone.material);
    CHECK(scene.reference_block == stone.reference_block);
}

TEST_CASE("what is no material is refused") {
    const TemporaryFolder folder;
    CHECK_THROWS_AS(find_measured_material("basalt"), SceneError);
    for (const char* text : {R"([1])", R"({"schema": "musim-material/2", "block": [1, 1, 1], "material": "wood"})",
                             R"({"schema": "musim-material/1", "block": [1, 0, 1], "material": "wood"})",
                             R"({"schema": "musim-material/1", "block": [1, 1, 1]})",
                             R"({"schema": "musim-material/1", "block": [1, 1, 1], "material": "wood", "colour": 1})"}) {
        CAPTURE(text);
        CHECK_THROWS_AS(find_measured_material(write(folder, text)), SceneError);
    }
}

TEST_CASE("presets are known by the scale of the tower they were measured for") {
    CHECK(find_material_at(0.04).name == "concrete");
    CHECK(find_material_at(1.0 / 107.0).name == "wood");
    CHECK_THROWS_AS(find_material_at(0.5), SceneError);
}
