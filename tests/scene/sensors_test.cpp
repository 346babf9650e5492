#include "lsdem/scene/sensors.hpp"

#include <doctest/doctest.h>

#include <string>
#include <utility>
#include <vector>

#include "lsdem/scene/placed_sensors.hpp"
#include "lsdem/scene/scale_scene.hpp"
#include "scaling/laws/law_similitude.hpp"
#include "tests/scene/made_scene.hpp"

using namespace musim;
using namespace musim::lsdem;
using namespace musim::lsdem::testing;

namespace {

/// Two blocks, one of which lies on its side, with a list of sensors.
std::string make_instrumented_text(const std::string& sensors, const std::string& more = "") {
    return make_scene_text(R"({"kind": "blocks", "blocks": [
               {"name": "pier", "size": ["0.2 m", "0.2 m", "0.4 m"], "position": [0, 0, "0.2 m"]},
               {"name": "lintel", "size": ["0.1 m", "0.2 m", "0.6 m"], "position": [0, 0, "0.45 m"], "quaternion": [1, 0, 1, 0]}]})",
                           R"(, "sensors": [)" + sensors + "]" + more);
}

const std::string kSensors = R"(
    {"name": "A1", "kind": "acceleration", "block": "lintel", "point": ["0.3 m", 0, "0.5 m"], "axes": "block", "rate": "500 Hz"},
    {"name": "D 2", "kind": "displacement", "block": 0, "axes": "base", "rate": "100 Hz", "filter": {"corner": "30 Hz", "order": 6}},
    {"name": "V0", "kind": "velocity", "block": "ground", "rate": "1 kHz", "filter": "none", "relative": true},
    {"name": "J3", "kind": "joint", "blocks": ["lintel", "pier"], "normal": [0, 0, 2], "rate": 250})";

std::string refusal_of_sensors(const std::string& sensors, const std::string& more = "") {
    return error_of([&] { make_model(parse_scene(make_instrumented_text(sensors, more), "s.json")); });
}

std::vector<PlacedSensor> place(const std::string& sensors) {
    const Scene scene = parse_scene(make_instrumented_text(sensors));
    return place_sensors(scene, build_model(scene));
}

}  // namespace

TEST_CASE("sensors are read, written and read back as they were") {
    const Scene scene = parse_scene(make_instrumented_text(kSensors));
    REQUIRE(scene.sensors.size() == 4);
    CHECK(scene.sensors[0].axes == SensorAxes::block);
    CHECK(scene.sensors[0].filter == SensorFilter{});
    CHECK(scene.sensors[1].bodies == std::vector<SensorBody>{std::size_t{0}});
    CHECK(scene.sensors[1].filter->order == 6);
    CHECK_FALSE(scene.sensors[2].filter);
    CHECK(scene.sensors[3].bodies == std::vector<SensorBody>{std::string("lintel"), std::string("pier")});
    CHECK(parse_scene(write_scene(scene)) == scene);
}

TEST_CASE("a similar scene has the same sensors, points scaled as lengths, rates and corners as one over times") {
    const Scene scene = parse_scene(make_instrumented_text(kSensors));
    const scaling::Similitude model = scaling::make_similitude("exact", {.length = 1.0 / 16.0});
    const Scene scaled = scale_scene(scene, model);
    REQUIRE(scaled.sensors.size() == 4);
    CHECK(scaled.sensors[0].name == "A1");
    CHECK((*scaled.sensors[0].point)[0].value() == 0.3 / 16.0);
    CHECK(scaled.sensors[0].rate.value() == 500.0 * 4.0);
    CHECK(scaled.sensors[1].filter->corner->value() == 30.0 * 4.0);
    CHECK(scaled.sensors[3].normal == scene.sensors[3].normal);
}

TEST_CASE("a sensor is carried by its block: its place and its axes are those of the structure as it is drawn") {
    const std::vector<PlacedSensor> placed = place(kSensors);
    const Model model = make_model(parse_scene(make_instrumented_text(kSensors)));
    const Block& lintel = model.blocks[1];
    REQUIRE(placed.size() == 4);
    // to rounding of a turn
    CHECK((lintel.position + lintel.orientation * *placed[0].place - Vector3(0.3, 0.0, 0.5)).norm() < 1e-15);
    CHECK((lintel.orientation * placed[0].mount).angularDistance(Quaternion::Identity()) < 1e-7);
    CHECK(placed[0].gravity);
    CHECK_FALSE(placed[0].relative);
    CHECK(placed[1].relative);
    CHECK(placed[1].place->isZero(0.0));
    CHECK_FALSE(placed[2].body);
    CHECK(placed[2].relative);
    CHECK_FALSE(placed[3].place);
    CHECK(placed[3].normal->isApprox(Vector3::UnitZ(), 1e-15));
    CHECK(placed[3].other == 0);
}

