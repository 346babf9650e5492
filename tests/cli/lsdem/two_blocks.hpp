#pragma once

#include <string>

namespace musim::cli {

/// A small scene: a stack of two blocks that slides on a shaken ground, with parts that can be spoilt.
struct SceneText {
    std::string density = "\"2320 kg/m^3\"";
    std::string stiffness = "\"2 GN/m\"";
    std::string second_block_z = "\"1.5 m\"";
    std::string step = "\"auto\"";
    std::string restitution = "0.3";

    std::string text() const {
        return R"({"schema": "musim-scene/1", "name": "two blocks",
 "material": {"density": )" +
               density + R"(, "normal_stiffness": )" + stiffness + R"(, "shear_stiffness": "2 GN/m", "friction": 0.3, "restitution": )" +
               restitution + R"(},
 "structure": {"kind": "blocks", "blocks": [
   {"size": ["2 m", "2 m", "1 m"], "position": ["0 m", "0 m", "0.5 m"]},
   {"size": ["2 m", "2 m", "1 m"], "position": ["0 m", "0 m", )" +
               second_block_z + R"(]}]},
 "base_motion": {"signal": "sine", "direction": "x", "amplitude": "0.6 g", "frequency": "2 Hz", "cycles": 1},
 "time": {"duration": "0.5 s", "step": )" +
               step + R"(}, "output": {"spine_rate": "200 Hz"}})";
    }
};

}  // namespace musim::cli
