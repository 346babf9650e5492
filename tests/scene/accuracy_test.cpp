#include <doctest/doctest.h>

#include <string>
#include <utility>
#include <vector>

#include "lsdem/model_hash.hpp"
#include "lsdem/scene/build_model.hpp"
#include "lsdem/scene/preparation.hpp"
#include "lsdem/scene/scale_scene.hpp"
#include "lsdem/scene/scene_json.hpp"
#include "lsdem/time_step.hpp"
#include "scaling/laws/law_similitude.hpp"
#include "tests/scene/made_scene.hpp"

using namespace musim;
using namespace musim::lsdem;
using namespace musim::lsdem::testing;

namespace {

Scene parse(const std::string& more) { return parse_scene(make_scene_text(kColumn, more), "dir/tower.json"); }

std::string refuse_accuracy(const std::string& more) {
    return error_of([&] { parse(more); });
}

}  // namespace

TEST_CASE("an accuracy sets the time step") {
    const std::vector<std::pair<Accuracy, double>> steps{{Accuracy::fast, 0.8}, {Accuracy::standard, 0.4}, {Accuracy::reference, 0.1}};
    for (const auto& step : steps) {
        const Accuracy accuracy = step.first;
        const double safety = step.second;
        CAPTURE(to_string(accuracy));
        const Scene scene = parse(", \"accuracy\": \"" + to_string(accuracy) + "\"");
        CHECK(find_accuracy_preset(accuracy).safety == safety);
        CHECK(scene.accuracy == accuracy);
        CHECK(scene.time.safety == safety);
        // and nothing else
        Scene plain = parse("");
        plain.accuracy = accuracy;
        plain.time.safety = safety;
        CHECK(scene == plain);
        const Model model = make_model(scene);
        CHECK(compute_time_step(scene, model).value() == safety * compute_critical_time_step(model));
        CHECK(parse_scene(write_scene(scene)) == scene);
        CHECK(scale_scene(scene, scaling::make_similitude("exact", {.length = 0.25})).accuracy == accuracy);
    }
    CHECK_FALSE(parse("").accuracy);
    CHECK(parse("").time.safety == 0.8);
    CHECK(write_scene(parse("")).find("accuracy") == std::string::npos);
}

TEST_CASE("what a scene gives itself comes before its accuracy") {
    const std::string text = R"({"schema": "musim-scene/1", "material": "wood", "accuracy": "reference", "structure": )" + kColumn +
                             R"(, "time": {"duration": "1 s", "safety": 0.5}})";
    const Scene scene = parse_scene(text);
    CHECK(scene.accuracy == Accuracy::reference);
    CHECK(scene.time.safety == 0.5);
    CHECK(parse_scene(write_scene(scene)) == scene);
}

TEST_CASE("boxes meet by their overlap unless a scene asks for nodes") {
    for (const char* faces : {"", R"(, "contact": {"faces": "overlap"})"}) {
        const Scene scene = parse(faces);
        CHECK_FALSE(scene.has_contact_nodes());
        const Model model = make_model(scene);
        CHECK(model.numerics.face_contact == FaceContact::overlap);
        CHECK(meets_by_overlap(model, model.blocks.front()));
        // corners only
        CHECK(model.shapes.front().nodes.size() == 8);
    }
    const std::string nodes = R"(, "shape": {"kind": "box", "nodes_per_face": 12}, "contact": )";
    for (const char* contact : {R"({"faces": "nodes"})", R"({"nodes": "both", "faces": "nodes"})"}) {
        const Scene scene = parse(nodes + contact);
        CHECK(scene.has_contact_nodes());
        CHECK(scene.text.remarks.empty());
        CHECK(std::get<BoxShape>(scene.shape).nodes_per_face == 12);
        const Model model = make_model(scene);
        CHECK_FALSE(meets_by_overlap(model, model.blocks.front()));
        CHECK(model.shapes.front().nodes.size() == make_box_shape({1.0, 2.0, 3.0}, make_node_lattice({1.0, 2.0, 3.0}, 12)).nodes.size());
        CHECK(write_scene(scene).find("\"nodes_per_face\": 12") != std::string::npos);
        CHECK(parse_scene(write_scene(scene)) == scene);
    }
    CHECK(parse(R"(, "shape": {"kind": "box", "level_set": "grid", "nodes_per_face": 12, "voxel": "1 mm"})").has_contact_nodes());
}

TEST_CASE("settings of nodes where there are none get one warning each and change nothing") {
    struct Case {
        std::string more;
        std::vector<std::string> places;
    };
    const std::string shape = R"(, "shape": {"kind": "box", "nodes_per_face": 9})";
    const std::vector<Case> cases{
        {"", {}},
        {R"(, "contact": {"nodes": "leader", "faces": "overlap"}, "shape": {"kind": "box"})", {}},
        {R"(, "contact": {"nodes": "both"})", {"/contact/nodes"}},
        {shape, {"/shape/nodes_per_face"}},
        {shape + R"(, "contact": {"nodes": "both"})", {"/shape/nodes_per_face", "/contact/nodes"}},
    };
    const Scene plain = parse("");
    for (const Case& c : cases) {
        CAPTURE(c.more);
        const Scene scene = parse(c.more);
        REQUIRE(scene.text.remarks.size() == c.places.size());
        for (std::size_t i = 0; i < c.places.size(); ++i) check_message(scene.text.remarks[i], {"dir/tower.json: " + c.places[i] + ": "});
        CHECK(scene == plain);
        CHECK(write_scene(scene) == write_scene(plain));
        CHECK(hash_model(make_model(scene), 1.0) == hash_model(make_model(plain), 1.0));
        // what is written has nothing to remark on
        CHECK(parse_scene(write_scene(scene)).text.remarks.empty());
    }
    CHECK(parse(shape + R"(, "contact": {"nodes": "both", "faces": "nodes"})").text.remarks.empty());
}

TEST_CASE("a bad accuracy or face is refused with its place and what is known") {
    check_message(refuse_accuracy(R"(, "accuracy": "standart")"), {"dir/tower.json: /accuracy", "standart", "\"standard\""});
    check_message(refuse_accuracy(R"(, "accuracy": 3)"), {"/accuracy", "a text is wanted"});
    check_message(refuse_accuracy(R"(, "acuracy": "fast")"), {"/acuracy: unknown key", "did you mean \"accuracy\"?"});
    check_message(refuse_accuracy(R"(, "contact": {"faces": "patches"})"), {"/contact/faces", "patches", "overlap, nodes"});
    check_message(refuse_accuracy(R"(, "contact": {"face": "overlap"})"), {"/contact/face: unknown key", "did you mean \"faces\"?"});
}