TEST_CASE("sensors that read nothing that there is are refused in a line each") {
    const auto sensor = [](const std::string& rest) { return R"({"name": "S", "rate": "100 Hz", )" + rest + "}"; };
    const std::string good = sensor(R"("kind": "velocity", "block": "pier")");
    for (const auto& [sensors, parts] : std::vector<std::pair<std::string, std::vector<std::string>>>{
             {sensor(R"("kind": "jerk", "block": "pier")"), {"/sensors/0/kind: \"jerk\" is not known", "acceleration"}},
             {sensor(R"("kind": "velocity", "block": "pier", "axes": "local")"),
              {"/sensors/0/axes: \"local\" is not known", "world, base, block"}},
             {good + "," + good, {"/sensors/1/name: sensor 0 is called \"S\" as well"}},
             {R"({"name": "", "kind": "velocity", "block": 0, "rate": 1})", {"/sensors/0/name: is empty"}},
             {R"({"name": "a/b", "kind": "velocity", "block": 0, "rate": 1})", {"/sensors/0/name: a name heads columns"}},
             {R"({"name": "S", "kind": "velocity", "block": 0})", {"/sensors/0", "rate"}},
             {R"({"name": "S", "kind": "velocity", "block": 0, "rate": "0 Hz"})", {"/sensors/0/rate: 0 Hz (must be positive)"}},
             {sensor(R"("kind": "velocity", "blocks": ["pier", "lintel"])"), {"/sensors/0/blocks: only a joint is of two"}},
             {sensor(R"("kind": "joint", "block": "pier")"), {"/sensors/0/block: a joint is one of two"}},
             {sensor(R"("kind": "joint", "blocks": ["pier"])"), {"/sensors/0/blocks: two blocks"}},
             {sensor(R"("kind": "joint", "blocks": ["pier", "pier"])"), {"/sensors/0/blocks: a joint is of two blocks (these are one)"}},
             {sensor(R"("kind": "joint", "blocks": ["pier", "lintel"], "axes": "world")"), {"/sensors/0/axes: the axes of a joint"}},
             {sensor(R"("kind": "joint", "blocks": ["pier", "lintel"], "normal": [0, 0, 0])"), {"/sensors/0/normal: is no direction"}},
             {sensor(R"("kind": "velocity", "block": "pier", "normal": [0, 0, 1])"), {"/sensors/0/normal: only a joint has one"}},
             {sensor(R"("kind": "velocity", "block": "pier", "gravity": true)"), {"/sensors/0/gravity: only accelerations"}},
             {sensor(R"("kind": "velocity", "block": "ground", "axes": "block")"), {"/sensors/0/axes: the ground is no block"}},
             {sensor(R"("kind": "velocity", "block": "pier", "filter": "some")"), {"/sensors/0/filter: \"some\" is no filter"}},
             {sensor(R"("kind": "velocity", "block": "pier", "filter": {"corner": "50 Hz"})"),
              {"/sensors/0/filter/corner: 50 Hz", "half the rate"}},
             {sensor(R"("kind": "velocity", "block": "pier", "filter": {"order": 9})"),
              {"/sensors/0/filter/order: 9 (must be from 1 to 8)"}},
             {sensor(R"("kind": "velocity", "block": "pier", "quaternion": [0, 0, 0, 0])"), {"/sensors/0/quaternion"}}}) {
        const std::string message = refusal_of_sensors(sensors);
        check_message(message, parts);
    }
    check_message(refusal_of_sensors(sensor(R"("kind": "velocity", "block": "ground")"), R"(, "ground": {"present": false})"),
                  {"/sensors/0/block: there is no ground"});
}

TEST_CASE("a sensor on a block that is not there is refused with the name that is near") {
    const auto refusal = [](const std::string& block) {
        return error_of([&] { place(R"({"name": "S", "rate": "100 Hz", "kind": "velocity", "block": )" + block + "}"); });
    };
    check_message(refusal(R"("lintle")"), {"/sensors/0/block: \"lintle\" (no block is called so", "lintel"});
    check_message(refusal("2"), {"/sensors/0/block: 2 (there is no such block: they are numbered from 0 to 1)"});
    check_message(error_of([] { place(R"({"name": "S", "rate": 9, "kind": "joint", "blocks": ["pier", "post"]})"); }),
                  {"/sensors/0/blocks/1: \"post\""});
}
