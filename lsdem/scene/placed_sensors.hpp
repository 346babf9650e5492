#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "lsdem/scene/build_model.hpp"
#include "lsdem/scene/scene.hpp"
#include "lsdem/types.hpp"

namespace musim::lsdem {

/// A sensor in its place in a model.
struct PlacedSensor {
    std::string name;
    SensorKind kind = SensorKind::acceleration;
    SensorAxes axes = SensorAxes::world;
    std::optional<std::size_t> body;   ///< block that it sits on, the first one of a joint; nothing: the ground
    std::optional<std::size_t> other;  ///< second one of a joint; likewise
    bool relative = false;             ///< to the base, as who rides on it sees it
    bool gravity = false;              ///< an acceleration is read less that of gravity
    /// Where it sits, in the frame of its block, from the centre of mass [m]; on the ground in the world, at the start. Of a joint it is a
    /// point of the second body; nothing: the middle of the area in which the two meet at the start.
    std::optional<Vector3> place;
    std::optional<Vector3> normal;              ///< of a joint, in the frame of the second body; nothing: that of the same area
    Quaternion mount = Quaternion::Identity();  ///< the sensor's axes in those that it turns with: of its block, the base or the world
};

/// The sensors of a scene in its model. A sensor sits, by default, in the centre of mass of its block, or in the origin on the ground; its
/// axes are parallel to the world's, unless it has a quaternion, in the structure as it is drawn. Throws SceneError for a block that is
/// not there, and for a block that is called as the ground.
std::vector<PlacedSensor> place_sensors(const Scene& scene, const BuiltModel& built);

}  // namespace musim::lsdem
