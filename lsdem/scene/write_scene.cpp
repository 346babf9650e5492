#include <nlohmann/json.hpp>

#include "lsdem/scene/scene_json.hpp"
#include "scaling/detail/overloaded.hpp"

namespace musim::lsdem {

const std::vector<std::string>& face_contact_names() {
    static const std::vector<std::string> kNames{"overlap", "nodes"};
    return kNames;
}

namespace {

using nlohmann::ordered_json;
using scaling::detail::Overloaded;

constexpr std::array kAxes{"x", "y", "z"};

template <class Quantity>
ordered_json to_json(const Triple<Quantity>& triple) {
    return {triple[0].value(), triple[1].value(), triple[2].value()};
}

template <class Quantity>
void put(ordered_json& object, const char* key, const std::optional<Quantity>& value) {
    if (value) object[key] = value->value();
}

ordered_json to_json(const BlockMaterial& material) {
    return {{"density", material.density.value()},
            {"normal_stiffness", material.normal_stiffness.value()},
            {"shear_stiffness", material.shear_stiffness.value()},
            {"friction", material.friction},
            {"restitution", material.restitution},
            {"shear_damping_ratio", material.shear_damping_ratio}};
}

ordered_json to_json(const ShapeSettings& shape, bool has_contact_nodes) {
    return std::visit(
        Overloaded{[&](const BoxShape& s) -> ordered_json {
                       ordered_json box{{"kind", "box"}, {"level_set", "box"}};
                       if (has_contact_nodes) box["nodes_per_face"] = s.nodes_per_face;
                       return box;
                   },
                   [](const GridShape& s) -> ordered_json {
                       return {{"kind", "box"}, {"level_set", "grid"}, {"nodes_per_face", s.nodes_per_face}, {"voxel", s.voxel.value()}};
                   },
                   [](const SphereShape& s) -> ordered_json {
                       return {{"kind", "sphere"}, {"radius", s.radius.value()}, {"nodes", s.nodes}, {"voxel", s.voxel.value()}};
                   }},
        shape);
}

ordered_json to_json(const BlockEntry& block, bool with_size) {
    ordered_json object;
    if (with_size) object["size"] = to_json(block.size);
    object["position"] = to_json(block.position);
    object["quaternion"] = block.quaternion;
    object["velocity"] = to_json(block.velocity);
    object["angular_velocity"] = to_json(block.angular_velocity);
    object["fixed"] = block.fixed;
    object["rotation_locked"] = block.rotation_locked;
    if (!block.material.empty()) object["material"] = block.material;
    return object;
}

template <class Layered>
void put_heights(ordered_json& object, const Layered& structure) {
    object["height_deviation"] = structure.height_deviation.value();
    object["seed"] = structure.seed;
}

ordered_json to_json(const Tower& tower) {
    ordered_json tiling{{"cells_across", tower.tiling.cells_across},
                        {"inner_radius", tower.tiling.inner_radius},
                        {"outer_radius", tower.tiling.outer_radius}};
    if (tower.tiling_file) tiling["file"] = tower.tiling_file->string();
    ordered_json object{{"kind", "tower"}, {"layers", tower.layers}, {"block", to_json(tower.block)}};
    put(object, "pitch", tower.pitch);
    object["tiling"] = tiling;
    put_heights(object, tower);
    return object;
}

ordered_json to_json(const Structure& structure, bool with_size) {
    return std::visit(Overloaded{[&](const BlockList& list) -> ordered_json {
                                     ordered_json blocks = ordered_json::array();
                                     for (const BlockEntry& block : list.blocks) blocks.push_back(to_json(block, with_size));
                                     return {{"kind", "blocks"}, {"blocks", blocks}};
                                 },
                                 [](const Column& column) -> ordered_json {
                                     ordered_json object{{"kind", "column"},
                                                         {"layers", column.layers},
                                                         {"block", to_json(column.block)},
                                                         {"rotation_locked", column.rotation_locked}};
                                     put_heights(object, column);
                                     return object;
                                 },
                                 [](const Tower& tower) { return to_json(tower); },
                                 [](const Wall& wall) -> ordered_json {
                                     ordered_json object{{"kind", "wall"},
                                                         {"layers", wall.layers},
                                                         {"blocks_per_layer", wall.blocks_per_layer},
                                                         {"block", to_json(wall.block)}};
                                     put(object, "pitch", wall.pitch);
                                     put_heights(object, wall);
                                     return object;
                                 }},
                      structure);
}

ordered_json to_json(const RecordMotion& motion) {
    ordered_json object{{"record", motion.file.string()}, {"components", ordered_json::object()}};
    for (std::size_t axis = 0; axis < 3; ++axis) {
        if (motion.components[axis]) object["components"][kAxes[axis]] = *motion.components[axis];
    }
    if (motion.unit) object["unit"] = *motion.unit;
    if (motion.quantity) object["quantity"] = records::to_string(*motion.quantity);
    put(object, "dt", motion.dt);
    if (motion.window) object["window"] = {(*motion.window)[0].value(), (*motion.window)[1].value()};
    put(object, "highpass", motion.highpass_corner);
    if (motion.scale) {
        auto [law, set] = *motion.scale;
        ordered_json& scale = object["scale"] = {{"law", law}};
        for (const scaling::ChosenScale& chosen : scaling::kChosenScales) {
            if (const auto given = set.extract(chosen.quantity)) scale[chosen.name] = given.mapped();
        }
        if (!set.empty()) scale["set"] = set;
    }
    return object;
}

ordered_json to_json(const SignalMotion& motion) {
    ordered_json object = std::visit(
        Overloaded{
            [](const StepSignal& s) -> ordered_json {
                return {{"signal", "step"}, {"velocity", s.velocity.value()}};
            },
            [](const SineSignal& s) -> ordered_json {
                return {{"signal", "sine"}, {"amplitude", s.amplitude.value()}, {"frequency", s.frequency.value()}, {"cycles", s.cycles}};
            },
            [](const HalfSineSignal& s) -> ordered_json {
                return {{"signal", "half_sine"}, {"amplitude", s.amplitude.value()}, {"duration", s.duration.value()}};
            },
            [](const RickerSignal& s) -> ordered_json {
                return {{"signal", "ricker"}, {"amplitude", s.amplitude.value()}, {"frequency", s.frequency.value()}};
            },
            [](const SyntheticSignal& s) -> ordered_json {
                return {{"signal", "synthetic"},          {"pga", s.pga.value()}, {"pgv", s.pgv.value()},
                        {"duration", s.duration.value()}, {"dt", s.dt.value()},   {"seed", s.seed}};
            }},
        motion.signal);
    object["direction"] = kAxes[static_cast<std::size_t>(motion.axis)];
    object["start"] = motion.start.value();
    put(object, "dt", motion.dt);
    return object;
}

ordered_json to_json(const SceneMotion& motion) {
    ordered_json object =
        std::visit(Overloaded{[](std::monostate) -> ordered_json { return nullptr; }, [](const auto& source) { return to_json(source); }},
                   motion.source);
    if (object.is_null()) return object;
    const MotionFactors& factors = motion.factors;
    object["factors"] = {{"time", factors.time}, {"velocity", factors.velocity}};
    if (factors.velocity_vertical != factors.velocity) object["factors"]["velocity_vertical"] = factors.velocity_vertical;
    return object;
}

ordered_json to_json(const MotionEntry& entry) {
    ordered_json object{{"name", entry.name}, {"base_motion", to_json(entry.base_motion)}};
    put(object, "duration", entry.duration);
    object["settle"] = entry.settle;
    object["repeat"] = entry.repeat;
    return object;
}

/// With a list of motions, a duration that is not given stays so.
ordered_json to_json(const TimeSettings& settings, bool has_motions) {
    ordered_json time = ordered_json::object();
    if (!has_motions || settings.duration.value() > 0.0) time["duration"] = settings.duration.value();
    time["step"] = "auto";
    time["safety"] = settings.safety;
    put(time, "step", settings.step);
    return time;
}

}  // namespace

std::string write_scene(const Scene& scene) {
    const bool with_size = !std::holds_alternative<SphereShape>(scene.shape);
    ordered_json materials = ordered_json::object();
    for (const auto& [name, material] : scene.materials) materials[name] = to_json(material);
    ordered_json ground{{"present", scene.ground.present}};
    if (scene.ground.friction) ground["friction"] = *scene.ground.friction;
    ordered_json motions = ordered_json::array();
    for (const MotionEntry& entry : scene.motions) motions.push_back(to_json(entry));
    ordered_json output{{"spine_rate", scene.output.spine_rate.value()}};
    put(output, "frame_rate", scene.output.frame_rate);

    ordered_json root{{"schema", "musim-scene/1"},
                      {"name", scene.name},
                      {"gravity", to_json(scene.gravity)},
                      {"material", to_json(scene.material)},
                      {"materials", materials},
                      {"shape", to_json(scene.shape, scene.has_contact_nodes())},
                      {"structure", to_json(scene.structure, with_size)},
                      {scene.motions.empty() ? "base_motion" : "motions", scene.motions.empty() ? to_json(scene.base_motion) : motions},
                      {"ground", ground},
                      {"contact",
                       {{"nodes", scene.contact_nodes == ContactNodes::leader ? "leader" : "both"},
                        {"stiffness", scene.stiffness_sharing == StiffnessSharing::per_area ? "per_area" : "per_contact"},
                        {"faces", face_contact_names().at(static_cast<std::size_t>(scene.face_contact))}}},
                      {"time", to_json(scene.time, !scene.motions.empty())},
                      {"output", output}};
    if (scene.preparation && scene.preparation->none) {
        root["preparation"] = "none";
    } else if (scene.preparation) {
        ordered_json preparation = ordered_json::object();
        if (scene.preparation->placing) preparation["placing"] = to_string(*scene.preparation->placing);
        put(preparation, "damping_rate", scene.preparation->damping_rate);
        if (scene.preparation->specimen) preparation["specimen"] = scene.preparation->specimen->string();
        root["preparation"] = preparation;
    }
    if (scene.accuracy) root["accuracy"] = to_string(*scene.accuracy);
    return root.dump(2) + "\n";
}

}  // namespace musim::lsdem
