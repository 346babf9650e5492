#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "lsdem/scene/detail/json_object.hpp"
#include "lsdem/scene/detail/json_text.hpp"
#include "lsdem/scene/detail/parse_material.hpp"
#include "lsdem/scene/scene_json.hpp"
#include "scaling/nearest_name.hpp"
#include "scaling/scale_law_catalogue.hpp"

namespace musim::lsdem::scene {

namespace {

using detail::fail;
using detail::JsonObject;
using detail::JsonPlace;
using detail::parse_material;
using nlohmann::json;

/// Only this version of the format is known.
constexpr std::string_view kSchemaName = "musim-scene/1";

const std::vector<std::string>& axis_names() {
    static const std::vector<std::string> kNames{"x", "y", "z"};
    return kNames;
}

/// A file named in a scene, beside the scene's own.
std::filesystem::path resolve(const std::string& file, const std::filesystem::path& origin) {
    return std::filesystem::absolute(origin.parent_path() / file).lexically_normal();
}

ShapeSettings parse_shape(const json& value, const JsonPlace& place) {
    const JsonObject object(value, place, "shape");
    const bool sphere = object.choice("kind", {"box", "sphere"}) == 1;
    if (sphere) {
        SphereShape shape;
        shape.radius = object.quantity<scaling::Length>("radius");
        shape.voxel = object.quantity<scaling::Length>("voxel");
        object.read("nodes", shape.nodes);
        return shape;
    }
    BoxShape box;
    object.read("nodes_per_face", box.nodes_per_face);
    const bool grid = object.has("level_set") && object.choice("level_set", {"box", "grid"}) == 1;
    if (!grid) return box;
    return GridShape{box.nodes_per_face, object.quantity<scaling::Length>("voxel")};
}

BlockEntry parse_block(const json& value, const JsonPlace& place, bool needs_size) {
    const JsonObject object(value, place, "block");
    BlockEntry block;
    if (needs_size || object.has("size")) block.size = object.triple<scaling::Length>("size");
    block.position = object.triple<scaling::Length>("position");
    if (object.has("quaternion")) {
        const json& list = object.get("quaternion");
        const JsonPlace where = object.place("quaternion");
        if (!list.is_array() || list.size() != 4) fail(where, "four numbers (w, x, y, z) are wanted; correct the list");
        for (std::size_t k = 0; k < 4; ++k) block.quaternion[k] = detail::to_number(list[k], where.at(k));
    }
    if (object.has("velocity")) block.velocity = object.triple<scaling::Velocity>("velocity");
    if (object.has("angular_velocity")) block.angular_velocity = object.triple<scaling::Frequency>("angular_velocity");
    object.read("fixed", block.fixed);
    object.read("rotation_locked", block.rotation_locked);
    object.read("material", block.material);
    return block;
}

TilingSettings find_preset_tiling(const std::string& name, const JsonPlace& place) {
    try {
        return find_tiling_preset(name);
    } catch (const SceneError& error) {
        fail(place, error.what());
    }
}

void parse_tiling_choice(const JsonObject& tower, const std::filesystem::path& origin, Tower& result) {
    if (!tower.has("tiling")) return;
    const json& value = tower.get("tiling");
    if (value.is_string()) {
        result.tiling = find_preset_tiling(value.get<std::string>(), tower.place("tiling"));
        return;
    }
    const JsonObject object(value, tower.place("tiling"), "tiling");
    object.read("cells_across", result.tiling.cells_across);
    object.read("inner_radius", result.tiling.inner_radius);
    object.read("outer_radius", result.tiling.outer_radius);
    if (object.has("file")) result.tiling_file = resolve(object.text("file"), origin);
}

BlockList parse_block_list(const JsonObject& object, bool needs_size) {
    const json& entries = object.get("blocks");
    const JsonPlace place = object.place("blocks");
    if (!entries.is_array()) fail(place, "a list [ ... ] of blocks is wanted; correct the value");
    BlockList list;
    for (std::size_t k = 0; k < entries.size(); ++k) list.blocks.push_back(parse_block(entries[k], place.at(k), needs_size));
    return list;
}

template <class Layered>
void read_heights(const JsonObject& object, Layered& structure) {
    object.read_quantity("height_deviation", structure.height_deviation);
    object.read("seed", structure.seed);
}

Column parse_column(const JsonObject& object) {
    Column column;
    column.block = object.triple<scaling::Length>("block");
    object.read("layers", column.layers);
    object.read("rotation_locked", column.rotation_locked);
    read_heights(object, column);
    return column;
}

Wall parse_wall(const JsonObject& object) {
    Wall wall;
    wall.block = object.triple<scaling::Length>("block");
    object.read("layers", wall.layers);
    object.read("blocks_per_layer", wall.blocks_per_layer);
    wall.pitch = object.optional_quantity<scaling::Length>("pitch");
    read_heights(object, wall);
    return wall;
}

Tower parse_tower(const JsonObject& object, const std::filesystem::path& origin) {
    Tower tower;
    tower.block = object.triple<scaling::Length>("block");
    object.read("layers", tower.layers);
    tower.pitch = object.optional_quantity<scaling::Length>("pitch");
    parse_tiling_choice(object, origin, tower);
    read_heights(object, tower);
    return tower;
}

/// The text at `key`, which tells the kind of an object and so which other keys it may have.
std::string parse_kind(const json& value, const JsonPlace& place, const std::string& key, const std::vector<std::string>& kinds) {
    if (!value.is_object() || !value.contains(key)) {
        fail(place, fmt::format("an object with a \"{}\" is wanted ({}); add it", key, detail::join(kinds)));
    }
    std::string kind = detail::to_text(value.at(key), place.at(key));
    if (std::find(kinds.begin(), kinds.end(), kind) == kinds.end()) {
        fail(place.at(key), fmt::format("\"{}\" is not known; {}", kind, scaling::suggest_name(kind, kinds)));
    }
    return kind;
}

Structure parse_structure(const json& value, const JsonPlace& place, const std::filesystem::path& origin, bool needs_size) {
    const std::string kind = parse_kind(value, place, "kind", {"blocks", "column", "tower", "wall"});
    const JsonObject object(value, place, kind);
    if (kind == "blocks") return parse_block_list(object, needs_size);
    if (kind == "column") return parse_column(object);
    if (kind == "wall") return parse_wall(object);
    return parse_tower(object, origin);
}

RecordScale parse_record_scale(const json& value, const JsonPlace& place, const std::filesystem::path& origin) {
    const JsonObject object(value, place, "scale");
    RecordScale scale;
    object.read("law", scale.law);
    for (const scaling::ChosenScale& chosen : scaling::kChosenScales) {
        if (object.has(chosen.name)) object.read(chosen.name, scale.set[chosen.quantity]);
    }
    if (object.has("set")) {
        const json& set = object.get("set");
        const JsonPlace where = object.place("set");
        if (!set.is_object()) fail(where, R"(an object of factors is wanted; write {"F_R": "1/500"})");
        for (const auto& [name, factor] : set.items()) {
            if (!scale.set.emplace(name, detail::to_number(factor, where.at(name))).second) {
                fail(where.at(name), "the factor is given twice; give it once");
            }
        }
    }
    if (scaling::find_scale_law(scale.law)) return scale;
    if (scale.law.find_first_of("./") == std::string::npos) fail(object.place("law"), scaling::no_such_law(scale.law) + ", or a law file");
    scale.law = resolve(scale.law, origin).string();
    return scale;
}

RecordMotion parse_record(const JsonObject& object, const std::filesystem::path& origin) {
    RecordMotion motion;
    motion.file = resolve(object.text("record"), origin);
    const JsonObject components(object.get("components"), object.place("components"), "components");
    for (std::size_t axis = 0; axis < 3; ++axis) {
        if (components.has(axis_names()[axis])) motion.components[axis] = components.text(axis_names()[axis]);
    }
    if (object.has("unit")) motion.unit = object.text("unit");
    if (object.has("quantity")) {
        const std::vector<std::string> names{"acceleration", "velocity", "displacement"};
        motion.quantity = records::find_sample_quantity(names[object.choice("quantity", names)]);
    }
    motion.dt = object.optional_quantity<scaling::Time>("dt");
    if (object.has("window")) {
        const json& window = object.get("window");
        const JsonPlace place = object.place("window");
        if (!window.is_array() || window.size() != 2) fail(place, "a list of two times is wanted; write [\"225 s\", \"265 s\"]");
        motion.window = {detail::to_quantity<scaling::Time>(window[0], place.at(0)),
                         detail::to_quantity<scaling::Time>(window[1], place.at(1))};
    }
    motion.highpass_corner = object.optional_quantity<scaling::Frequency>("highpass");
    if (object.has("scale")) motion.scale = parse_record_scale(object.get("scale"), object.place("scale"), origin);
    return motion;
}

Signal parse_signal_shape(const JsonObject& object, const std::string& kind) {
    if (kind == "step") return StepSignal{object.quantity<scaling::Velocity>("velocity")};
    if (kind == "synthetic") {
        SyntheticSignal synthetic;
        synthetic.pga = object.quantity<scaling::Acceleration>("pga");
        synthetic.pgv = object.quantity<scaling::Velocity>("pgv");
        synthetic.duration = object.quantity<scaling::Time>("duration");
        synthetic.dt = object.quantity<scaling::Time>("dt");
        object.read("seed", synthetic.seed);
        return synthetic;
    }
    const auto amplitude = object.quantity<scaling::Acceleration>("amplitude");
    if (kind == "half_sine") return HalfSineSignal{amplitude, object.quantity<scaling::Time>("duration")};
    const auto frequency = object.quantity<scaling::Frequency>("frequency");
    if (kind == "ricker") return RickerSignal{amplitude, frequency};
    return SineSignal{amplitude, frequency, object.number("cycles")};
}

SignalMotion parse_signal(const json& value, const JsonPlace& place) {
    const std::string kind = parse_kind(value, place, "signal", {"step", "sine", "half_sine", "ricker", "synthetic"});
    const JsonObject object(value, place, kind);
    SignalMotion motion;
    motion.signal = parse_signal_shape(object, kind);
    if (object.has("direction")) motion.axis = static_cast<int>(object.choice("direction", axis_names()));
    object.read_quantity("start", motion.start);
    // a synthetic record has a time step of its own, a step needs none
    if (kind != "synthetic" && kind != "step") motion.dt = object.optional_quantity<scaling::Time>("dt");
    return motion;
}

BaseMotion parse_base_motion(const json& value, const JsonPlace& place, const std::filesystem::path& origin) {
    BaseMotion motion;
    if (!value.is_object() || value.contains("record") == value.contains("signal")) {
        fail(place, "an object with either a \"record\" or a \"signal\" is wanted; add one of them, or leave base_motion out");
    }
    if (value.contains("record")) {
        motion.source = parse_record(JsonObject(value, place, "record"), origin);
    } else {
        motion.source = parse_signal(value, place);
    }
    if (value.contains("factors")) {
        const JsonObject factors(value.at("factors"), place.at("factors"), "factors");
        factors.read("time", motion.factors.time);
        factors.read("velocity", motion.factors.velocity);
        motion.factors.velocity_vertical = motion.factors.velocity;
        factors.read("velocity_vertical", motion.factors.velocity_vertical);
    }
    return motion;
}

MotionEntry parse_motion(const json& value, const JsonPlace& place, const std::filesystem::path& origin) {
    const JsonObject object(value, place, "motion");
    MotionEntry entry;
    object.read("name", entry.name);
    entry.base_motion = parse_base_motion(object.get("base_motion"), object.place("base_motion"), origin);
    entry.duration = object.optional_quantity<scaling::Time>("duration");
    object.read("settle", entry.settle);
    object.read("repeat", entry.repeat);
    return entry;
}

std::vector<MotionEntry> parse_motions(const JsonObject& object, const std::filesystem::path& origin) {
    const json& list = object.get("motions");
    const JsonPlace place = object.place("motions");
    if (!list.is_array() || list.empty())
        fail(place, "a list [ ... ] of motions is wanted; write at least one, or \"base_motion\" instead");
    std::vector<MotionEntry> motions;
    for (std::size_t k = 0; k < list.size(); ++k) motions.push_back(parse_motion(list[k], place.at(k), origin));
    return motions;
}

/// A magnitude, downwards, or three components; the default stays without either.
void read_gravity(const JsonObject& object, Triple<scaling::Acceleration>& gravity) {
    if (!object.has("gravity")) return;
    const json& value = object.get("gravity");
    const JsonPlace place = object.place("gravity");
    if (!value.is_array()) {
        gravity[2] = -detail::to_quantity<scaling::Acceleration>(value, place);
        return;
    }
    detail::require_triple(value, place);
    for (std::size_t k = 0; k < 3; ++k) gravity[k] = detail::to_quantity<scaling::Acceleration>(value[k], place.at(k));
}

Preparation parse_preparation(const json& value, const JsonPlace& place, const std::filesystem::path& origin) {
    Preparation preparation;
    if (value.is_string()) {
        if (value != "none") fail(place, fmt::format("{} is no preparation; write \"none\", an object, or leave it out", value.dump()));
        preparation.none = true;
        return preparation;
    }
    const JsonObject object(value, place, "preparation");
    if (object.has("placing")) preparation.placing = static_cast<Placing>(object.choice("placing", placing_names()));
    preparation.damping_rate = object.optional_quantity<scaling::Frequency>("damping_rate");
    if (object.has("specimen")) preparation.specimen = resolve(object.text("specimen"), origin);
    return preparation;
}

/// Name of the preset that a material is taken from; empty when all its properties are given.
std::string find_preset_name(const json& material) {
    if (material.is_string()) return material.get<std::string>();
    return material.contains("preset") ? material["preset"].get<std::string>() : std::string();
}

/// Time step of a preset, for a scene whose material is one.
scaling::Time find_camera_step(const std::string& preset, const JsonPlace& place) {
    if (preset.empty()) {
        fail(place, fmt::format("\"camera\" is the step of a material preset, and the scene's material is none (presets are {}); name one, "
                                "or give a step or \"auto\"",
                                detail::join(material_preset_names())));
    }
    return find_material_preset(preset).camera_step;
}

/// `preset`: name of the scene's material, empty for none. With a list of motions the duration may be left out.
TimeSettings parse_time(const JsonObject& object, double safety, const std::string& preset, bool has_motions) {
    TimeSettings time;
    time.safety = safety;
    if (!has_motions || object.has("duration")) time.duration = object.quantity<scaling::Time>("duration");
    const json step = object.has("step") ? object.get("step") : json("auto");
    if (step == "camera") {
        time.step = find_camera_step(preset, object.place("step"));
    } else if (step != "auto") {
        time.step = object.quantity<scaling::Time>("step");
    }
    object.read("safety", time.safety);
    return time;
}

/// Lets an accuracy choose what it stands for; what the scene says itself is read later.
void read_accuracy(const JsonObject& object, Scene& scene) {
    if (!object.has("accuracy")) return;
    scene.accuracy = static_cast<Accuracy>(object.choice("accuracy", accuracy_names()));
    const AccuracyPreset& preset = find_accuracy_preset(*scene.accuracy);
    scene.time.safety = preset.safety;
}

void read_contact(const JsonObject& object, Scene& scene) {
    if (!object.has("contact")) return;
    const JsonObject contact(object.get("contact"), object.place("contact"), "contact");
    if (contact.has("nodes")) {
        scene.contact_nodes = contact.choice("nodes", {"leader", "both"}) == 1 ? ContactNodes::both : ContactNodes::leader;
    }
    if (contact.has("stiffness")) {
        const bool per_contact = contact.choice("stiffness", {"per_area", "per_contact"}) == 1;
        scene.stiffness_sharing = per_contact ? StiffnessSharing::per_contact : StiffnessSharing::per_area;
    }
    // "patch", an old name of overlap, is taken but not offered
    if (contact.has("faces") && contact.get("faces") != "patch") {
        scene.face_contact = static_cast<FaceContact>(contact.choice("faces", face_contact_names()));
    }
    if (contact.has("spacing")) contact.choice("spacing", {"even", "lobatto"});
}

/// Says which settings of a scene change nothing, and which name is an old one.
void remark_settings(const JsonObject& object, const JsonPlace& place, Scene& scene) {
    const auto remark = [&](const JsonPlace& at, const char* why) {
        scene.text.remarks.push_back(fmt::format("{}: {}: {}", at.origin, at.path, why));
    };
    const bool has_nodes = scene.has_contact_nodes();
    if (object.has("shape") && object.get("shape").contains("nodes_per_face") && !has_nodes) {
        remark(place.at("shape").at("nodes_per_face"),
               "boxes meet without nodes, so it changes nothing (it counts with \"contact\": {\"faces\": \"nodes\"})");
    }
    if (!object.has("contact")) return;
    const json& contact = object.get("contact");
    if (contact.contains("faces") && contact["faces"] == "patch") {
        remark(place.at("contact").at("faces"), "\"patch\" is an old name of \"overlap\", which it means; write \"overlap\"");
    }
    if (contact.contains("nodes") && scene.contact_nodes == ContactNodes::both && !has_nodes) {
        remark(place.at("contact").at("nodes"),
               "boxes meet without nodes, so \"both\" changes nothing (it counts with \"contact\": {\"faces\": \"nodes\"})");
    }
    if (contact.contains("spacing")) {
        remark(place.at("contact").at("spacing"), "no contact has a spacing of nodes to choose, so it changes nothing; leave it out");
    }
}

/// Forgets settings of nodes where there are none, so that scenes that mean the same are equal.
void drop_idle_settings(Scene& scene) {
    if (scene.has_contact_nodes()) return;
    scene.shape = BoxShape{};
    scene.contact_nodes = ContactNodes::leader;
}

/// Adds the presets that block entries name to the scene's materials; refuses names that are neither.
void collect_materials(Scene& scene, const JsonPlace& place) {
    const auto* list = std::get_if<BlockList>(&scene.structure);
    if (list == nullptr) return;
    for (std::size_t k = 0; k < list->blocks.size(); ++k) {
        const std::string& name = list->blocks[k].material;
        if (name.empty() || scene.materials.contains(name)) continue;
        scene.materials.emplace(name, parse_material(json(name), place.at("structure").at("blocks").at(k).at("material")));
    }
}

}  // namespace

Scene parse_scene(std::string_view json_text, const std::filesystem::path& origin) {
    const json root = detail::parse_json(json_text, origin.string());
    Scene scene;
    scene.text.origin = origin.string();
    const JsonPlace place{origin.string(), "", &scene.text.plain_number};
    const JsonObject object(root, place, "scene");
    if (object.text("schema") != kSchemaName) {
        fail(place.at("schema"),
             fmt::format("\"{}\" is not a known format; write \"{}\"", object.text("schema"), std::string(kSchemaName)));
    }

    object.read("name", scene.name);
    read_accuracy(object, scene);
    read_gravity(object, scene.gravity);
    scene.material = parse_material(object.get("material"), object.place("material"));
    if (object.has("materials")) {
        if (!object.get("materials").is_object()) {
            fail(object.place("materials"), "an object of named materials is wanted; correct the value");
        }
        for (const auto& [name, value] : object.get("materials").items()) {
            scene.materials.emplace(name, parse_material(value, object.place("materials").at(name)));
        }
    }
    if (object.has("shape")) scene.shape = parse_shape(object.get("shape"), object.place("shape"));
    const bool needs_size = !std::holds_alternative<SphereShape>(scene.shape);
    scene.structure = parse_structure(object.get("structure"), object.place("structure"), origin, needs_size);
    collect_materials(scene, place);
    if (object.has("base_motion")) scene.base_motion = parse_base_motion(object.get("base_motion"), object.place("base_motion"), origin);
    if (object.has("motions")) scene.motions = parse_motions(object, origin);
    if (object.has("ground")) {
        const JsonObject ground(object.get("ground"), object.place("ground"), "ground");
        ground.read("present", scene.ground.present);
        if (ground.has("friction")) scene.ground.friction = ground.number("friction");
    }
    read_contact(object, scene);
    remark_settings(object, place, scene);
    if (object.has("preparation")) {
        scene.preparation = parse_preparation(object.get("preparation"), object.place("preparation"), origin);
    }
    const bool has_motions = !scene.motions.empty();
    const json time = has_motions && !object.has("time") ? json::object() : object.get("time");
    scene.time = parse_time(JsonObject(time, object.place("time"), "time"), scene.time.safety, find_preset_name(object.get("material")),
                            has_motions);
    if (object.has("output")) {
        const JsonObject output(object.get("output"), object.place("output"), "output");
        output.read_quantity("spine_rate", scene.output.spine_rate);
        scene.output.frame_rate = output.optional_quantity<scaling::Frequency>("frame_rate");
    }
    check_scene(scene, origin.string());
    drop_idle_settings(scene);
    return scene;
}

Scene read_scene(const std::filesystem::path& path) { return parse_scene(detail::read_text(path), path); }

}  // namespace musim::lsdem::scene
