#include <doctest/doctest.h>

#include <cmath>
#include <string>

#include "lsdem/motion/simulation.hpp"
#include "lsdem/scene/build_model.hpp"
#include "lsdem/scene/scale_scene.hpp"
#include "scaling/laws/law_similitude.hpp"
#include "tests/scene/made_scene.hpp"
#include "tests/support/relative.hpp"

using namespace musim;
using namespace musim::lsdem;
using namespace musim::lsdem::testing;
using musim::lsdem::tests::relative;

namespace {

const std::string kTwo = R"({"kind": "blocks", "blocks": [
    {"size": ["10 cm", "20 cm", "30 cm"], "position": [0, 0, "15 cm"], "fixed": "base", "name": "plinth"},
    {"size": ["10 cm", "20 cm", "30 cm"], "position": [0, 0, "45 cm"], "quaternion": [1, 0, 0, 1], "name": "stone"}]})";

Scene make_loaded(const std::string& loads, const std::string& structure = kTwo) {
    return parse_scene(make_scene_text(structure, R"(, "loads": [)" + loads + "]"));
}

std::string refusal_of_load(const std::string& loads) {
    return error_of([&] { make_model(make_loaded(loads)); });
}

}  // namespace

TEST_CASE("a load acts on a point of its block, in the block's frame") {
    const Scene scene = make_loaded(
        R"({"name": "push", "block": "stone", "point": ["-10 cm", "5 cm", "55 cm"], "force": ["3 N", "0 N", "4 N"], "rise": "2 s"},
           {"block": 1, "displacement": ["0 m", "-5 mm", "0 m"], "start": "0.5 s", "rise": "1 s"})");
    const Model model = make_model(scene);
    REQUIRE(model.loads.size() == 2);
    const Load &push = model.loads[0], &pull = model.loads[1];
    CHECK(push.block == 1);
    // the block is turned by 90° about z: its x is the world's y
    CHECK((push.point - Vector3(0.05, 0.1, 0.1)).norm() < 1e-15);
    CHECK(push.force == relative(5.0, 1e-15));
    CHECK((push.direction - Vector3(0.6, 0.0, 0.8)).norm() < 1e-15);
    CHECK_FALSE(push.is_actuator());
    CHECK(push.rise == 2.0);
    CHECK(pull.block == 1);
    CHECK(pull.point == Vector3::Zero());
    CHECK(pull.displacement == 0.005);
    CHECK(pull.direction == Vector3(0.0, -1.0, 0.0));
    CHECK(pull.stiffness == relative(kActuatorPart * model.materials[0].normal_stiffness * 0.02, 1e-14));
    CHECK(pull.start == 0.5);
    CHECK(build_model(scene).structure.load == std::vector<std::string>{"push", "load 1"});
    CHECK(make_model(make_loaded(R"({"block": 2, "force": [1, 0, 0], "rise": 1})", kColumn)).loads[0].block == 2);
}

TEST_CASE("a scene with loads comes back from its text") {
    const Scene scene = make_loaded(
        R"({"name": "push", "block": "stone", "point": [0, 0, 0.5], "force": [1, 2, 3], "rise": 0.3},
           {"block": 1, "displacement": [1e-3, 0, 0], "stiffness": "1 MN/m", "start": 0.25, "rise": 1})");
    CHECK(parse_scene(write_scene(scene)) == scene);
    // a scene without any says nothing of them
    CHECK(write_scene(parse_scene(make_scene_text(kTwo))).find("loads") == std::string::npos);
}

TEST_CASE("similar scenes with loads move alike to the last bit") {
    const Scene scene = make_loaded(
        R"({"block": "stone", "point": ["-10 cm", "0 m", "58 cm"], "displacement": ["2 mm", "0 m", "0 m"], "rise": "50 ms"},
           {"block": "stone", "force": ["0 N", "30 N", "-5 N"], "start": "10 ms", "rise": "20 ms"})");
    const scaling::Similitude law = scaling::make_similitude("exact", {.length = 1.0 / 16.0});
    const Scene small = scale_scene(scene, law);
    const Model prototype = make_model(scene), model = make_model(small);
    const double dt = compute_time_step(scene, prototype).value();
    CHECK(compute_time_step(small, model).value() == dt * law.time());
    Simulation a(prototype, dt), b(model, dt * law.time());
    a.advance(3000);
    b.advance(3000);
    REQUIRE(a.time() > 0.03);
    for (std::size_t l = 0; l < 2; ++l) {
        CHECK(a.loads()[l].force != 0.0);
        CHECK(b.loads()[l].force == a.loads()[l].force * law.force());
        CHECK(b.loads()[l].displacement == a.loads()[l].displacement * law.length());
    }
    CHECK(b.position(1) == Vector3(a.position(1) * law.length()));
    CHECK(b.energy().load_work == a.energy().load_work * law.energy());
}

