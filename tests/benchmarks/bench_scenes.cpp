#include "tests/benchmarks/bench_scenes.hpp"

#include "lsdem/scene/build_model.hpp"
#include "lsdem/scene/material_presets.hpp"

namespace musim::benchmarks {
namespace {

using lsdem::scene::Scene;

Scene wood_scene() {
    const auto& preset = lsdem::scene::find_material_preset("wood");
    Scene scene;
    scene.material = preset.material;
    scene.time.duration = 1.0 * scaling::si::second;
    return scene;
}

lsdem::Model make_column(int layers) {
    Scene scene = wood_scene();
    scene.structure = lsdem::scene::Column{.layers = layers, .block = lsdem::scene::find_material_preset("wood").reference_block};
    return lsdem::scene::make_model(scene);
}

/// 38 layers of 188 wood blocks.
lsdem::scene::Tower make_papers_tower() {
    lsdem::scene::Tower tower;
    tower.block = lsdem::scene::find_material_preset("wood").reference_block;
    return tower;
}

lsdem::Model make_full_tower() {
    Scene scene = wood_scene();
    scene.structure = make_papers_tower();
    return lsdem::scene::make_model(scene);
}

/// Layers alternate in velocity by 0.1 m/s and slide on each other with little friction, so that they keep sliding while they are timed.
lsdem::Model make_sliding_tower() {
    Scene scene = wood_scene();
    scene.material.friction = 0.01;
    scene.structure = make_papers_tower();
    lsdem::scene::BuiltModel built = lsdem::scene::build_model(scene);
    for (std::size_t i = 0; i < built.model.blocks.size(); ++i)
        built.model.blocks[i].velocity.x() = built.structure.layer[i] % 2 == 0 ? 0.1 : -0.1;
    return built.model;
}

}  // namespace

std::vector<BenchScene> make_bench_scenes() {
    std::vector<BenchScene> scenes;
    scenes.push_back({"single_block", make_column(1)});
    scenes.push_back({"column", make_column(38)});
    scenes.push_back({"full_tower", make_full_tower()});
    scenes.push_back({"full_tower_sliding", make_sliding_tower()});
    return scenes;
}

}  // namespace musim::benchmarks
