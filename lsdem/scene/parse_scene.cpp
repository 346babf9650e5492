#include <fmt/format.h>

#include <algorithm>

#include "lsdem/scene/detail/each_structure.hpp"
#include "lsdem/scene/detail/require.hpp"
#include "lsdem/scene/detail/scene_parts.hpp"
#include "lsdem/scene/detail/unlikely_values.hpp"
#include "lsdem/scene/scene_json.hpp"

namespace musim::lsdem {
namespace {

using detail::Json;
using detail::parse_material;
using detail::to_choice;
using detail::to_object;
using scaling::JsonReader;

/// Only this version of the format is known.
constexpr std::string_view kSchemaName = "musim-scene/1";

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
    if (object.has("placing")) {
        preparation.placing = static_cast<BlockPlacing>(to_choice(object["placing"], placing_names()));
    }
    preparation.damping_rate = object.find<scaling::Frequency>("damping_rate");
    if (object.has("specimen")) preparation.specimen = detail::resolve(object.get<std::string>("specimen"), origin);
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
    const std::optional<CameraStep>& camera_step = find_material_preset(preset).camera_step;
    if (!camera_step) {
        step.fail(
            fmt::format("\"camera\" is the step of the papers' tests, and {} is none of their materials; give a step or \"auto\"", preset));
    }
    return camera_step->value;
}

/// `preset`: name of the scene's material, empty for none. The duration may be left out where motions give one.
TimeSettings parse_time(const JsonReader& value, double safety, const std::string& preset, bool has_length) {
    const JsonReader object = to_object(value, "time");
    TimeSettings time;
    time.safety = safety;
    if (!has_length || object.has("duration")) time.duration = object.get<scaling::Time>("duration");
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
    if (contact.has("faces")) {
        scene.face_contact = static_cast<FaceContact>(to_choice(contact["faces"], face_contact_names()));
    }
}

/// Is there a block of a material that a pair names, or the ground that it names?
bool meets(const Scene& scene, const std::string& name) {
    if (name == kGroundName) return scene.ground.present;
    bool found = false;
    const std::string wanted = name == kOwnMaterialName ? "" : name;
    detail::for_each_structure(scene, detail::JsonPlace{}, [&](const auto& structure, const detail::JsonPlace& /*place*/) {
        if constexpr (requires { structure.blocks.front().material; }) {
            found |= std::any_of(structure.blocks.begin(), structure.blocks.end(),
                                 [&](const BlockEntry& block) { return block.material == wanted; });
        } else {
            found |= wanted.empty();
        }
        if constexpr (requires { structure.lintel; }) found |= structure.lintel && structure.lintel->material == wanted;
    });
    return found;
}

/// Remarks on the settings of a scene that change nothing.
void remark_settings(const JsonReader& object, Scene& scene) {
    const auto remark = [&](const JsonReader& at, const char* why) {
        scene.text.remarks.push_back(fmt::format("{}: {}", at.place(), why));
    };
    const bool has_nodes = scene.has_contact_nodes();
    if (object.has("shape") && object["shape"].json().contains("nodes_per_face") && !has_nodes) {
        remark(object["shape"].at("nodes_per_face"),
               "boxes meet without nodes, so it changes nothing (it counts with \"contact\": {\"faces\": \"nodes\"})");
    }
    if (scene.ground.friction && !scene.ground.present) {
        remark(object["ground"]["friction"], "there is no ground (\"present\": false), so it changes nothing");
    }
    for (std::size_t k = 0; k < scene.pairs.size(); ++k) {
        for (const std::string& name : scene.pairs[k].of) {
            if (!meets(scene, name))
                remark(object["pairs"].entries()[k], fmt::format("nothing is of \"{}\", so it changes nothing", name).c_str());
        }
    }
    if (!object.has("contact")) return;
    const JsonReader contact = object["contact"];
    if (contact.has("nodes") && scene.contact_nodes == ContactNodes::both && !has_nodes) {
        remark(contact["nodes"],
               "boxes meet without nodes, so \"both\" changes nothing (it counts with \"contact\": {\"faces\": \"nodes\"})");
    }
}

/// Forgets settings of nodes where there are none, so that scenes that mean the same are equal.
void drop_idle_settings(Scene& scene) {
    if (scene.has_contact_nodes()) return;
    scene.shape = BoxShape{};
    scene.contact_nodes = ContactNodes::leader;
}

/// Adds the presets that block entries name to the scene's materials; refuses names that are neither.
void collect_materials(const JsonReader& object, const detail::FindStiffnessBase& base, Scene& scene) {
    const detail::SceneRules rules(&scene.text);
    const auto collect = [&](const std::string& name, const detail::JsonPlace& place) {
        if (name.empty() || scene.materials.contains(name)) return;
        const Json text = name;
        const JsonReader value(text, rules, place.at("material").text);
        scene.materials.emplace(name, parse_material(value, base));
    };
    detail::for_each_structure(scene, detail::JsonPlace{object.place()}, [&](const auto& structure, const detail::JsonPlace& place) {
        if constexpr (requires { structure.blocks.front().material; }) {
            for (std::size_t k = 0; k < structure.blocks.size(); ++k) collect(structure.blocks[k].material, place.at("blocks").at(k));
        }
        if constexpr (requires { structure.lintel; }) {
            if (structure.lintel) collect(structure.lintel->material, place.at("lintel"));
        }
    });
}

/// Materials and pairs of a scene whose structure is read.
void read_materials(const JsonReader& object, Scene& scene) {
    const detail::FindStiffnessBase base(scene);
    scene.material = parse_material(object["material"], base);
    if (object.has("materials")) {
        const JsonReader materials = object["materials"];
        if (!materials.json().is_object()) materials.fail("an object of named materials is wanted; correct the value");
        for (const auto& [name, unused] : materials.json().items()) scene.materials.emplace(name, parse_material(materials.at(name), base));
    }
    collect_materials(object, base, scene);
    if (object.has("pairs")) scene.pairs = detail::parse_pairs(object["pairs"], base);
}

}  // namespace

