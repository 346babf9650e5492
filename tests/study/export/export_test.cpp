#include <doctest/doctest.h>

#include <cmath>
#include <cstdint>
#include <memory>
#include <sstream>
#include <string>

#include "lsdem/export/base64.hpp"
#include "lsdem/export/gltf.hpp"
#include "lsdem/export/mesh_files.hpp"
#include "lsdem/export/surface_mesh.hpp"
#include "lsdem/solid/mass_properties.hpp"
#include "records/error.hpp"
#include "scaling/laws/law_similitude.hpp"
#include "tests/support/gltf_check.hpp"

using namespace musim::lsdem;
using musim::tests::GltfCheck;

namespace {

/// A wedge: half of a box, cut along its diagonal plane.
Solid make_exported_wedge() {
    return {{make_polyhedron({Vector3(0, 0, 0), Vector3(2, 0, 0), Vector3(2, 0, 1), Vector3(0, 3, 0), Vector3(2, 3, 0), Vector3(2, 3, 1)},
                             {{0, 1, 2}, {3, 5, 4}, {0, 3, 4, 1}, {1, 4, 5, 2}, {0, 2, 5, 3}})}};
}

/// Two boxes, one of them of another material, a wedge that moves and turns, and a ball, over `frames` frames.
ExportedBlocks make_blocks(std::size_t frames) {
    const auto box = std::make_shared<const BlockShape>(BlockShape{"", make_box_solid({1.0, 2.0, 0.5}), 0.0});
    const auto wedge = std::make_shared<const BlockShape>(BlockShape{"wedge", make_exported_wedge(), 0.0});
    const auto ball = std::make_shared<const BlockShape>(BlockShape{"ball", make_ball_facets(0.7), 0.7});
    ExportedBlocks exported{.name = "made", .blocks = {}, .frames = {}, .similitude = {}};
    const auto add = [&](const char* name, const char* material, const std::shared_ptr<const BlockShape>& shape, const Vector3& position) {
        exported.blocks.push_back({.name = name,
                                   .material = material,
                                   .shape = shape,
                                   .mass = 5.0,
                                   .layer = 1,
                                   .position = position,
                                   .orientation = Quaternion(Eigen::AngleAxisd(0.5, Vector3::UnitX()))});
    };
    add("block 0", "", box, {0.0, 0.0, 0.25});
    add("block 1", "stone", box, {3.0, 0.0, 0.25});
    add("lint el", "", wedge, {6.0, 1.0, 2.0});
    add("block 3", "", ball, {9.0, 0.0, 0.7});
    for (std::size_t k = 0; k < frames; ++k) {
        const double t = 0.25 * static_cast<double>(k);
        exported.frames.time.push_back(t);
        for (std::size_t b = 0; b < exported.blocks.size(); ++b) {
            const bool moves = b == 2;
            // a turn of more than half a circle, whose quaternion changes its sign
            const Quaternion q = moves ? Quaternion(Eigen::AngleAxisd(2.0 * t, Vector3::UnitY())) : exported.blocks[b].orientation;
            const double sign = moves && k % 2 == 1 ? -1.0 : 1.0;
            exported.frames.position.emplace_back(
                (exported.blocks[b].position + (moves ? Vector3(t, 0.0, 0.0) : Vector3::Zero())).cast<float>());
            exported.frames.quaternion.emplace_back((sign * Eigen::Vector4d(q.w(), q.x(), q.y(), q.z())).cast<float>());
        }
    }
    return exported;
}

Vector3 read_vector(const std::vector<double>& numbers) { return {numbers[0], numbers[1], numbers[2]}; }
Quaternion read_turn(const std::vector<double>& numbers) { return {numbers[3], numbers[0], numbers[1], numbers[2]}; }

/// Volume that the triangles of a mesh enclose [m³].
double find_volume(const GltfCheck& gltf, std::size_t mesh) {
    const auto& primitive = gltf.json["meshes"][mesh]["primitives"][0];
    const std::vector<double> p = gltf.read(primitive["attributes"]["POSITION"]), triangles = gltf.read(primitive["indices"]);
    const auto corner = [&](std::size_t i) {
        const auto c = static_cast<std::size_t>(triangles[i]);
        return Vector3(p[3 * c], p[3 * c + 1], p[3 * c + 2]);
    };
    double volume = 0.0;
    for (std::size_t t = 0; t < triangles.size(); t += 3) volume += corner(t).dot(corner(t + 1).cross(corner(t + 2))) / 6.0;
    return volume;
}

}  // namespace

