#include <doctest/doctest.h>

#include <string>

#include "lsdem/scene/build_model.hpp"
#include "lsdem/scene/scale_scene.hpp"
#include "lsdem/scene/scene_json.hpp"
#include "tests/scene/made_scene.hpp"

using namespace musim;
using namespace musim::lsdem;
using namespace musim::lsdem::scene;
using namespace musim::lsdem::scene::testing;

namespace {

Scene parse(const std::string& more) { return parse_scene(make_scene_text(kColumn, more), "dir/tower.json"); }

std::string refuse(const std::string& more) {
    return error_of([&] { parse(more); });
}

}  // namespace

TEST_CASE("an accuracy sets nodes, faces, spacing and time step") {
    for (const Accuracy accuracy : {Accuracy::fast, Accuracy::standard, Accuracy::reference}) {
        CAPTURE(to_string(accuracy));
        const Scene scene = parse(", \"accuracy\": \"" + to_string(accuracy) + "\"");
        const AccuracyPreset& preset = find_accuracy_preset(accuracy);
        CHECK(scene.accuracy == accuracy);
        CHECK(std::get<BoxShape>(scene.shape).nodes_per_face == preset.nodes_per_face);
        CHECK(scene.face_contact == preset.faces);
        CHECK(scene.patch_spacing == preset.spacing);
        CHECK(scene.time.safety == preset.safety);
        CHECK(parse_scene(write_scene(scene)) == scene);
        CHECK(scale_scene(scene, scaling::Similitude({.length = 0.25}, scaling::Law::exact)).accuracy == accuracy);
    }
    CHECK_FALSE(parse("").accuracy);
    CHECK(write_scene(parse("")).find("accuracy") == std::string::npos);
}

TEST_CASE("what a scene gives itself comes before its accuracy") {
    const std::string text = R"({"schema": "musim-scene/1", "material": "wood", "accuracy": "reference", "structure": )" + kColumn +
                             R"(, "shape": {"kind": "box", "nodes_per_face": 12}, "contact": {"faces": "nodes", "spacing": "even"},
                                "time": {"duration": "1 s", "safety": 0.5}})";
    const Scene scene = parse_scene(text);
    CHECK(std::get<BoxShape>(scene.shape).nodes_per_face == 12);
    CHECK(scene.face_contact == FaceContact::nodes);
    CHECK(scene.patch_spacing == PatchSpacing::even);
    CHECK(scene.time.safety == 0.5);
    CHECK(parse_scene(write_scene(scene)) == scene);
    // a shape without a number of nodes takes the accuracy's, as a grid does
    const int nodes = find_accuracy_preset(Accuracy::fast).nodes_per_face;
    CHECK(std::get<BoxShape>(parse(R"(, "accuracy": "fast", "shape": {"kind": "box"})").shape).nodes_per_face == nodes);
    const Scene grid = parse(R"(, "accuracy": "fast", "shape": {"kind": "box", "level_set": "grid", "voxel": "1 mm"})");
    CHECK(std::get<GridShape>(grid.shape).nodes_per_face == nodes);
}

TEST_CASE("the nodes of an accuracy fit faces from square to one by five") {
    for (const Accuracy accuracy : {Accuracy::fast, Accuracy::standard, Accuracy::reference})
        for (const double aspect : {1.0, 1.5, 2.07, 3.0, 5.0})
            CHECK_NOTHROW(make_node_lattice({1.0, aspect, 1.0}, find_accuracy_preset(accuracy).nodes_per_face));
}

TEST_CASE("the choice of faces and spacing reaches the model") {
    const Model patches = make_model(parse(R"(, "contact": {"faces": "patch", "spacing": "lobatto"})"));
    CHECK(patches.face_contact == FaceContact::patch);
    CHECK(patches.shapes.front().patch_spacing == PatchSpacing::lobatto);
    const Model nodes = make_model(parse(R"(, "contact": {"faces": "nodes", "spacing": "even"})"));
    CHECK(nodes.face_contact == FaceContact::nodes);
    CHECK(nodes.shapes.front().patch_spacing == PatchSpacing::even);
    const Scene by_overlap = parse(R"(, "contact": {"faces": "overlap"})");
    CHECK(make_model(by_overlap).face_contact == FaceContact::overlap);
    CHECK(parse_scene(write_scene(by_overlap)) == by_overlap);
}

TEST_CASE("a bad accuracy or face is refused with its place and what is known") {
    check_message(refuse(R"(, "accuracy": "standart")"), {"dir/tower.json: /accuracy", "standart", "\"standard\""});
    check_message(refuse(R"(, "accuracy": 3)"), {"/accuracy", "a text is wanted"});
    check_message(refuse(R"(, "acuracy": "fast")"), {"/acuracy: unknown key", "did you mean \"accuracy\"?"});
    check_message(refuse(R"(, "contact": {"faces": "patches"})"), {"/contact/faces", "patches", "patch"});
    check_message(refuse(R"(, "contact": {"spacing": "fine"})"), {"/contact/spacing", "even"});
    check_message(refuse(R"(, "contact": {"face": "patch"})"), {"/contact/face: unknown key", "did you mean \"faces\"?"});
}