Scene parse_scene(std::string_view json_text, const std::filesystem::path& origin) {
    const Json root = detail::parse_json(json_text, origin.string());
    Scene scene;
    scene.text.origin = origin.string();
    const detail::SceneRules rules(&scene.text);
    const JsonReader object = to_object(JsonReader(root, rules, origin.string() + ": /"), "scene");
    const JsonReader schema = object["schema"];
    if (schema.text() != kSchemaName) {
        schema.fail(fmt::format("\"{}\" is not a known format; write \"{}\"", schema.text(), kSchemaName));
    }

    object.read("name", scene.name);
    read_accuracy(object, scene);
    read_gravity(object, scene.gravity);
    object["material"];  // missing keys are named in the order of the schema, though a material is read after its structure
    if (object.has("shape")) scene.shape = detail::parse_shape(object["shape"]);
    if (object.has("shapes")) scene.shapes = detail::parse_shapes(object["shapes"], origin);
    const bool needs_size = !std::holds_alternative<SphereShape>(scene.shape);
    if (object.has("structures") && object.has("structure")) {
        object["structures"].fail("there is a \"structure\" as well; put it into the list, or leave one of the two out");
    }
    if (object.has("structures")) {
        scene.structure = detail::parse_structures(object["structures"], origin, needs_size);
    } else {
        scene.structure = detail::parse_structure(object["structure"], origin, needs_size);
    }
    if (object.has("scatter")) scene.scatter = detail::parse_scatter(object["scatter"]);
    detail::check_shapes(scene, detail::JsonPlace{object.place()});  // materials refer to the first block's base
    read_materials(object, scene);
    if (object.has("base_motion")) scene.base_motion = detail::parse_base_motion(object["base_motion"], origin);
    if (object.has("tilt")) {
        if (object.has("base_motion") || object.has("motions")) {
            object["tilt"].fail("the base has another motion as well (it can follow one only); leave one of the two out");
        }
        scene.base_motion = detail::parse_tilt(object["tilt"]);
    }
    if (object.has("motions")) scene.motions = detail::parse_motions(object["motions"], origin);
    if (object.has("loads")) scene.loads = detail::parse_loads(object["loads"]);
    if (object.has("ground")) detail::read_fields(to_object(object["ground"], "ground"), scene.ground);
    read_contact(object, scene);
    remark_settings(object, scene);
    if (object.has("preparation")) scene.preparation = parse_preparation(object["preparation"], origin);
    const auto* const tilt = std::get_if<TiltMotion>(&scene.base_motion.source);
    const bool has_length = !scene.motions.empty() || tilt != nullptr;
    if (!has_length || object.has("time")) {
        scene.time = parse_time(object["time"], scene.time.safety, find_preset_name(object["material"]), has_length);
    }
    if (tilt != nullptr && scene.time.duration.value() == 0.0) scene.time.duration = scene.base_motion.factors.time * tilt->duration();
    if (object.has("output")) detail::read_fields(to_object(object["output"], "output"), scene.output);
    if (object.has("sensors")) scene.sensors = detail::parse_sensors(object["sensors"]);
    check_scene(scene, origin.string());
    const std::vector<std::string> unlikely = detail::find_unlikely_values(scene);
    scene.text.remarks.insert(scene.text.remarks.end(), unlikely.begin(), unlikely.end());
    drop_idle_settings(scene);
    return scene;
}

Scene read_scene(const std::filesystem::path& path) { return parse_scene(detail::read_text(path), path); }

}  // namespace musim::lsdem
