#include "lsdem/study/second_scene.hpp"

#include <doctest/doctest.h>

#include <functional>
#include <string>
#include <vector>

#include "lsdem/run/run.hpp"
#include "lsdem/scene/scene_error.hpp"
#include "lsdem/scene/scene_json.hpp"
#include "lsdem/study/pair_scene.hpp"
#include "lsdem/study/pair_text.hpp"
#include "tests/study/pushed_wall.hpp"

using namespace musim::lsdem;
using musim::lsdem::tests::make_pushed_wall;
namespace si = musim::scaling::si;
using musim::scaling::Length;

namespace {

/// Two stacks of two blocks of unequal height under one across them, pushed at once.
Scene make_gate() {
    return parse_scene(R"({"schema": "musim-scene/1", "name": "gate", "material": "concrete", "structure": {"kind": "blocks", "blocks": [
        {"size": ["150 mm", "60 mm", "100.1 mm"], "position": ["-100 mm", 0, "50.05 mm"]},
        {"size": ["150 mm", "60 mm", "99.8 mm"], "position": ["100 mm", 0, "49.9 mm"]},
        {"size": ["150 mm", "60 mm", "99.9 mm"], "position": ["-100 mm", 0, "150.05 mm"]},
        {"size": ["150 mm", "60 mm", "100.2 mm"], "position": ["100 mm", 0, "149.9 mm"]},
        {"size": ["350 mm", "60 mm", "60 mm"], "position": [0, 0, "230 mm"]}]},
        "base_motion": {"signal": "half_sine", "direction": "x", "amplitude": "1.5 g", "duration": "0.06 s"},
        "time": {"duration": "0.1 s"}, "output": {"spine_rate": "500 Hz"}})");
}

BlockEntry& block(Scene& scene, std::size_t index) { return std::get<BlockList>(scene.structure).blocks.at(index); }

struct Change {
    std::string what;
    std::function<void(Scene&)> make;
};

ScenePair run_two(const Scene& first, const Scene& second, std::optional<double> accept = {}) {
    return pair_scene(first, {{.scene = second}}, {}, {.threads = 2}, {.judging = {.twins = 2, .half_step = false}, .accept = accept});
}

}  // namespace

TEST_CASE("one hidden error in a second scene is found, whatever it is") {
    const Scene gate = make_gate();
    const std::vector<Change> errors{
        {"friction", [](Scene& s) { s.material.friction *= 1.0 + 1e-6; }},
        {"density", [](Scene& s) { s.material.density *= 1.0 + 1e-5; }},
        {"normal stiffness", [](Scene& s) { s.material.normal_stiffness *= 1.0 + 1e-6; }},
        {"shear stiffness", [](Scene& s) { s.material.shear_stiffness *= 1.0 + 1e-6; }},
        {"restitution", [](Scene& s) { s.material.restitution *= 1.0 + 1e-5; }},
        {"gravity", [](Scene& s) { s.gravity[2] *= 1.0 + 1e-6; }},
        {"one block by a micrometre", [](Scene& s) { block(s, 3).position[0] += 1e-6 * si::meters; }},
        {"one size", [](Scene& s) { block(s, 2).size[2] *= 1.0 + 1e-6; }},
        {"one velocity", [](Scene& s) { block(s, 4).velocity[0] = musim::scaling::Velocity::from_value(1e-6); }},
        {"one friction",
         [](Scene& s) {
             s.materials["smooth"] = s.material;
             s.materials["smooth"].friction *= 1.0 - 1e-4;
             block(s, 1).material = "smooth";
         }},
        {"motion", [](Scene& s) { s.base_motion.factors.velocity = 1.0 + 1e-4; }},
        {"safety of the step", [](Scene& s) { s.time.safety = 0.4; }},
        {"step", [](Scene& s) { s.time.step = 2e-6 * si::seconds; }},
    };
    for (const Change& error : errors) {
        CAPTURE(error.what);
        Scene second = gate;
        error.make(second);
        const ScenePair pair = run_two(gate, second);
        const PairedRun& model = pair.study.models.front();
        CHECK(model.materials == Materials::exact);
        CAPTURE(model.difference.rms_velocity);
        CAPTURE(model.judgement.lead);
        CHECK(model.judgement.agreement == Agreement::differ);
        CHECK_FALSE(pair.study.consistent());
        REQUIRE(model.scene);
        CHECK(model.scene->differences.size() >= 1);
        CHECK(model.run.history.samples() == pair.study.prototype.history.samples());
    }
}

TEST_CASE("a second scene that says the same agrees, in other units or under another name, and is accepted") {
    const Scene gate = make_gate();
    Scene same = gate;
    same.name = "another name";
    same.output.spine_rate *= 2.0;
    same.time.duration *= 2.0;
    // 59/100 as 0.59, 100.1 mm as 0.1001 m: last places
    for (BlockEntry& entry : std::get<BlockList>(same.structure).blocks) {
        for (Length& edge : entry.size) edge *= 1.0 + 4e-16;
    }
    same.material.friction *= 1.0 - 2e-16;
    for (const Scene& second : {gate, same}) {
        const ScenePair pair = run_two(gate, second, 0.01);
        const PairedRun& model = pair.study.models.front();
        CHECK(model.judgement.agreement == Agreement::agree);
        CHECK(model.scene->is_prototype());
        CHECK(pair.study.consistent());
        const std::vector<std::string> lines = describe_verdict(pair.study);
        CHECK(lines.front() == gate.place() + ": the structure of " + gate.place() + ", block by block, judged like an exact model.");
    }
}

