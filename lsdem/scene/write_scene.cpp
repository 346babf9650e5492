#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "lsdem/scene/detail/scene_to_json.hpp"
#include "lsdem/scene/scene_json.hpp"
#include "scaling/detail/overloaded.hpp"
#include "scaling/quantity_text.hpp"

namespace musim::lsdem {

const std::vector<std::string>& face_contact_names() {
    static const std::vector<std::string> kNames{"overlap", "nodes"};
    return kNames;
}

namespace {

using detail::QuantityStyle;
using nlohmann::ordered_json;
using scaling::detail::Overloaded;

constexpr std::array kAxes{"x", "y", "z"};

/// Significant digits of a quantity as text: more than is ever measured.
constexpr int kDigits = 7;

/// Writes the parts of a scene with quantities in one style.
class SceneWriter {
  public:
    explicit SceneWriter(QuantityStyle style) : style_(style) {}

    ordered_json to_json(const Scene& scene) const {
        const bool with_size = !std::holds_alternative<SphereShape>(scene.shape);
        ordered_json materials = ordered_json::object();
        for (const auto& [name, material] : scene.materials) materials[name] = to_json(material);
        ordered_json ground{{"present", scene.ground.present}};
        if (scene.ground.friction) ground["friction"] = *scene.ground.friction;
        ordered_json motions = ordered_json::array();
        for (const MotionEntry& entry : scene.motions) motions.push_back(to_json(entry));
        ordered_json output{{"spine_rate", write(scene.output.spine_rate)}};
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
        return root;
    }

  private:
    template <class Quantity>
    ordered_json write(Quantity quantity) const {
        if (style_ == QuantityStyle::text) return scaling::format_quantity(quantity, kDigits);
        return quantity.value();
    }

    /// Times of a record, which are read beside each other.
    ordered_json write_seconds(scaling::Time time) const {
        if (style_ == QuantityStyle::text) return fmt::format("{:.{}g} s", time.value(), kDigits);
        return time.value();
    }

    template <class Quantity>
    ordered_json to_json(const Triple<Quantity>& triple) const {
        return {write(triple[0]), write(triple[1]), write(triple[2])};
    }

    template <class Quantity>
    void put(ordered_json& object, const char* key, const std::optional<Quantity>& value) const {
        if (value) object[key] = write(*value);
    }

    ordered_json to_json(const BlockMaterial& material) const {
        return {{"density", write(material.density)},
                {"normal_stiffness", write(material.normal_stiffness)},
                {"shear_stiffness", write(material.shear_stiffness)},
                {"friction", material.friction},
                {"restitution", material.restitution},
                {"shear_damping_ratio", material.shear_damping_ratio}};
    }

    ordered_json to_json(const ShapeSettings& shape, bool has_contact_nodes) const {
        return std::visit(
            Overloaded{[&](const BoxShape& s) -> ordered_json {
                           ordered_json box{{"kind", "box"}, {"level_set", "box"}};
                           if (has_contact_nodes) box["nodes_per_face"] = s.nodes_per_face;
                           return box;
                       },
                       [&](const GridShape& s) -> ordered_json {
                           return {{"kind", "box"}, {"level_set", "grid"}, {"nodes_per_face", s.nodes_per_face}, {"voxel", write(s.voxel)}};
                       },
                       [&](const SphereShape& s) -> ordered_json {
                           return {{"kind", "sphere"}, {"radius", write(s.radius)}, {"nodes", s.nodes}, {"voxel", write(s.voxel)}};
                       }},
            shape);
    }

