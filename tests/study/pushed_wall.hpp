#pragma once

#include <string>

#include "lsdem/scene/scene_json.hpp"

namespace musim::lsdem::tests {

/// A low wall of five blocks of unequal height that is pushed at once.
inline lsdem::Scene make_pushed_wall(const std::string& motion = R"("base_motion": {"signal": "half_sine", "direction": "x",
        "amplitude": "0.6 g", "duration": "0.04 s"}, )") {
    return lsdem::parse_scene(R"({"schema": "musim-scene/1", "name": "pushed wall", "material": "concrete",
        "structure": {"kind": "wall", "layers": 2, "blocks_per_layer": 2, "block": ["54.4 mm", "112.8 mm", "170 mm"],
                      "height_deviation": "0.2 mm", "seed": 1}, )" +
                              motion + R"("time": {"duration": "0.06 s"}, "output": {"spine_rate": "500 Hz"}})");
}

}  // namespace musim::lsdem::tests
