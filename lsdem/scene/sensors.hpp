#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "lsdem/scene/shape_entry.hpp"
#include "scaling/units.hpp"

namespace musim::lsdem {

/// Quantity that a sensor reads.
enum class SensorKind { acceleration, velocity, displacement, rotation, angular_velocity, joint };

/// Axes in which a sensor reads: those of the world; of the base, which turn with it; of its block, which turn with that. All are the
/// world's at the start.
enum class SensorAxes { world, base, block };

/// Words of these in scenes, in their order.
inline constexpr std::array kSensorKinds{"acceleration", "velocity", "displacement", "rotation", "angular_velocity", "joint"};
inline constexpr std::array kSensorAxes{"world", "base", "block"};

/// Body that a sensor sits on: by its name, kGroundName for the ground; or by its number, from 0.
using SensorBody = std::variant<std::string, std::size_t>;

/// Low-pass before a sensor is sampled: Butterworth, causal, applied at every step of the simulation.
struct SensorFilter {
    std::optional<scaling::Frequency> corner;  ///< default: kSensorCorner of the rate
    int order = 4;

    bool operator==(const SensorFilter&) const = default;
};

/// Corner of a filter by default [of the rate]. With four poles, what folds back below it has come from above three quarters of the rate
/// and is at most 1/81 of what it was.
inline constexpr double kSensorCorner = 0.25;

/// One sensor of a scene.
struct SensorEntry {
    std::string name;  ///< heads columns of tables
    SensorKind kind = SensorKind::acceleration;
    std::vector<SensorBody> bodies;                   ///< one; of a joint two: it reads how the first stands to the second
    std::optional<Triple<scaling::Length>> point;     ///< where it sits at the start, world frame; default: see place_sensors
    std::optional<std::array<double, 3>> normal;      ///< of a joint: from the second body to the first, any length but 0; default likewise
    SensorAxes axes = SensorAxes::world;              ///< a joint has its own
    std::optional<std::array<double, 4>> quaternion;  ///< (w, x, y, z) from the sensor's axes to those at the start; any length but 0
    std::optional<bool> relative;                     ///< to the base, as who rides on it sees it; default: in axes of the base
    std::optional<bool> gravity;  ///< of accelerations: less that of gravity, as accelerometers read; default: in axes of the block
    scaling::Frequency rate{};
    std::optional<SensorFilter> filter = SensorFilter{};  ///< nothing: none

    bool operator==(const SensorEntry&) const = default;
};

}  // namespace musim::lsdem