TEST_CASE("a glTF file holds one node a block, meshes of its shapes, and the motion of what moves") {
    const ExportedBlocks exported = make_blocks(20);
    const GltfCheck gltf(make_gltf(exported, GltfForm::binary, "9.9"));
    CHECK(gltf.faults == std::vector<std::string>{});
    REQUIRE(gltf.json["nodes"].size() == 5);
    CHECK(gltf.json["nodes"][3]["name"] == "lint el");
    CHECK(gltf.json["nodes"][3]["extras"]["shape"] == "wedge");
    CHECK(gltf.json["nodes"][2]["extras"]["material"] == "stone");
    // the two boxes share their numbers, though not their material
    REQUIRE(gltf.json["meshes"].size() == 4);
    CHECK(gltf.json["meshes"][0]["primitives"][0]["attributes"] == gltf.json["meshes"][1]["primitives"][0]["attributes"]);
    CHECK(gltf.json["meshes"][0]["primitives"][0]["material"] != gltf.json["meshes"][1]["primitives"][0]["material"]);
    CHECK(gltf.json["materials"].size() == 2);
    // 1 × 2 × 0.5, and half of 2 × 3 × 1
    CHECK(find_volume(gltf, 0) == doctest::Approx(1.0).epsilon(1e-6));
    CHECK(find_volume(gltf, 2) == doctest::Approx(3.0).epsilon(1e-6));

    // only the third block moves, by translation and rotation, in the time of the run
    REQUIRE(gltf.json["animations"].size() == 1);
    const auto& channels = gltf.json["animations"][0]["channels"];
    REQUIRE(channels.size() == 2);
    for (const auto& channel : channels) CHECK(channel["target"]["node"] == 3);
    const auto& samplers = gltf.json["animations"][0]["samplers"];
    CHECK(gltf.read(samplers[0]["input"]).back() == 4.75);
    CHECK(gltf.read(samplers[0]["output"])[3 * 19] == doctest::Approx(6.0 + 4.75));
    // from one key frame to the next the shorter way: 0.25 rad apart in half angles
    const std::vector<double> turns = gltf.read(samplers[1]["output"]);
    for (std::size_t k = 4; k < turns.size(); k += 4) {
        const double cosine =
            turns[k] * turns[k - 4] + turns[k + 1] * turns[k - 3] + turns[k + 2] * turns[k - 2] + turns[k + 3] * turns[k - 1];
        CHECK(cosine == doctest::Approx(std::cos(0.25)).epsilon(1e-6));
    }
}

TEST_CASE("the root node of a glTF file turns z up into y up, right-handed") {
    const ExportedBlocks exported = make_blocks(0);
    const GltfCheck gltf(make_gltf(exported, GltfForm::binary, "9.9"));
    CHECK(gltf.faults == std::vector<std::string>{});
    CHECK_FALSE(gltf.json.contains("animations"));
    const Quaternion root = read_turn(gltf.json["nodes"][0]["rotation"]);
    CHECK((root * Vector3::UnitZ() - Vector3::UnitY()).norm() < 1e-15);
    CHECK((root * Vector3::UnitX() - Vector3::UnitX()).norm() < 1e-15);
    CHECK((root * Vector3::UnitY() + Vector3::UnitZ()).norm() < 1e-15);
    for (std::size_t b = 0; b < 4; ++b) {
        const auto& node = gltf.json["nodes"][b + 1];
        CHECK((read_vector(node["translation"]) - exported.blocks[b].position).norm() < 1e-6);
        CHECK(read_turn(node["rotation"]).isApprox(exported.blocks[b].orientation, 1e-6));
    }
}