TEST_CASE("what differs between two scenes is named by key, files by what is in them") {
    const Scene gate = make_gate();
    CHECK(find_scene_differences(gate, gate).empty());
    Scene other = gate;
    other.material.friction *= 1.0 + 1e-6;
    block(other, 3).position[0] += 1e-6 * si::meters;
    other.materials["odd"] = other.material;
    other.ground.friction = 0.25;
    const std::vector<SceneDifference> differences = find_scene_differences(gate, other);
    REQUIRE(differences.size() == 4);
    CHECK(differences[0].key == "/material/friction");
    CHECK(std::stod(differences[0].second) == other.material.friction);
    CHECK(differences[1].key == "/materials/odd");
    CHECK(differences[1].first.empty());
    CHECK(differences[2].key == "/structure/blocks/3/position/0");
    CHECK(differences[3].key == "/ground/friction");
    CHECK(differences[3].second == "0.25");
    const SecondScene second{"b.json", "", true, differences};
    CHECK(second.describe_differences().starts_with("b.json differs from the prototype's scene in 4 keys: /material/friction: "));
}

TEST_CASE("blocks are the same ones unless heights are drawn anew, or one is elsewhere or of another size") {
    const Scene gate = make_gate();
    const auto other = [&](const std::function<void(Scene&)>& change) {
        Scene second = gate;
        change(second);
        return find_other_structure(gate, second);
    };
    CHECK_FALSE(other([](Scene&) {}));
    // all of them lower by as much, one of them wrong, all of them within a tenth of their scatter
    CHECK_FALSE(other([](Scene& s) {
        for (std::size_t i = 0; i < 5; ++i) block(s, i).size[2] *= 0.99;
    }));
    CHECK_FALSE(other([](Scene& s) { block(s, 1).size[2] *= 0.998; }));
    CHECK_FALSE(other([](Scene& s) {
        for (std::size_t i = 0; i < 5; ++i) block(s, i).size[2] *= 1.0 - 1e-6 * static_cast<double>(i * i);
    }));
    CHECK(other([](Scene& s) {
              for (std::size_t i = 0; i < 5; ++i) block(s, i).size[2] *= 1.0 - 1e-3 * static_cast<double>(i * i % 4);
              for (std::size_t i = 0; i < 5; ++i) block(s, i).size[2] *= 1.0 - 2e-3 * static_cast<double>(i % 3);
          }) == "its block heights are drawn anew");
    CHECK(other([](Scene& s) { block(s, 4).position[1] += 0.02 * si::meters; }) == "block 4 is at another place");
    CHECK(other([](Scene& s) { block(s, 1).size[0] *= 0.8; }) == "block 1 has another size");

    const Scene wall = make_pushed_wall();
    const auto of_wall = [&](const std::function<void(Wall&)>& change) {
        Scene second = wall;
        change(std::get<Wall>(second.structure));
        return find_other_structure(wall, second);
    };
    CHECK(of_wall([](Wall& w) { w.seed = 2; }) == "its block heights are drawn anew, from another seed");
    CHECK(of_wall([](Wall& w) { w.height_deviation *= 2.0; }) == "its block heights are drawn anew");
    CHECK(of_wall([](Wall& w) { w.height_deviation *= 0.0; }) == "its block heights are drawn anew");
    CHECK_FALSE(of_wall([](Wall& w) { w.height_deviation *= 1.0 + 1e-4; }));
    CHECK_FALSE(of_wall([](Wall& w) { w.block[1] *= 1.0 + 1e-6; }));
    CHECK(of_wall([](Wall& w) { w.layers = 3; })->starts_with("it has "));
}

TEST_CASE("heights drawn anew make a model of its own, whatever else it is") {
    const Scene wall = make_pushed_wall();
    Scene second = wall;
    std::get<Wall>(second.structure).seed = 7;
    const ScenePair pair = pair_scene(wall, {{.scene = second}, {.scene = wall}}, {}, {.threads = 2},
                                      {.judging = {.twins = 2, .half_step = false}, .specimens = 1});
    const PairedRun &own = pair.study.models[0], &same = pair.study.models[1];
    CHECK(own.materials == Materials::own);
    CHECK(own.judgement.agreement == Agreement::not_judged);
    CHECK(same.materials == Materials::exact);
    CHECK(same.difference.bitwise_identical);
    CHECK(pair.study.consistent());
    const std::vector<std::string> lines = describe_verdict(pair.study);
    CHECK(lines[0] == wall.place() + ": a model of its own, held against chance (its block heights are drawn anew, from another seed).");
}
