#include "lsdem/scene/placed_sensors.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <variant>

#include "lsdem/scene/detail/placement.hpp"
#include "lsdem/scene/detail/require.hpp"
#include "lsdem/scene/detail/sensor_body.hpp"
#include "scaling/nearest_name.hpp"

namespace musim::lsdem {
namespace {

using detail::JsonPlace;

/// The block that a sensor names; nothing for the ground.
std::optional<std::size_t> find_block(const SensorBody& body, const BuiltModel& built, const JsonPlace& place) {
    const std::vector<std::string>& names = built.structure.name;
    if (const auto* number = std::get_if<std::size_t>(&body)) {
        const std::size_t blocks = built.model.blocks.size();
        if (*number < blocks) return *number;
        detail::fail(place,
                     fmt::format("{} (there is no such block: they are numbered from 0 to {}); correct the number", *number, blocks - 1));
    }
    const std::string& wanted = std::get<std::string>(body);
    const auto found = std::find(names.begin(), names.end(), wanted);
    if (detail::is_ground(body)) {
        if (found == names.end()) return std::nullopt;
        detail::fail(place, fmt::format("is the ground, and block {} is called so as well; rename the block", found - names.begin()));
    }
    if (found != names.end()) return static_cast<std::size_t>(found - names.begin());
    detail::fail(place, fmt::format("\"{}\" (no block is called so{}); name one that there is, or give its number, from 0", wanted,
                                    scaling::hint_at_name(wanted, names)));
}

/// A point of the world in the frame of a block; on the ground itself.
Vector3 find_place(const Vector3& point, const Block* block) {
    return block == nullptr ? point : Vector3(block->orientation.conjugate() * (point - block->position));
}

Quaternion to_rotation(const std::array<double, 4>& q) { return Quaternion(q[0], q[1], q[2], q[3]).normalized(); }

PlacedSensor place_sensor(const SensorEntry& sensor, const BuiltModel& built, const JsonPlace& place) {
    const bool is_joint = sensor.kind == SensorKind::joint;
    PlacedSensor placed;
    placed.name = sensor.name;
    placed.kind = sensor.kind;
    placed.axes = sensor.axes;
    placed.relative = sensor.relative.value_or(sensor.axes == SensorAxes::base);
    placed.gravity = sensor.gravity.value_or(sensor.axes == SensorAxes::block && sensor.kind == SensorKind::acceleration);
    placed.body = find_block(sensor.bodies.front(), built, is_joint ? place.at("blocks").at(0) : place.at("block"));
    if (is_joint) placed.other = find_block(sensor.bodies.back(), built, place.at("blocks").at(1));

    const std::optional<std::size_t>& carrier = is_joint ? placed.other : placed.body;
    const Block* block = carrier ? &built.model.blocks[*carrier] : nullptr;
    if (sensor.point) {
        placed.place = find_place(detail::to_vector(*sensor.point), block);
    } else if (!is_joint) {
        placed.place = Vector3::Zero();
    }
    if (sensor.normal) {
        const Vector3 normal = Vector3((*sensor.normal)[0], (*sensor.normal)[1], (*sensor.normal)[2]).normalized();
        placed.normal = block == nullptr ? normal : Vector3(block->orientation.conjugate() * normal);
    }
    if (sensor.quaternion) placed.mount = to_rotation(*sensor.quaternion);
    if (sensor.axes == SensorAxes::block) placed.mount = block->orientation.conjugate() * placed.mount;
    return placed;
}

}  // namespace

std::vector<PlacedSensor> place_sensors(const Scene& scene, const BuiltModel& built) {
    std::vector<PlacedSensor> sensors;
    const JsonPlace root = JsonPlace{scene.place() + ": /"}.at("sensors");
    for (std::size_t k = 0; k < scene.sensors.size(); ++k) sensors.push_back(place_sensor(scene.sensors[k], built, root.at(k)));
    return sensors;
}

}  // namespace musim::lsdem
