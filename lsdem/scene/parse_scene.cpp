#include <fmt/format.h>

#include <algorithm>

#include "lsdem/scene/detail/json_text.hpp"
#include "lsdem/scene/detail/parse_material.hpp"
#include "lsdem/scene/scene_json.hpp"
#include "scaling/laws/scale_law_catalogue.hpp"
#include "scaling/nearest_name.hpp"

namespace musim::lsdem::scene {

namespace {

using detail::Json;
using detail::parse_material;
using detail::to_object;
using scaling::JsonReader;

/// Only this version of the format is known.
constexpr std::string_view kSchemaName = "musim-scene/1";

const std::vector<std::string>& axis_names() {
    static const std::vector<std::string> kNames{"x", "y", "z"};
    return kNames;
}

/// Position in `names` of a text.
std::size_t to_choice(const JsonReader& value, const std::vector<std::string>& names) {
    const std::string name = value.text();
    const auto found = std::find(names.begin(), names.end(), name);
    if (found == names.end()) {
        value.fail(fmt::format("\"{}\" is not known{}; use one of {}", name, scaling::hint_at_name(name, names), fmt::join(names, ", ")));
    }
    return static_cast<std::size_t>(found - names.begin());
}

/// A file named in a scene, beside the scene's own.
std::filesystem::path resolve(const std::string& file, const std::filesystem::path& origin) {
    return std::filesystem::absolute(origin.parent_path() / file).lexically_normal();
}

ShapeSettings parse_shape(const JsonReader& value) {
    const JsonReader object = to_object(value, "shape");
    const bool sphere = to_choice(object["kind"], {"box", "sphere"}) == 1;
    if (sphere) {
        SphereShape shape;
        shape.radius = object.get<scaling::Length>("radius");
        shape.voxel = object.get<scaling::Length>("voxel");
        object.read("nodes", shape.nodes);
        return shape;
    }
    BoxShape box;
    object.read("nodes_per_face", box.nodes_per_face);
    const bool grid = object.has("level_set") && to_choice(object["level_set"], {"box", "grid"}) == 1;
    if (!grid) return box;
    return GridShape{box.nodes_per_face, object.get<scaling::Length>("voxel")};
}

BlockEntry parse_block(const JsonReader& value, bool needs_size) {
    const JsonReader object = to_object(value, "block");
    BlockEntry block;
    if (needs_size || object.has("size")) block.size = object.get<Triple<scaling::Length>>("size");
    block.position = object.get<Triple<scaling::Length>>("position");
    if (object.has("quaternion")) {
        const JsonReader list = object["quaternion"];
        if (!list.json().is_array() || list.json().size() != 4) list.fail("four numbers (w, x, y, z) are wanted; correct the list");
        for (std::size_t k = 0; k < 4; ++k) block.quaternion[k] = list.entries()[k].number();
    }
    object.read("velocity", block.velocity);
    object.read("angular_velocity", block.angular_velocity);
    object.read("fixed", block.fixed);
    object.read("rotation_locked", block.rotation_locked);
    object.read("material", block.material);
    return block;
}

TilingSettings find_preset_tiling(const JsonReader& name) {
    try {
        return find_tiling_preset(name.text());
    } catch (const SceneError& error) {
        name.fail(error.what());
    }
}

void parse_tiling_choice(const JsonReader& tower, const std::filesystem::path& origin, Tower& result) {
    if (!tower.has("tiling")) return;
    const JsonReader value = tower["tiling"];
    if (value.json().is_string()) {
        result.tiling = find_preset_tiling(value);
        return;
    }
    const JsonReader object = to_object(value, "tiling");
    object.read("cells_across", result.tiling.cells_across);
    object.read("inner_radius", result.tiling.inner_radius);
    object.read("outer_radius", result.tiling.outer_radius);
    if (object.has("file")) result.tiling_file = resolve(object.get<std::string>("file"), origin);
}

BlockList parse_block_list(const JsonReader& object, bool needs_size) {
    const JsonReader entries = object["blocks"];
    if (!entries.json().is_array()) entries.fail("a list [ ... ] of blocks is wanted; correct the value");
    BlockList list;
    for (const JsonReader& entry : entries.entries()) list.blocks.push_back(parse_block(entry, needs_size));
    return list;
}

template <class Layered>
void read_heights(const JsonReader& object, Layered& structure) {
    object.read("height_deviation", structure.height_deviation);
    object.read("seed", structure.seed);
}

Column parse_column(const JsonReader& object) {
    Column column;
    column.block = object.get<Triple<scaling::Length>>("block");
    object.read("layers", column.layers);
    object.read("rotation_locked", column.rotation_locked);
    read_heights(object, column);
    return column;
}

Wall parse_wall(const JsonReader& object) {
    Wall wall;
    wall.block = object.get<Triple<scaling::Length>>("block");
    object.read("layers", wall.layers);
    object.read("blocks_per_layer", wall.blocks_per_layer);
    wall.pitch = object.find<scaling::Length>("pitch");
    read_heights(object, wall);
    return wall;
}

Tower parse_tower(const JsonReader& object, const std::filesystem::path& origin) {
    Tower tower;
    tower.block = object.get<Triple<scaling::Length>>("block");
    object.read("layers", tower.layers);
    tower.pitch = object.find<scaling::Length>("pitch");
    parse_tiling_choice(object, origin, tower);
    read_heights(object, tower);
    return tower;
}

/// The text at `key`, which tells the kind of an object and so which other keys it may have.
std::string parse_kind(const JsonReader& value, const std::string& key, const std::vector<std::string>& kinds) {
    if (!value.json().is_object() || !value.json().contains(key)) {
        value.fail(fmt::format("an object with a \"{}\" is wanted ({}); add it", key, fmt::join(kinds, ", ")));
    }
    std::string kind = value.at(key).text();
    if (std::find(kinds.begin(), kinds.end(), kind) == kinds.end()) {
        value.at(key).fail(fmt::format("\"{}\" is not known; {}", kind, scaling::suggest_name(kind, kinds)));
    }
    return kind;
}

Structure parse_structure(const JsonReader& value, const std::filesystem::path& origin, bool needs_size) {
    const std::string kind = parse_kind(value, "kind", {"blocks", "column", "tower", "wall"});
    const JsonReader object = to_object(value, kind);
    if (kind == "blocks") return parse_block_list(object, needs_size);
    if (kind == "column") return parse_column(object);
    if (kind == "wall") return parse_wall(object);
    return parse_tower(object, origin);
}

RecordScale parse_record_scale(const JsonReader& value, const std::filesystem::path& origin) {
    const JsonReader object = to_object(value, "scale");
    RecordScale scale;
    object.read("law", scale.law);
    for (const scaling::ChosenScale& chosen : scaling::kChosenScales) {
        if (object.has(chosen.name)) object.read(chosen.name, scale.set[chosen.quantity]);
    }
    if (object.has("set")) {
        const JsonReader set = object["set"];
        if (!set.json().is_object()) set.fail(R"(an object of factors is wanted; write {"F_R": "1/500"})");
        for (const auto& [name, unused] : set.json().items()) {
            const JsonReader factor = set.at(name);
            if (!scale.set.emplace(name, factor.number()).second) factor.fail("the factor is given twice; give it once");
        }
    }
    if (scaling::find_scale_law(scale.law)) return scale;
    if (scale.law.find_first_of("./") == std::string::npos) object.at("law").fail(scaling::no_such_law(scale.law) + ", or a law file");
    scale.law = resolve(scale.law, origin).string();
    return scale;
}

RecordMotion parse_record(const JsonReader& object, const std::filesystem::path& origin) {
    RecordMotion motion;
    motion.file = resolve(object.get<std::string>("record"), origin);
    const JsonReader components = to_object(object["components"], "components");
    for (std::size_t axis = 0; axis < 3; ++axis) motion.components[axis] = components.find<std::string>(axis_names()[axis]);
    motion.unit = object.find<std::string>("unit");
    if (object.has("quantity")) {
        const std::vector<std::string> names{"acceleration", "velocity", "displacement"};
        motion.quantity = records::find_sample_quantity(names[to_choice(object["quantity"], names)]);
    }
    motion.dt = object.find<scaling::Time>("dt");
    if (object.has("window")) {
        const JsonReader window = object["window"];
        if (!window.json().is_array() || window.json().size() != 2) {
            window.fail("a list of two times is wanted; write [\"225 s\", \"265 s\"]");
        }
        const std::vector<JsonReader> times = window.entries();
        motion.window = {times[0].quantity<scaling::Time>(), times[1].quantity<scaling::Time>()};
    }
    motion.highpass_corner = object.find<scaling::Frequency>("highpass");
    if (object.has("scale")) motion.scale = parse_record_scale(object["scale"], origin);
    return motion;
}

Signal parse_signal_shape(const JsonReader& object, const std::string& kind) {
    if (kind == "step") return StepSignal{object.get<scaling::Velocity>("velocity")};
    if (kind == "synthetic") {
        SyntheticSignal synthetic;
        synthetic.pga = object.get<scaling::Acceleration>("pga");
        synthetic.pgv = object.get<scaling::Velocity>("pgv");
        synthetic.duration = object.get<scaling::Time>("duration");
        synthetic.dt = object.get<scaling::Time>("dt");
        object.read("seed", synthetic.seed);
        return synthetic;
    }
    const auto amplitude = object.get<scaling::Acceleration>("amplitude");
    if (kind == "half_sine") return HalfSineSignal{amplitude, object.get<scaling::Time>("duration")};
    const auto frequency = object.get<scaling::Frequency>("frequency");
    if (kind == "ricker") return RickerSignal{amplitude, frequency};
    return SineSignal{amplitude, frequency, object.get<double>("cycles")};
}

SignalMotion parse_signal(const JsonReader& value) {
    const std::string kind = parse_kind(value, "signal", {"step", "sine", "half_sine", "ricker", "synthetic"});
    const JsonReader object = to_object(value, kind);
    SignalMotion motion;
    motion.signal = parse_signal_shape(object, kind);
    if (object.has("direction")) motion.axis = static_cast<int>(to_choice(object["direction"], axis_names()));
    object.read("start", motion.start);
    // a synthetic record has a time step of its own, a step needs none
    if (kind != "synthetic" && kind != "step") motion.dt = object.find<scaling::Time>("dt");
    return motion;
}

BaseMotion parse_base_motion(const JsonReader& value, const std::filesystem::path& origin) {
    const Json& json = value.json();
    BaseMotion motion;
    if (!json.is_object() || json.contains("record") == json.contains("signal")) {
        value.fail("an object with either a \"record\" or a \"signal\" is wanted; add one of them, or leave base_motion out");
    }
    if (json.contains("record")) {
        motion.source = parse_record(to_object(value, "record"), origin);
    } else {
        motion.source = parse_signal(value);
    }
    if (json.contains("factors")) {
        const JsonReader factors = to_object(value.at("factors"), "factors");
        factors.read("time", motion.factors.time);
        factors.read("velocity", motion.factors.velocity);
        motion.factors.velocity_vertical = motion.factors.velocity;
        factors.read("velocity_vertical", motion.factors.velocity_vertical);
    }
    return motion;
}

MotionEntry parse_motion(const JsonReader& value, const std::filesystem::path& origin) {
    const JsonReader object = to_object(value, "motion");
    MotionEntry entry;
    object.read("name", entry.name);
    entry.base_motion = parse_base_motion(object["base_motion"], origin);
    entry.duration = object.find<scaling::Time>("duration");
    object.read("settle", entry.settle);
    object.read("repeat", entry.repeat);
    return entry;
}

std::vector<MotionEntry> parse_motions(const JsonReader& list, const std::filesystem::path& origin) {
    if (!list.json().is_array() || list.json().empty()) {
        list.fail("a list [ ... ] of motions is wanted; write at least one, or \"base_motion\" instead");
    }
    std::vector<MotionEntry> motions;
    for (const JsonReader& entry : list.entries()) motions.push_back(parse_motion(entry, origin));
    return motions;
}

/// A magnitude, downwards, or three components; the default stays without either.
void read_gravity(const JsonReader& object, Triple<scaling::Acceleration>& gravity) {
    if (!object.has("gravity")) return;
    const JsonReader value = object["gravity"];
    if (!value.json().is_array()) {
        gravity[2] = -value.quantity<scaling::Acceleration>();
        return;
    }
    const std::vector<JsonReader> components = value.triple();
    for (std::size_t k = 0; k < 3; ++k) gravity[k] = components[k].quantity<scaling::Acceleration>();
}

Preparation parse_preparation(const JsonReader& value, const std::filesystem::path& origin) {
    Preparation preparation;
    if (value.json().is_string()) {
        if (value.json() != "none") {
            value.fail(fmt::format("{} is no preparation; write \"none\", an object, or leave it out", value.json().dump()));
        }
        preparation.none = true;
        return preparation;
    }
    const JsonReader object = to_object(value, "preparation");
    if (object.has("placing")) preparation.placing = static_cast<Placing>(to_choice(object["placing"], placing_names()));
    preparation.damping_rate = object.find<scaling::Frequency>("damping_rate");
    if (object.has("specimen")) preparation.specimen = resolve(object.get<std::string>("specimen"), origin);
    return preparation;
}

/// Name of the preset that a material is taken from; empty when all its properties are given.
std::string find_preset_name(const JsonReader& material) {
    return material.json().is_string() ? material.text() : material.find<std::string>("preset").value_or("");
}

/// Time step of a preset, for a scene whose material is one; `step` asks for it.
scaling::Time find_camera_step(const std::string& preset, const JsonReader& step) {
    if (preset.empty()) {
        step.fail(
            fmt::format("\"camera\" is the step of a material preset, and the scene's material is none (presets are {}); name one, "
                        "or give a step or \"auto\"",
                        fmt::join(material_preset_names(), ", ")));
    }
    return find_material_preset(preset).camera_step;
}

/// `preset`: name of the scene's material, empty for none. With a list of motions the duration may be left out.
TimeSettings parse_time(const JsonReader& value, double safety, const std::string& preset, bool has_motions) {
    const JsonReader object = to_object(value, "time");
    TimeSettings time;
    time.safety = safety;
    if (!has_motions || object.has("duration")) time.duration = object.get<scaling::Time>("duration");
    if (object.has("step") && object["step"].json() != "auto") {
        const JsonReader step = object["step"];
        time.step = step.json() == "camera" ? find_camera_step(preset, step) : step.quantity<scaling::Time>();
    }
    object.read("safety", time.safety);
    return time;
}

/// Lets an accuracy choose what it stands for; what the scene says itself is read later.
void read_accuracy(const JsonReader& object, Scene& scene) {
    if (!object.has("accuracy")) return;
    scene.accuracy = static_cast<Accuracy>(to_choice(object["accuracy"], accuracy_names()));
    const AccuracyPreset& preset = find_accuracy_preset(*scene.accuracy);
    scene.time.safety = preset.safety;
}

void read_contact(const JsonReader& object, Scene& scene) {
    if (!object.has("contact")) return;
    const JsonReader contact = to_object(object["contact"], "contact");
    if (contact.has("nodes")) {
        scene.contact_nodes = to_choice(contact["nodes"], {"leader", "both"}) == 1 ? ContactNodes::both : ContactNodes::leader;
    }
    if (contact.has("stiffness")) {
        const bool per_contact = to_choice(contact["stiffness"], {"per_area", "per_contact"}) == 1;
        scene.stiffness_sharing = per_contact ? StiffnessSharing::per_contact : StiffnessSharing::per_area;
    }
    // "patch", an old name of overlap, is taken but not offered
    if (contact.has("faces") && contact["faces"].json() != "patch") {
        scene.face_contact = static_cast<FaceContact>(to_choice(contact["faces"], face_contact_names()));
    }
    if (contact.has("spacing")) to_choice(contact["spacing"], {"even", "lobatto"});
}

/// Says which settings of a scene change nothing, and which name is an old one.
void remark_settings(const JsonReader& object, Scene& scene) {
    const auto remark = [&](const JsonReader& at, const char* why) {
        scene.text.remarks.push_back(fmt::format("{}: {}", at.place(), why));
    };
    const bool has_nodes = scene.has_contact_nodes();
    if (object.has("shape") && object["shape"].json().contains("nodes_per_face") && !has_nodes) {
        remark(object["shape"].at("nodes_per_face"),
               "boxes meet without nodes, so it changes nothing (it counts with \"contact\": {\"faces\": \"nodes\"})");
    }
    if (!object.has("contact")) return;
    const JsonReader contact = object["contact"];
    if (contact.has("faces") && contact["faces"].json() == "patch") {
        remark(contact["faces"], "\"patch\" is an old name of \"overlap\", which it means; write \"overlap\"");
    }
    if (contact.has("nodes") && scene.contact_nodes == ContactNodes::both && !has_nodes) {
        remark(contact["nodes"],
               "boxes meet without nodes, so \"both\" changes nothing (it counts with \"contact\": {\"faces\": \"nodes\"})");
    }
    if (contact.json().contains("spacing")) {
        remark(contact.at("spacing"), "no contact has a spacing of nodes to choose, so it changes nothing; leave it out");
    }
}

/// Forgets settings of nodes where there are none, so that scenes that mean the same are equal.
void drop_idle_settings(Scene& scene) {
    if (scene.has_contact_nodes()) return;
    scene.shape = BoxShape{};
    scene.contact_nodes = ContactNodes::leader;
}

/// Adds the presets that block entries name to the scene's materials; refuses names that are neither.
void collect_materials(const JsonReader& object, Scene& scene) {
    if (!std::holds_alternative<BlockList>(scene.structure)) return;
    for (const JsonReader& block : object["structure"]["blocks"].entries()) {
        const std::string name = block.find<std::string>("material").value_or("");
        if (!name.empty() && !scene.materials.contains(name)) scene.materials.emplace(name, parse_material(block["material"]));
    }
}

}  // namespace

Scene parse_scene(std::string_view json_text, const std::filesystem::path& origin) {
    const Json root = detail::parse_json(json_text, origin.string());
    Scene scene;
    scene.text.origin = origin.string();
    const detail::SceneRules rules(&scene.text.plain_number);
    const JsonReader object = to_object(JsonReader(root, rules, origin.string() + ": /"), "scene");
    const JsonReader schema = object["schema"];
    if (schema.text() != kSchemaName) {
        schema.fail(fmt::format("\"{}\" is not a known format; write \"{}\"", schema.text(), kSchemaName));
    }

    object.read("name", scene.name);
    read_accuracy(object, scene);
    read_gravity(object, scene.gravity);
    scene.material = parse_material(object["material"]);
    if (object.has("materials")) {
        const JsonReader materials = object["materials"];
        if (!materials.json().is_object()) materials.fail("an object of named materials is wanted; correct the value");
        for (const auto& [name, unused] : materials.json().items()) scene.materials.emplace(name, parse_material(materials.at(name)));
    }
    if (object.has("shape")) scene.shape = parse_shape(object["shape"]);
    const bool needs_size = !std::holds_alternative<SphereShape>(scene.shape);
    scene.structure = parse_structure(object["structure"], origin, needs_size);
    collect_materials(object, scene);
    if (object.has("base_motion")) scene.base_motion = parse_base_motion(object["base_motion"], origin);
    if (object.has("motions")) scene.motions = parse_motions(object["motions"], origin);
    if (object.has("ground")) {
        const JsonReader ground = to_object(object["ground"], "ground");
        ground.read("present", scene.ground.present);
        scene.ground.friction = ground.find<double>("friction");
    }
    read_contact(object, scene);
    remark_settings(object, scene);
    if (object.has("preparation")) scene.preparation = parse_preparation(object["preparation"], origin);
    const bool has_motions = !scene.motions.empty();
    if (!has_motions || object.has("time")) {
        scene.time = parse_time(object["time"], scene.time.safety, find_preset_name(object["material"]), has_motions);
    }
    if (object.has("output")) {
        const JsonReader output = to_object(object["output"], "output");
        output.read("spine_rate", scene.output.spine_rate);
        scene.output.frame_rate = output.find<scaling::Frequency>("frame_rate");
    }
    check_scene(scene, origin.string());
    drop_idle_settings(scene);
    return scene;
}

Scene read_scene(const std::filesystem::path& path) { return parse_scene(detail::read_text(path), path); }

}  // namespace musim::lsdem::scene