TEST_CASE("a glTF file says how much longer the prototype's time and lengths are") {
    ExportedBlocks exported = make_blocks(3);
    exported.similitude = musim::scaling::make_similitude("exact", {.length = 1.0 / 16.0});
    const nlohmann::json extras = GltfCheck(make_gltf(exported, GltfForm::binary, "9.9")).json["asset"]["extras"];
    CHECK(extras["prototype_length_over_length"] == 16.0);
    CHECK(extras["prototype_time_over_time"] == 4.0);
    CHECK(extras["time_s"] == nlohmann::json{0.0, 0.5});
    CHECK(extras["prototype_time_s"] == nlohmann::json{0.0, 2.0});
}

TEST_CASE("a .gltf has the numbers of the .glb in it as base64") {
    const ExportedBlocks exported = make_blocks(3);
    const GltfCheck binary(make_gltf(exported, GltfForm::binary, "9.9"));
    nlohmann::json text = nlohmann::json::parse(make_gltf(exported, GltfForm::embedded, "9.9"));
    const std::string uri = text["buffers"][0]["uri"];
    const std::size_t length = text["buffers"][0]["byteLength"];
    CHECK(uri == "data:application/octet-stream;base64," + encode_base64(binary.buffer.substr(0, length)));
    text["buffers"][0].erase("uri");
    CHECK(text == binary.json);
}

TEST_CASE("frames that are no poses are refused") {
    ExportedBlocks exported = make_blocks(3);
    exported.frames.position[5].x() = std::nanf("");
    CHECK_THROWS_WITH_AS(make_gltf(exported, GltfForm::binary, "9.9"), doctest::Contains("the frames of block 1 are no poses"),
                         musim::records::WriteError);
}

TEST_CASE("an OBJ file holds each block as a closed object") {
    const ExportedBlocks exported = make_blocks(0);
    std::istringstream text(make_obj(exported));
    std::string word, names;
    std::vector<Vector3> corners;
    std::vector<double> volumes;
    for (std::string line; std::getline(text, line);) {
        std::istringstream words(line);
        words >> word;
        if (word == "o") {
            words >> word;
            names += word + " ";
            volumes.push_back(0.0);
        } else if (word == "v") {
            Vector3 place;
            words >> place.x() >> place.y() >> place.z();
            corners.push_back(place);
        } else if (word == "f") {
            std::vector<std::size_t> face;
            for (std::size_t corner = 0; words >> corner;) face.push_back(corner - 1);
            for (std::size_t i = 1; i + 1 < face.size(); ++i) {
                volumes.back() += corners.at(face[0]).dot(corners.at(face[i]).cross(corners.at(face[i + 1]))) / 6.0;
            }
        }
    }
    CHECK(names == "block_0 block_1 lint_el block_3 ");
    REQUIRE(volumes.size() == 4);
    CHECK(volumes[1] == doctest::Approx(1.0).epsilon(1e-12));
    CHECK(volumes[2] == doctest::Approx(3.0).epsilon(1e-12));
    CHECK(volumes[3] == doctest::Approx(compute_mass_properties(exported.blocks[3].shape->solid).volume).epsilon(1e-12));
    // eight corners of each box, six of the wedge, and those of 320 triangles of which five or six meet in each: 320/2 + 2
    CHECK(corners.size() == 8 + 8 + 6 + 162);
}

TEST_CASE("an STL file holds as many triangles as it says") {
    const std::string stl = make_stl(make_blocks(0));
    std::uint32_t count = 0;
    std::memcpy(&count, stl.data() + 80, sizeof(count));
    CHECK(count == 12 + 12 + 8 + 320);
    CHECK(stl.size() == 84 + 50 * count);
    CHECK_FALSE(stl.starts_with("solid"));
}

TEST_CASE("facets of a ball have their corners on it, and nearly its volume") {
    const Solid ball = make_ball_facets(2.0);
    for (const Vector3& corner : ball.pieces.front().corners) CHECK(corner.norm() == doctest::Approx(2.0).epsilon(1e-14));
    // flat triangles of edges up to 0.33 of the radius lie inside by (edge/√3)²/2 of it at most
    const double volume = compute_mass_properties(ball).volume, round = 4.0 / 3.0 * 3.14159265358979 * 8.0;
    CHECK(volume < round);
    CHECK(volume > 0.945 * round);
}
