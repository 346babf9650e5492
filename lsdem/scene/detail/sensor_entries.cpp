#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "lsdem/scene/detail/require.hpp"
#include "lsdem/scene/detail/scene_parts.hpp"
#include "lsdem/scene/detail/sensor_body.hpp"
#include "records/processing/butterworth.hpp"

namespace musim::lsdem::detail {
namespace {

using scaling::JsonReader;

template <std::size_t Count>
std::vector<std::string> to_list(const std::array<const char*, Count>& names) {
    return {names.begin(), names.end()};
}

SensorBody parse_body(const JsonReader& value) {
    if (value.json().is_string()) return value.text();
    if (value.json().is_number_integer()) return value.as<std::size_t>();
    value.fail("the name of a block, its number, counted from 0, or \"ground\" is wanted; correct the value");
}

SensorEntry parse_sensor(const JsonReader& value) {
    const JsonReader object = to_object(value, "sensor");
    SensorEntry sensor;
    object.read("name", sensor.name);
    sensor.kind = static_cast<SensorKind>(to_choice(object["kind"], to_list(kSensorKinds)));
    const bool is_joint = sensor.kind == SensorKind::joint;
    if (object.has(is_joint ? "block" : "blocks")) {
        object[is_joint ? "block" : "blocks"].fail(is_joint ? R"(a joint is one of two; write "blocks": ["upper", "lower"])"
                                                            : R"(only a joint is of two; write "block": "name")");
    }
    if (is_joint) {
        const JsonReader blocks = object["blocks"];
        if (!blocks.json().is_array() || blocks.json().size() != 2)
            blocks.fail("two blocks, or one and \"ground\", are wanted; correct the list");
        for (const JsonReader& block : blocks.entries()) sensor.bodies.push_back(parse_body(block));
        if (object.has("axes")) object["axes"].fail("the axes of a joint are its normal and two across it; leave it out");
    } else {
        sensor.bodies.push_back(parse_body(object["block"]));
    }
    object.read("normal", sensor.normal.emplace());
    if (!object.has("normal")) sensor.normal.reset();
    read_fields(object, sensor);
    return sensor;
}

/// Settings that a kind of sensor has no use for.
void refuse_idle_settings(const SensorEntry& sensor, const JsonPlace& place) {
    const auto refuse = [&](bool given, const char* key, const char* why) {
        if (given) fail(place.at(key), fmt::format("{}; leave it out", why));
    };
    const bool is_joint = sensor.kind == SensorKind::joint;
    refuse(is_joint && sensor.quaternion, "quaternion", "the axes of a joint are its normal and two across it");
    refuse(is_joint && sensor.relative, "relative", "a joint reads one block against the other");
    refuse(!is_joint && sensor.normal, "normal", "only a joint has one");
    refuse(sensor.gravity && sensor.kind != SensorKind::acceleration, "gravity", "only accelerations can include it");
}

void check_filter(const SensorEntry& sensor, const JsonPlace& place) {
    if (!sensor.filter) return;
    if (sensor.filter->order > records::kHighestFilterOrder) {
        fail(place.at("order"),
             fmt::format("{} (must be from 1 to {}); correct the number", sensor.filter->order, records::kHighestFilterOrder));
    }
    if (sensor.filter->corner && !(*sensor.filter->corner < 0.5 * sensor.rate)) {
        fail(
            place.at("corner"),
            fmt::format("{} (what lies above half the rate, {}, cannot be distinguished from what lies below); lower it, or raise the rate",
                        describe(*sensor.filter->corner), describe(0.5 * sensor.rate)));
    }
}

void check_sensor(const SensorEntry& sensor, const Scene& scene, const JsonPlace& place) {
    require_fields(sensor, place);
    refuse_idle_settings(sensor, place);
    check_filter(sensor, place.at("filter"));
    if (sensor.quaternion) require_rotation(*sensor.quaternion, place.at("quaternion"));
    if (sensor.normal) {
        const auto& [x, y, z] = *sensor.normal;
        const double length = std::hypot(x, y, z);
        if (!(std::isfinite(length) && length > 0.0))
            fail(place.at("normal"), "is no direction (its length must be positive); correct the numbers");
    }
    const bool is_joint = sensor.kind == SensorKind::joint;
    for (const SensorBody& body : sensor.bodies) {
        if (!is_ground(body)) continue;
        const JsonPlace here = place.at(is_joint ? "blocks" : "block");
        if (!scene.ground.present) fail(here, "there is no ground (/ground/present is false); name a block");
        if (!is_joint && sensor.axes == SensorAxes::block)
            fail(place.at("axes"), "the ground is no block; take \"base\", the axes that turn with it");
    }
    if (is_joint && sensor.bodies.front() == sensor.bodies.back())
        fail(place.at("blocks"), "a joint is of two blocks (these are one); name another");
}

}  // namespace

bool is_ground(const SensorBody& body) {
    const auto* name = std::get_if<std::string>(&body);
    return name != nullptr && *name == kGroundName;
}

void read_value(const JsonReader& json, SensorAxes& axes) { axes = static_cast<SensorAxes>(to_choice(json, to_list(kSensorAxes))); }

void read_value(const JsonReader& json, std::optional<SensorFilter>& filter) {
    filter = SensorFilter{};
    if (!json.json().is_string()) return read_fields(to_object(json, "sensor_filter"), *filter);
    if (json.json() != "none") json.fail(fmt::format("{} is no filter; write \"none\", an object, or leave it out", json.json().dump()));
    filter.reset();
}

std::vector<SensorEntry> parse_sensors(const JsonReader& list) {
    if (!list.json().is_array()) list.fail("a list [ ... ] of sensors is wanted; correct the value");
    std::vector<SensorEntry> sensors;
    for (const JsonReader& value : list.entries()) sensors.push_back(parse_sensor(value));
    return sensors;
}

void check_sensors(const Scene& scene, const JsonPlace& place) {
    std::map<std::string, std::size_t> names;
    for (std::size_t k = 0; k < scene.sensors.size(); ++k) {
        const SensorEntry& sensor = scene.sensors[k];
        const JsonPlace here = place.at(k), name = here.at("name");
        if (sensor.name.find_first_not_of('.') == std::string::npos)
            fail(name, "is empty, or dots alone (results go by it); give the sensor a name");
        check_name(sensor.name, name);
        const auto [first, is_new] = names.emplace(sensor.name, k);
        if (!is_new) fail(name, fmt::format("sensor {} is called \"{}\" as well; give each a name of its own", first->second, sensor.name));
        check_sensor(sensor, scene, here);
    }
}

}  // namespace musim::lsdem::detail