    ordered_json to_json(const BlockEntry& block, bool with_size) const {
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
    void put_heights(ordered_json& object, const Layered& structure) const {
        object["height_deviation"] = write(structure.height_deviation);
        object["seed"] = structure.seed;
    }

    ordered_json to_json(const Tower& tower) const {
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

    ordered_json to_json(const Structure& structure, bool with_size) const {
        return std::visit(Overloaded{[&](const BlockList& list) -> ordered_json {
                                         ordered_json blocks = ordered_json::array();
                                         for (const BlockEntry& block : list.blocks) blocks.push_back(to_json(block, with_size));
                                         return {{"kind", "blocks"}, {"blocks", blocks}};
                                     },
                                     [&](const Column& column) -> ordered_json {
                                         ordered_json object{{"kind", "column"},
                                                             {"layers", column.layers},
                                                             {"block", to_json(column.block)},
                                                             {"rotation_locked", column.rotation_locked}};
                                         put_heights(object, column);
                                         return object;
                                     },
                                     [&](const Tower& tower) { return to_json(tower); },
                                     [&](const Wall& wall) -> ordered_json {
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

    ordered_json to_json(const RecordMotion& motion) const {
        ordered_json object{{"record", motion.file.string()}, {"components", ordered_json::object()}};
        for (std::size_t axis = 0; axis < 3; ++axis) {
            if (motion.components[axis]) object["components"][kAxes[axis]] = *motion.components[axis];
        }
        if (motion.unit) object["unit"] = *motion.unit;
        if (motion.quantity) object["quantity"] = records::to_string(*motion.quantity);
        put(object, "dt", motion.dt);
        if (motion.window) object["window"] = {write_seconds((*motion.window)[0]), write_seconds((*motion.window)[1])};
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

    ordered_json to_json(const SignalMotion& motion) const {
        ordered_json object = std::visit(
            Overloaded{
                [&](const StepSignal& s) -> ordered_json {
                    return {{"signal", "step"}, {"velocity", write(s.velocity)}};
                },
                [&](const SineSignal& s) -> ordered_json {
                    return {{"signal", "sine"}, {"amplitude", write(s.amplitude)}, {"frequency", write(s.frequency)}, {"cycles", s.cycles}};
                },
                [&](const HalfSineSignal& s) -> ordered_json {
                    return {{"signal", "half_sine"}, {"amplitude", write(s.amplitude)}, {"duration", write(s.duration)}};
                },
                [&](const RickerSignal& s) -> ordered_json {
                    return {{"signal", "ricker"}, {"amplitude", write(s.amplitude)}, {"frequency", write(s.frequency)}};
                },
                [&](const SyntheticSignal& s) -> ordered_json {
                    return {{"signal", "synthetic"},         {"pga", write(s.pga)}, {"pgv", write(s.pgv)},
                            {"duration", write(s.duration)}, {"dt", write(s.dt)},   {"seed", s.seed}};
                }},
            motion.signal);
        object["direction"] = kAxes[static_cast<std::size_t>(motion.axis)];
        object["start"] = write(motion.start);
        put(object, "dt", motion.dt);
        return object;
    }

    ordered_json to_json(const SceneMotion& motion) const {
        ordered_json object = std::visit(
            Overloaded{[](std::monostate) -> ordered_json { return nullptr; }, [&](const auto& source) { return to_json(source); }},
            motion.source);
        if (object.is_null()) return object;
        const MotionFactors& factors = motion.factors;
        object["factors"] = {{"time", factors.time}, {"velocity", factors.velocity}};
        if (factors.velocity_vertical != factors.velocity) object["factors"]["velocity_vertical"] = factors.velocity_vertical;
        return object;
    }

    ordered_json to_json(const MotionEntry& entry) const {
        ordered_json object{{"name", entry.name}, {"base_motion", to_json(entry.base_motion)}};
        put(object, "duration", entry.duration);
        object["settle"] = entry.settle;
        object["repeat"] = entry.repeat;
        return object;
    }

    /// With a list of motions, a duration that is not given stays so.
    ordered_json to_json(const TimeSettings& settings, bool has_motions) const {
        ordered_json time = ordered_json::object();
        if (!has_motions || settings.duration.value() > 0.0) time["duration"] = write(settings.duration);
        time["step"] = "auto";
        time["safety"] = settings.safety;
        put(time, "step", settings.step);
        return time;
    }

    QuantityStyle style_;
};

}  // namespace

ordered_json detail::to_json(const Scene& scene, QuantityStyle style) { return SceneWriter(style).to_json(scene); }

std::string write_scene(const Scene& scene) { return detail::to_json(scene, QuantityStyle::si_number).dump(2) + "\n"; }

}  // namespace musim::lsdem
