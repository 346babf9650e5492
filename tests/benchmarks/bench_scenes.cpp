#include "tests/benchmarks/bench_scenes.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <utility>
#include <vector>

#include "lsdem/run/equilibrium.hpp"
#include "lsdem/scene/build_model.hpp"
#include "lsdem/scene/material_presets.hpp"
#include "lsdem/solid/basic_solids.hpp"
#include "lsdem/time_step.hpp"

namespace musim::benchmarks {
namespace {

using lsdem::Scene;

constexpr int kLayers = 38;

Scene wood_scene() {
    const auto& preset = lsdem::find_material_preset("wood");
    Scene scene;
    scene.material = preset.material;
    scene.time.duration = 1.0 * scaling::si::second;
    return scene;
}

/// Under its weight before it is timed; what has no equilibrium stays as it is.
lsdem::Model at_rest(lsdem::Model model) {
    lsdem::Specimen specimen{std::move(model), {}, {}, {}};
    lsdem::put_in_equilibrium(specimen, lsdem::compute_critical_time_step(specimen.model));
    return std::move(specimen.model);
}

lsdem::Model make_column(int layers) {
    Scene scene = wood_scene();
    scene.structure = lsdem::Column{.layers = layers, .block = lsdem::find_material_preset("wood").reference_block};
    lsdem::Model model = at_rest(lsdem::make_model(scene));
    model.numerics.skip_rest = false;
    return model;
}

Scene tower_scene() {
    lsdem::Tower tower;
    tower.layers = kLayers;
    tower.block = lsdem::find_material_preset("wood").reference_block;
    Scene scene = wood_scene();
    scene.structure = tower;
    return scene;
}

lsdem::Model make_tower(lsdem::FaceContact faces = lsdem::FaceContact::overlap) {
    Scene scene = tower_scene();
    scene.face_contact = faces;
    lsdem::Model model = at_rest(lsdem::make_model(scene));
    model.numerics.skip_rest = false;
    return model;
}

/// Towers in a row, two diameters apart.
lsdem::Model make_towers(int count) {
    lsdem::Model model = make_tower();
    const std::vector<lsdem::Block> first = model.blocks;
    const std::vector<lsdem::Preload> held = model.preload;
    double reach = 0.0;
    for (const lsdem::Block& block : first) reach = std::max(reach, block.position.x());
    for (int i = 1; i < count; ++i) {
        for (lsdem::Block block : first) {
            block.position.x() += 4.0 * reach * i;
            model.blocks.push_back(block);
        }
        const std::size_t offset = static_cast<std::size_t>(i) * first.size();
        for (lsdem::Preload preload : held) {
            preload.leader += offset;
            if (preload.follower) *preload.follower += offset;
            model.preload.push_back(preload);
        }
    }
    return model;
}

/// Layers alternate in velocity and slide on each other with little friction: they keep sliding while they are timed, and do not go far.
lsdem::Model make_sliding_tower() {
    constexpr double kSpeed = 0.01;
    Scene scene = tower_scene();
    scene.material.friction = 0.01;
    lsdem::BuiltModel built = lsdem::build_model(scene);
    for (std::size_t i = 0; i < built.model.blocks.size(); ++i)
        built.model.blocks[i].velocity.x() = built.structure.layer[i] % 2 == 0 ? kSpeed : -kSpeed;
    built.model.numerics.skip_rest = false;
    return built.model;
}

/// Sine of acceleration `amplitude` [m/s²] and 10 Hz along one axis, a quarter of a cycle apart between axes.
lsdem::BaseComponent make_shaking(double amplitude, double phase) {
    constexpr double kDuration = 1.0, kOmega = 2.0 * std::numbers::pi * 10.0;
    constexpr int kSamples = 4000;
    lsdem::BaseComponent component;
    component.dt = kDuration / kSamples;
    for (int k = 0; k <= kSamples; ++k)
        component.velocity.push_back(amplitude / kOmega * (std::sin(kOmega * component.dt * k + phase) - std::sin(phase)));
    return component;
}

lsdem::Model shaken(lsdem::Model model) {
    model.ground.motion.shift = {make_shaking(9.81, 0.0), make_shaking(7.0, 1.5), make_shaking(3.0, 0.7)};
    return model;
}

lsdem::Model shaken_along_x(lsdem::Model model) {
    model.ground.motion.shift[0] = make_shaking(9.81, 0.0);
    return model;
}

lsdem::Model without_friction(lsdem::Model model) {
    model.materials.front().friction = 0.0;
    model.preload.clear();
    return model;
}

lsdem::Model elastic(lsdem::Model model) {
    model.materials.front().restitution = 1.0;
    model.ground.material.restitution = 1.0;
    return model;
}

lsdem::Model without_rotation(lsdem::Model model) {
    for (lsdem::Block& block : model.blocks) block.rotation_locked = true;
    return model;
}

lsdem::Model make_grid_tower() {
    Scene scene = tower_scene();
    scene.shape = lsdem::GridShape{.nodes_per_face = 44, .voxel = 0.65e-3 * scaling::si::meter};
    lsdem::Model model = lsdem::make_model(scene);
    model.numerics.skip_rest = false;
    return model;
}

lsdem::Model make_debris() {
    lsdem::Model model = make_tower();
    model.ground.present = false;
    model.preload.clear();
    for (lsdem::Block& block : model.blocks) {
        block.position *= 2.0;
        block.angular_velocity = {3.0, 2.0, 1.0};
    }
    return model;
}

lsdem::Model make_column_at_rest() {
    lsdem::Model model = make_column(kLayers);
    model.numerics.skip_rest = true;
    return model;
}

/// Ten drums of 24 flats on each other.
lsdem::Model make_drums() {
    constexpr int kDrums = 10;
    lsdem::Model model = make_column(1);
    const double radius = 0.5 * model.shapes[0].half_extents.y(), height = 2.0 * radius;
    const lsdem::Block first = model.blocks[0];
    const double density = first.mass / model.shapes[0].volume;
    model.shapes = {lsdem::make_solid_shape(lsdem::make_drum(radius, height, 24, radius))};
    model.blocks.clear();
    model.preload.clear();
    for (int i = 0; i < kDrums; ++i) {
        lsdem::Block drum;
        drum.mass = density * model.shapes[0].volume;
        drum.position.z() = (i + 0.5) * height;
        model.blocks.push_back(drum);
    }
    return at_rest(std::move(model));
}

/// A half circle of 27 voussoirs between two that are held, thickness a fifth of the radius.
lsdem::Model make_arch() {
    constexpr int kVoussoirs = 27;
    constexpr double kThickness = 0.2, kDepth = 0.3;  // of the radius
    lsdem::Model model = make_column(1);
    const double radius = 10.0 * model.shapes[0].half_extents.z();
    const double density = model.blocks[0].mass / model.shapes[0].volume, half = 0.5 * std::numbers::pi / kVoussoirs;
    // drawn with its bed joints across z, about the middle of the arch
    std::vector<Eigen::Vector2d> outline;
    for (const auto& [side, r] : {std::pair{-1.0, 1.0 - 0.5 * kThickness},
                                  {-1.0, 1.0 + 0.5 * kThickness},
                                  {1.0, 1.0 + 0.5 * kThickness},
                                  {1.0, 1.0 - 0.5 * kThickness}}) {
        outline.emplace_back(radius * r * std::cos(half), side * radius * r * std::sin(half));
    }
    const Eigen::Matrix3d upright = Eigen::AngleAxisd(0.5 * std::numbers::pi, Eigen::Vector3d::UnitX()).toRotationMatrix();
    const lsdem::Solid drawn = lsdem::moved(lsdem::make_prism(outline, kDepth * radius), {upright, Eigen::Vector3d::Zero()});
    model.shapes = {lsdem::make_solid_shape(drawn)};
    model.blocks.clear();
    model.preload.clear();
    model.ground.present = false;
    const lsdem::Placing own = model.shapes[0].own.inverse();
    for (int i = -1; i <= kVoussoirs; ++i) {
        const lsdem::Quaternion turn(Eigen::AngleAxisd(-(2.0 * i + 1.0) * half, Eigen::Vector3d::UnitY()));
        lsdem::Block block;
        block.mass = density * model.shapes[0].volume;
        block.orientation = turn * lsdem::Quaternion(own.rotation);
        block.position = turn * own.position;
        block.fixed = i < 0 || i == kVoussoirs;
        model.blocks.push_back(block);
    }
    return at_rest(std::move(model));
}

/// Voussoirs that have been hit from all sides: each moves by itself.
lsdem::Model hit(lsdem::Model model) {
    constexpr double kSpeed = 0.02;
    for (std::size_t i = 0; i < model.blocks.size(); ++i) {
        if (!model.blocks[i].fixed) model.blocks[i].velocity.x() = i % 2 == 0 ? kSpeed : -kSpeed;
    }
    return model;
}

}  // namespace

std::vector<BenchScene> make_bench_scenes() {
    constexpr double kStrong = 0.02, kSlow = 5e4;
    std::vector<BenchScene> scenes;
    scenes.push_back({"single_block", [] { return make_column(1); }});
    scenes.push_back({"column", [] { return make_column(kLayers); }});
    scenes.push_back({"tower", [] { return make_tower(); }});
    scenes.push_back({"tower_sliding", make_sliding_tower});
    scenes.push_back({"tower_shaken", [] { return shaken(make_tower()); }, kStrong});
    scenes.push_back({"shaken_one_component", [] { return shaken_along_x(make_tower()); }, kStrong});
    scenes.push_back({"shaken_no_friction", [] { return without_friction(shaken(make_tower())); }, kStrong});
    scenes.push_back({"shaken_elastic", [] { return elastic(shaken(make_tower())); }, kStrong});
    scenes.push_back({"shaken_no_rotation", [] { return without_rotation(shaken(make_tower())); }, kStrong});
    scenes.push_back({"tower_nodes", [] { return make_tower(lsdem::FaceContact::nodes); }});
    scenes.push_back({"tower_grid", make_grid_tower});
    scenes.push_back({"drums", make_drums, 0.0, kSlow});
    scenes.push_back({"drums_shaken", [] { return shaken(make_drums()); }, kStrong, kSlow});
    scenes.push_back({"arch", make_arch, 0.0, kSlow});
    scenes.push_back({"arch_hit", [] { return hit(make_arch()); }, 0.0, kSlow});
    scenes.push_back({"column_at_rest", make_column_at_rest});
    scenes.push_back({"column_waiting", [] { return make_column(kLayers); }});
    scenes.push_back({"debris", make_debris});
    scenes.push_back({"towers_28k", [] { return make_towers(4); }});
    scenes.push_back({"towers_200k", [] { return make_towers(28); }});
    return scenes;
}

}  // namespace musim::benchmarks
