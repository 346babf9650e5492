#pragma once

#include <doctest/doctest.h>

#include <string>
#include <vector>

#include "lsdem/scene/scene_json.hpp"

/// Scenes that several tests share.
namespace musim::lsdem::testing {

/// A scene of wood with the given structure and further members, as JSON text.
inline std::string make_scene_text(const std::string& structure, const std::string& more = "") {
    return R"({"schema": "musim-scene/1", "name": "test", "material": "wood", "structure": )" + structure + more +
           R"(, "time": {"duration": "1 s"}})";
}

inline const std::string kColumn = R"({"kind": "column", "layers": 3, "block": ["12.710 mm", "26.355 mm", "39.780 mm"]})";
inline const std::string kTower =
    R"({"kind": "tower", "layers": 4, "block": ["12.710 mm", "26.355 mm", "39.780 mm"], "tiling": "ring_14"})";
inline const std::string kWall =
    R"({"kind": "wall", "layers": 4, "blocks_per_layer": 3, "block": ["12.710 mm", "26.355 mm", "39.780 mm"]})";
inline const std::string kBlocks = R"({"kind": "blocks", "blocks": [
    {"size": ["10 cm", "20 cm", "30 cm"], "position": [0, 0, "15 cm"], "fixed": true, "material": "steel"},
    {"size": ["10 cm", "20 cm", "30 cm"], "position": [0, 0, "46 cm"], "velocity": ["0.1 m/s", 0, 0],
     "angular_velocity": [0, 0, "2 1/s"], "quaternion": [2, 0, 0, 1]}]})";
inline const std::string kSteel = R"(, "materials": {"steel": {"density": "7850 kg/m^3", "normal_stiffness": "2 GN/m",
    "shear_stiffness": "0.8 GN/m", "friction": 0.3, "restitution": 0.6, "shear_damping_ratio": 0.05}})";
inline const std::string kRicker =
    R"(, "base_motion": {"signal": "ricker", "direction": "y", "amplitude": "0.3 g", "frequency": "7 Hz", "start": "0.02 s"})";

/// Message of the SceneError that `action` throws; fails the test when it throws none.
template <class Action>
std::string error_of(const Action& action) {
    try {
        action();
    } catch (const SceneError& error) {
        return error.what();
    }
    FAIL("no SceneError was thrown");
    return {};
}

/// Every part of `parts` stands in the one-line message.
inline void check_message(const std::string& message, const std::vector<std::string>& parts) {
    CAPTURE(message);
    CHECK(message.find('\n') == std::string::npos);
    for (const std::string& part : parts) {
        CAPTURE(part);
        CHECK(message.find(part) != std::string::npos);
    }
}

}  // namespace musim::lsdem::testing
