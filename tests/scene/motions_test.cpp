#include "lsdem/scene/motions.hpp"

#include <doctest/doctest.h>

#include <string>
#include <vector>

#include "lsdem/scene/base_components.hpp"
#include "lsdem/scene/build_model.hpp"
#include "lsdem/scene/scale_scene.hpp"
#include "scaling/laws/law_similitude.hpp"
#include "tests/scene/made_scene.hpp"

using namespace musim;
using namespace musim::lsdem;
using namespace musim::lsdem::testing;

namespace {

const std::string kSine = R"({"signal": "sine", "direction": "x", "amplitude": "0.5 g", "frequency": "4 Hz", "cycles": 2})";
const std::string kPulse = R"({"signal": "ricker", "direction": "y", "amplitude": "0.3 g", "frequency": "10 Hz", "start": "0.1 s"})";

/// A column with a list of motions.
std::string make_text(const std::string& motions, const std::string& time = "", const std::string& more = "") {
    return R"({"schema": "musim-scene/1", "name": "test", "material": "wood", "structure": )" + kColumn + R"(, "motions": )" + motions +
           more + (time.empty() ? "" : R"(, "time": )" + time) + "}";
}

Scene make_scene() {
    return parse_scene(make_text(R"([{"name": "foreshock", "base_motion": )" + kSine + R"(, "repeat": 2},
        {"base_motion": )" + kPulse +
                                 R"(, "duration": "2 s", "settle": false}])"));
}

std::string refuse_motion(const std::string& text) {
    return error_of([&] { parse_scene(text); });
}

}  // namespace

TEST_CASE("a list of motions is read, written and read again") {
    const Scene scene = make_scene();
    REQUIRE(scene.motions.size() == 2);
    CHECK(scene.motions[0].name == "foreshock");
    CHECK(scene.motions[0].repeat == 2);
    CHECK(scene.motions[0].settle);
    CHECK_FALSE(scene.motions[0].duration.has_value());
    CHECK_FALSE(scene.motions[1].settle);
    CHECK(scene.motions[1].duration->value() == 2.0);
    CHECK(scene.time.duration.value() == 0.0);
    CHECK(parse_scene(write_scene(scene)) == scene);
    const Scene timed = parse_scene(make_text("[{\"base_motion\": " + kSine + "}]", R"({"duration": "3 s", "step": "10 us"})"));
    CHECK(timed.time.duration.value() == 3.0);
    CHECK(parse_scene(write_scene(timed)) == timed);
}

TEST_CASE("motions become scenes of their own, with names, repetitions and durations") {
    const std::vector<StageScene> stages = expand_motions(make_scene());
    REQUIRE(stages.size() == 3);
    for (const std::size_t k : {0U, 1U}) {
        CHECK(stages[k].name == "foreshock");
        CHECK(stages[k].entry == 0);
        CHECK(stages[k].settle);
        // two cycles of 4 Hz
        CHECK(stages[k].scene.time.duration.value() == doctest::Approx(0.5).epsilon(1e-14));
    }
    CHECK(stages[2].name == "ricker");
    CHECK(stages[2].entry == 1);
    CHECK_FALSE(stages[2].settle);
    CHECK(stages[2].scene.time.duration.value() == 2.0);
    CHECK(stages[2].scene.motions.empty());
    // each can be built, with its own motion
    CHECK_FALSE(make_model(stages[0].scene).ground.motion.shift[0].velocity.empty());
    CHECK(make_model(stages[2].scene).ground.motion.shift[0].velocity.empty());
    CHECK_FALSE(make_model(stages[2].scene).ground.motion.shift[1].velocity.empty());
    CHECK(parse_scene(write_scene(stages[2].scene)) == stages[2].scene);

    // the motion's own start counts, and the scene's duration comes before the motion's
    const auto only = [](const std::string& time) {
        return expand_motions(parse_scene(make_text("[{\"base_motion\": " + kPulse + "}]", time)));
    };
    CHECK(only("").front().scene.time.duration.value() == doctest::Approx(0.1 + 3.0 / 10.0).epsilon(1e-14));
    CHECK(only(R"({"duration": "3 s"})").front().scene.time.duration.value() == 3.0);
    CHECK(expand_motions(parse_scene(make_scene_text(kColumn, kRicker))).empty());
}

