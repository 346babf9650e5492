#pragma once

#include <filesystem>
#include <string>

#include "lsdem/run/run.hpp"
#include "lsdem/run/specimen_batch.hpp"
#include "lsdem/scene/scene_json.hpp"

namespace musim::lsdem {

/// A wall of two blocks a layer whose heights scatter.
inline Scene make_wall_scene(int layers = 4, const std::string& more = "") {
    return parse_scene(
        R"({"schema": "musim-scene/1", "name": "uneven wall", "material": "wood", "structure": {"kind": "wall", "layers": )" +
        std::to_string(layers) +
        R"(, "blocks_per_layer": 2, "block": ["12.710 mm", "26.355 mm", "39.780 mm"], "height_deviation": "0.155 mm",
        "seed": 3}, "time": {"duration": "10 ms"}, "output": {"spine_rate": "4800 Hz"})" +
        more + "}");
}

/// The damping rate with which a specimen is prepared [1/s].
inline double prepared_rate(const Scene& scene, const Specimen& upright) { return find_preparation(scene, upright).settling.damping_rate; }

/// A batch of one specimen of a scene.
inline SpecimenBatch make_batch(const std::filesystem::path& folder, const Scene& scene) {
    return {.scene = scene, .seeds = {3}, .folder = folder, .version = "test", .threads = 1};
}

}  // namespace musim::lsdem
