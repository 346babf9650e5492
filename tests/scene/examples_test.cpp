#include <doctest/doctest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <valijson/adapters/nlohmann_json_adapter.hpp>
#include <valijson/schema.hpp>
#include <valijson/schema_parser.hpp>
#include <valijson/validator.hpp>

#include "lsdem/scene/build_model.hpp"
#include "lsdem/scene/new_scene.hpp"
#include "lsdem/scene/scene_json.hpp"
#include "tests/scene/made_scene.hpp"
#include "tests/support/temporary_folder.hpp"

using namespace musim::lsdem;
using namespace musim::lsdem::testing;
using nlohmann::json;

namespace {

const std::filesystem::path kRoot = MUSIM_SOURCE_DIR;

json read_json(const std::filesystem::path& path) {
    std::ifstream file(path);
    REQUIRE(file);
    return json::parse(file);
}

json read_schema() { return read_json(kRoot / "lsdem" / "scene" / "musim-scene-1.schema.json"); }

bool validates(const json& document, const json& text = read_schema()) {
    valijson::Schema schema;
    valijson::SchemaParser parser;
    parser.populateSchema(valijson::adapters::NlohmannJsonAdapter(text), schema);
    valijson::Validator validator;
    return validator.validate(schema, valijson::adapters::NlohmannJsonAdapter(document), nullptr);
}

/// Scenes; examples/pi holds problems of the Pi theorem.
std::vector<std::filesystem::path> list_examples() {
    std::vector<std::filesystem::path> files;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(kRoot / "examples")) {
        if (entry.path().extension() != ".json") continue;
        const auto document = nlohmann::json::parse(musim::tests::bytes_of(entry.path()));
        if (document.value("schema", "").starts_with("musim-scene/")) files.push_back(entry.path());
    }
    std::sort(files.begin(), files.end());
    return files;
}

/// Whether the scene needs a file that is not shipped.
bool has_record(const Scene& scene) { return std::holds_alternative<RecordMotion>(scene.base_motion.source); }

}  // namespace

TEST_CASE("a new scene of every kind and material and length obeys the schema and can be built") {
    for (const std::string& kind : new_scene_kinds()) {
        for (const std::string& material : material_preset_names()) {
            for (const std::optional<double> length : {std::optional<double>(), std::optional(1.0), std::optional(1.0 / 25.0)}) {
                CAPTURE(kind);
                CAPTURE(material);
                NewScene wanted{.kind = kind, .material = find_material_preset(material), .length = length, .layers = 3};
                if (kind == "mesh") wanted.mesh = MeshForm{.file = kRoot / "examples" / "boulder.obj", .unit = "m", .part = {}};
                const Scene made = make_new_scene(wanted);
                const std::string text = write_readable_scene(made, comment_new_scene(wanted, made));
                const json written = json::parse(text);
                CHECK(validates(written));
                const char* const motion = tilts(made) ? "/tilt" : "/base_motion";
                for (const char* const part : {"", "/material", "/structure", motion, "/time", "/output"}) {
                    CHECK(written.at(json::json_pointer(part)).contains("comment"));
                }
                const Scene scene = parse_scene(text);
                CHECK(scene.text.plain_number.empty());
                CHECK(scene.text.remarks.empty());
                CHECK(scene.name == made.name);
                // written to seven digits
                CHECK(scene.time.duration.value() == doctest::Approx(made.time.duration.value()).epsilon(1e-6));
                CHECK(scene.material.normal_stiffness.value() == doctest::Approx(made.material.normal_stiffness.value()).epsilon(1e-6));
                CHECK(make_model(scene).blocks.size() == make_model(made).blocks.size());
            }
        }
    }
}

TEST_CASE("a readable scene leaves defaults out and means the same") {
    const NewScene wanted{.kind = "tower"};
    const Scene made = make_new_scene(wanted);
    const json text = json::parse(write_readable_scene(made, {.kept = {"/structure/seed", "/gravity"}}));
    CHECK_FALSE(text.contains("comment"));
    CHECK_FALSE(text.contains("contact"));
    CHECK_FALSE(text["structure"].contains("height_deviation"));
    CHECK(text["structure"]["seed"] == 1);
    CHECK(text["structure"]["tiling"] == "ring_14");
    CHECK(text["gravity"][2] == "-1 g");
    Scene changed = made;
    std::get<Tower>(changed.structure).tiling.inner_radius = 0.5;
    changed.contact_nodes = ContactNodes::both;
    changed.face_contact = FaceContact::nodes;
    const Scene read = parse_scene(write_readable_scene(changed, {}));
    CHECK(std::get<Tower>(read.structure).tiling == std::get<Tower>(changed.structure).tiling);
    CHECK(read.contact_nodes == ContactNodes::both);
    CHECK(read.face_contact == FaceContact::nodes);
}