TEST_CASE("the similar twin of a list of motions is the list of the twins of its motions") {
    const scaling::Similitude similitude = scaling::make_similitude("exact", {.length = 1.0 / 16.0});
    const Scene scene = make_scene(), twin = scale_scene(scene, similitude);
    CHECK(twin.motions[0].base_motion.factors.time == similitude.time());
    CHECK(twin.motions[1].base_motion.factors.velocity == similitude.velocity());
    CHECK(twin.motions[1].duration->value() == similitude.time() * 2.0);
    const std::vector<StageScene> stages = expand_motions(scene), twins = expand_motions(twin);
    REQUIRE(twins.size() == stages.size());
    for (std::size_t k = 0; k < stages.size(); ++k) CHECK(twins[k].scene == scale_scene(stages[k].scene, similitude));
}

TEST_CASE("bad lists of motions are refused with their place") {
    const std::string one = "[{\"base_motion\": " + kSine + "}]";
    check_message(refuse_motion(make_text(one, "", ", \"base_motion\": " + kSine)),
                  {"/motions: there is a \"base_motion\" as well", "leave one"});
    check_message(refuse_motion(make_text("[]")), {"/motions: a list", "at least one"});
    check_message(refuse_motion(make_text(kSine)), {"/motions: a list"});
    check_message(refuse_motion(make_text("[{}]")), {"/motions/0", "key \"base_motion\" is missing"});
    check_message(refuse_motion(make_text("[{\"base_motion\": " + kSine + ", \"repat\": 2}]")),
                  {"/motions/0/repat: unknown key", "did you mean \"repeat\"?"});
    check_message(refuse_motion(make_text("[{\"base_motion\": " + kSine + ", \"repeat\": 0}]")),
                  {"/motions/0/repeat: 0 (must be from 1 to 1000)"});
    check_message(refuse_motion(make_text("[{\"base_motion\": " + kSine + ", \"duration\": \"-1 s\"}]")),
                  {"/motions/0/duration: -1 s (must be positive)"});
    check_message(refuse_motion(make_text("[{\"base_motion\": " + kSine + ", \"settle\": false}]")),
                  {"/motions/0/settle: no motion comes before"});
    check_message(refuse_motion(make_text(one, R"({"duration": "-1 s"})")), {"/time/duration: -1 s (must be positive)"});
    check_message(refuse_motion(make_text(one, "", R"(, "ground": {"present": false})")),
                  {"/motions/0/base_motion: there is no ground to move"});
    std::string no_frequency = kSine;
    no_frequency.replace(no_frequency.find("4 Hz"), 4, "0 Hz");
    check_message(refuse_motion(make_text("[{\"base_motion\": " + kPulse + "}, {\"base_motion\": " + no_frequency + "}]")),
                  {"/motions/1/base_motion/frequency: 0 Hz (must be positive)"});
    // without a list the duration is as needed as ever
    check_message(refuse_motion(R"({"schema": "musim-scene/1", "material": "wood", "structure": )" + kColumn + R"(, "time": {}})"),
                  {"key \"duration\" is missing"});
    const Scene step = parse_scene(make_text(R"([{"base_motion": {"signal": "step", "velocity": "1 m/s"}}])"));
    check_message(error_of([&] { expand_motions(step); }), {"/motions/0: the motion has no end", "give a \"duration\""});
}

TEST_CASE("what takes one motion says what to do with a list of them") {
    check_message(error_of([] { require_single_motion(make_scene(), "a pair"); }), {"/motions: a pair takes one motion", "use a sequence"});
    CHECK_NOTHROW(require_single_motion(parse_scene(make_scene_text(kColumn, kRicker)), "a pair"));
}