TEST_CASE("loads that make no sense are refused in one line that says what to do") {
    const std::string rest = R"(, "force": [1, 0, 0], "rise": 1})";
    check_message(refusal_of_load(R"({"block": "ston")" + rest), {"/loads/0/block", "\"ston\"", "\"stone\""});
    check_message(refusal_of_load(R"({"block": 7)" + rest), {"/loads/0/block", "no block 7", "0 to 1"});
    check_message(refusal_of_load(R"({"block": "plinth")" + rest), {"/loads/0/block", "held"});
    check_message(refusal_of_load(R"({"block": "stone", "force": [0, 0, 0], "rise": 1})"), {"/loads/0/force", "zero"});
    check_message(refusal_of_load(R"({"block": "stone", "displacement": [0, 0, 0], "rise": 1})"), {"/loads/0/displacement", "zero"});
    check_message(refusal_of_load(R"({"block": "stone", "force": [1, 0, 0], "displacement": [1, 0, 0], "rise": 1})"),
                  {"/loads/0/force", "displacement", "leave one"});
    check_message(refusal_of_load(R"({"block": "stone", "rise": 1})"), {"/loads/0", "neither"});
    check_message(refusal_of_load(R"({"block": "stone", "force": [1, 0, 0], "rise": 0})"), {"/loads/0/rise", "positive"});
    check_message(refusal_of_load(R"({"block": "stone", "force": [1, 0, 0]})"), {"/loads/0", "rise"});
    check_message(refusal_of_load(R"({"block": "stone", "start": -1)" + rest), {"/loads/0/start", "negative"});
    check_message(refusal_of_load(R"({"block": "stone", "stiffness": 1e6)" + rest), {"/loads/0/stiffness", "leave it out"});
    check_message(refusal_of_load(R"({"block": "stone", "point": [0, 0, 0.7])" + rest), {"/loads/0/point", "100 mm away", "move it"});
    check_message(refusal_of_load(R"({"block": "stone", "name": "a")" + rest + R"(, {"block": "stone", "name": "a")" + rest),
                  {"/loads/1/name", "load 0", "own"});
    const std::string motions = R"(, "motions": [{"base_motion": {"signal": "step", "velocity": 1}}])";
    check_message(error_of([&] { parse_scene(make_scene_text(kTwo, R"(, "loads": [{"block": 1)" + rest + "]" + motions)); }),
                  {"/loads", "motions"});
}

TEST_CASE("blocks that are held to the base say so in one way of two") {
    const auto held = [](const std::string& how) {
        return parse_scene(make_scene_text(R"({"kind": "blocks", "blocks": [{"size": [1, 1, 1], "position": [0, 0, 0.5], )" + how +
                                           R"(}, {"size": [1, 1, 1], "position": [0, 0, 1.5]}]})"));
    };
    const Scene base = held(R"("fixed": "base")");
    CHECK(make_model(base).blocks[0].with_base);
    CHECK(make_model(base).blocks[0].fixed);
    CHECK(held(R"("with_base": true)") == base);
    CHECK(held(R"("fixed": true, "with_base": true)") == base);
    CHECK_FALSE(make_model(held(R"("fixed": true)")).blocks[0].with_base);
    CHECK(make_model(held(R"("fixed": true)")).blocks[0].fixed);
    CHECK_FALSE(make_model(held(R"("fixed": false)")).blocks[0].fixed);
    const std::string text = write_scene(base);
    CHECK(text.find(R"("fixed": "base")") != std::string::npos);
    CHECK(text.find("with_base") == std::string::npos);
    CHECK(parse_scene(text) == base);
    check_message(error_of([&] { held(R"("fixed": "yes")"); }), {"/structure/blocks/0/fixed", "\"base\""});
}