TEST_CASE("a record below the folder of a readable scene is named as seen from there") {
    const NewScene wanted{.kind = "column"};
    Scene scene = make_new_scene(wanted);
    RecordMotion record;
    record.file = "/lab/scenes/records/a.v1";
    record.components[0] = "360";
    record.sensitivity = 214000.0;
    record.station_xml = "/lab/scenes/records/a.xml";
    record.scale = find_scale(wanted);
    scene.base_motion.source = record;
    const auto motion_in = [&](const char* folder) { return json::parse(write_readable_scene(scene, {.folder = folder}))["base_motion"]; };
    CHECK(motion_in("/lab/scenes")["record"] == "records/a.v1");
    CHECK(motion_in("/lab/scenes")["station_xml"] == "records/a.xml");
    CHECK(motion_in("/lab/other")["record"] == "/lab/scenes/records/a.v1");
    CHECK(motion_in("/lab")["scale"]["length"] == "1/107");
    const std::string text = write_readable_scene(scene, {.folder = "/lab"});
    CHECK(parse_scene(text, "/lab/column.json").base_motion.source == scene.base_motion.source);
}

TEST_CASE("every quantity in the example scenes carries its unit") {
    for (const auto& file : list_examples()) {
        CAPTURE(file.string());
        CHECK(read_scene(file).text.plain_number.empty());
    }
}

TEST_CASE("every example obeys the schema, is read, and comes back from its own text") {
    REQUIRE(list_examples().size() >= 5);
    for (const auto& file : list_examples()) {
        CAPTURE(file.string());
        CHECK(validates(read_json(file)));
        const Scene scene = read_scene(file);
        const std::string written = write_scene(scene);
        CHECK(validates(json::parse(written)));
        CHECK(parse_scene(written) == scene);
        // nothing that is idle, no old name
        CHECK(scene.text.remarks.empty());
        CHECK_FALSE(scene.name.empty());
    }
}

TEST_CASE("every shipped law obeys its schema, which refuses other keys") {
    const json schema = read_json(kRoot / "scaling" / "musim-law-1.schema.json");
    int laws = 0;
    for (const auto& entry : std::filesystem::directory_iterator(kRoot / "scaling" / "laws")) {
        if (entry.path().extension() != ".json") continue;
        CAPTURE(entry.path().string());
        const json law = read_json(entry.path());
        CHECK(validates(law, schema));
        for (const char* list : {"", "/quantities/0", "/chosen/0"}) {
            const json::json_pointer place(list);
            if (!law.contains(place)) continue;
            json other = law;
            other[place]["other"] = "key";
            CHECK_FALSE(validates(other, schema));
        }
        ++laws;
    }
    CHECK(laws >= 15);
}

TEST_CASE("every example without a record is built") {
    int built = 0;
    for (const auto& file : list_examples()) {
        CAPTURE(file.string());
        const Scene scene = read_scene(file);
        if (has_record(scene)) continue;
        CHECK_FALSE(make_model(scene).blocks.empty());
        ++built;
    }
    CHECK(built >= 4);
}

TEST_CASE("the demonstration tower is the same concrete as at 1:25 and has at least 500 blocks") {
    const Scene scene = read_scene(kRoot / "examples" / "tower_prototype.json");
    const Tower& tower = std::get<Tower>(scene.structure);
    CHECK(tower.layers == 38);
    CHECK(make_model(scene).blocks.size() >= 500);
    const BlockMaterial concrete = fit_to_block(find_material_preset("concrete"), tower.block);
    CHECK(scene.material.density == concrete.density);
    CHECK(scene.material.normal_stiffness.value() == doctest::Approx(concrete.normal_stiffness.value()).epsilon(1e-14));
    CHECK(scene.material.shear_stiffness.value() == doctest::Approx(concrete.shear_stiffness.value()).epsilon(1e-14));
    CHECK(scene.material.friction == concrete.friction);
    CHECK(scene.material.restitution == concrete.restitution);
}

TEST_CASE("the schema refuses keys that the parser does not know") {
    const json definitions = read_schema().at("definitions");
    for (const auto& entry : scene_keys()) {
        const std::string& kind = entry.first;
        CAPTURE(kind);
        CHECK(definitions.at(kind).at("additionalProperties") == false);
    }
    CHECK(scene_keys().at("time") == std::vector<std::string>{"duration", "step", "safety", "comment"});
}

TEST_CASE("the schema knows the presets that the parser knows") {
    const json definitions = read_schema().at("definitions");
    CHECK(definitions.at("material_choice").at("oneOf").at(0).at("enum") == json(material_preset_names()));
    CHECK(definitions.at("tower").at("properties").at("tiling").at("oneOf").at(0).at("enum") == json(tiling_preset_names()));
}

TEST_CASE("the schema refuses what the parser refuses") {
    const json good = json::parse(make_scene_text(kTower, kRicker));
    REQUIRE(validates(good));
    for (const char* patch : {R"([{"op": "add", "path": "/colour", "value": 1}])", R"([{"op": "remove", "path": "/material"}])",
                              R"([{"op": "replace", "path": "/structure/kind", "value": "pyramid"}])",
                              R"([{"op": "replace", "path": "/structure/layers", "value": 1.5}])",
                              R"([{"op": "replace", "path": "/structure/tiling", "value": "ring_13"}])",
                              R"([{"op": "replace", "path": "/base_motion/signal", "value": "sine"}])",
                              R"([{"op": "replace", "path": "/material", "value": "basalt"}])",
                              R"([{"op": "replace", "path": "/time", "value": {"step": "auto"}}])"}) {
        CAPTURE(patch);
        const json bad = good.patch(json::parse(patch));
        CHECK_FALSE(validates(bad));
        CHECK_THROWS_AS(parse_scene(bad.dump()), SceneError);
    }
}
