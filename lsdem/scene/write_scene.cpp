#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "lsdem/scene/detail/scene_parts.hpp"
#include "lsdem/scene/scene_json.hpp"
#include "scaling/angle.hpp"
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
const char* key_of_motion(const Scene& scene) {
    if (!scene.motions.empty()) return "motions";
    return tilts(scene) ? "tilt" : "base_motion";
}

class SceneWriter {
  public:
    explicit SceneWriter(QuantityStyle style) : style_(style) {}

    ordered_json to_json(const Scene& scene) const {
        const bool with_size = !std::holds_alternative<SphereShape>(scene.shape);
        ordered_json materials = ordered_json::object();
        for (const auto& [name, material] : scene.materials) materials[name] = write_part(material);
        ordered_json motions = ordered_json::array();
        for (const MotionEntry& entry : scene.motions) motions.push_back(to_json(entry));

        ordered_json root{
            {"schema", "musim-scene/1"},
            {"name", scene.name},
            {"gravity", write(scene.gravity)},
            {"material", write_part(scene.material)},
            {"materials", materials},
            {"shape", to_json(scene.shape, scene.has_contact_nodes())},
            {"shapes", to_json(scene.shapes)},
            {std::holds_alternative<Assembly>(scene.structure) ? "structures" : "structure", to_json(scene.structure, with_size)},
            {key_of_motion(scene), scene.motions.empty() ? to_json(scene.base_motion) : motions},
            {"ground", write_part(scene.ground)},
            {"contact",
             {{"nodes", scene.contact_nodes == ContactNodes::leader ? "leader" : "both"},
              {"faces", face_contact_names().at(static_cast<std::size_t>(scene.face_contact))}}},
            {"time", to_json(scene.time, !scene.motions.empty())},
            {"output", write_part(scene.output)}};
        if (scene.shapes.empty()) root.erase("shapes");
        if (scene.scatter) root["scatter"] = write_part(*scene.scatter);
        if (scene.preparation && scene.preparation->none) {
            root["preparation"] = "none";
        } else if (scene.preparation) {
            ordered_json preparation = ordered_json::object();
            if (scene.preparation->placing) preparation["placing"] = to_string(*scene.preparation->placing);
            put(preparation, "damping_rate", scene.preparation->damping_rate);
            if (scene.preparation->specimen) preparation["specimen"] = scene.preparation->specimen->string();
            root["preparation"] = preparation;
        }
        for (const PairEntry& pair : scene.pairs) root["pairs"].push_back(write_part(pair, ordered_json{{"of", pair.of}}));
        for (const LoadEntry& load : scene.loads) root["loads"].push_back(to_json(load));
        if (scene.accuracy) root["accuracy"] = to_string(*scene.accuracy);
        for (const SensorEntry& sensor : scene.sensors) root["sensors"].push_back(to_json(sensor));
        return root;
    }

  private:
    template <class Value>
    ordered_json write(const Value& value) const {
        if constexpr (scaling::QuantityWithUnit<Value>) {
            if (std::is_same_v<Value, scaling::Ratio> && style_ == QuantityStyle::text)
                return fmt::format("{:.{}g} deg", value.value() * scaling::kDegrees, kDigits);
            if (style_ == QuantityStyle::text) return scaling::format_quantity(value, kDigits);
            return value.value();
        } else if constexpr (detail::kHasFields<Value>) {
            return write_part(value);
        } else {
            return value;
        }
    }
    template <class Quantity>
    ordered_json write(const Triple<Quantity>& triple) const {
        return {write(triple[0]), write(triple[1]), write(triple[2])};
    }
    template <class Value>
    ordered_json write(const std::vector<Value>& list) const {
        ordered_json values = ordered_json::array();
        for (const Value& value : list) values.push_back(write(value));
        return values;
    }
    ordered_json write(const std::array<scaling::Length, 2>& corner) const { return {write(corner[0]), write(corner[1])}; }
    ordered_json write(const std::array<Triple<scaling::Inertia>, 3>& tensor) const {
        return {write(tensor[0]), write(tensor[1]), write(tensor[2])};
    }
    ordered_json write(SensorAxes axes) const { return kSensorAxes.at(static_cast<std::size_t>(axes)); }
    ordered_json write(Held held) const {
        if (held == Held::with_base) return "base";
        return held == Held::in_place;
    }
    ordered_json write(ShapeAxis axis) const { return detail::kShapeAxes.at(static_cast<std::size_t>(axis)); }
    ordered_json write(const ChosenPart& part) const {
        return std::visit([](const auto& which) -> ordered_json { return which; }, part);
    }
    ordered_json write(const WallLintel& lintel) const {
        ordered_json object = write_part(lintel);
        if (!lintel.material.empty()) object["material"] = lintel.material;
        return object;
    }
    ordered_json write(records::SampleQuantity quantity) const { return records::to_string(quantity); }
    /// Numbers of columns as numbers.
    ordered_json write(const records::ColumnChoices& columns) const {
        ordered_json object = ordered_json::object();
        for (const records::ColumnChoice& choice : columns) {
            const bool is_number = choice.column.size() < 10 && choice.column.find_first_not_of("0123456789") == std::string::npos;
            if (is_number) {
                object[choice.name] = std::stoul(choice.column);
            } else {
                object[choice.name] = choice.column;
            }
        }
        return object;
    }
    ordered_json write(records::AtRest at_rest) const {
        if (at_rest == records::AtRest::displaced) return "displaced";
        return at_rest == records::AtRest::home;
    }
    /// Times of a record, which are read beside each other.
    ordered_json write(const std::array<scaling::Time, 2>& window) const {
        if (style_ == QuantityStyle::si_number) return {window[0].value(), window[1].value()};
        return {fmt::format("{:.{}g} s", window[0].value(), kDigits), fmt::format("{:.{}g} s", window[1].value(), kDigits)};
    }
    template <class Value>
    void put(ordered_json& object, const char* key, const Value& value) const {
        object[key] = write(value);
    }
    template <class Value>
    void put(ordered_json& object, const char* key, const std::optional<Value>& value) const {
        if (value) object[key] = write(*value);
    }
    /// Nothing of a wall without any.
    void put(ordered_json& object, const char* key, const std::vector<WallOpening>& openings) const {
        if (!openings.empty()) object[key] = write(openings);
    }
    void put(ordered_json& object, const char* key, const std::optional<SensorFilter>& filter) const {
        object[key] = filter ? write_part(*filter) : ordered_json("none");
    }
    /// Adds the fields of a part.
    template <class Part>
    ordered_json write_part(const Part& part, ordered_json object = ordered_json::object()) const {
        detail::for_each_field(part, [&](const auto& field, const auto& value) { put(object, field.key, value); });
        return object;
    }

    ordered_json to_json(const ShapeSettings& shape, bool has_contact_nodes) const {
        const bool sphere = std::holds_alternative<SphereShape>(shape);
        ordered_json object{{"kind", sphere ? "sphere" : "box"}};
        if (!sphere) object["level_set"] = std::holds_alternative<GridShape>(shape) ? "grid" : "box";
        if (std::holds_alternative<BoxShape>(shape) && !has_contact_nodes) return object;
        return std::visit([&](const auto& settings) { return write_part(settings, object); }, shape);
    }

    /// Adds what a form has besides its fields.
    template <class Form>
    void put_more(ordered_json& object, const Form& form) const {
        if constexpr (std::is_same_v<Form, MeshForm>) object["file"] = form.file.string();
        if constexpr (std::is_same_v<Form, CompoundForm>) {
            if (form.file) object["file"] = form.file->string();
            for (const CompoundPart& part : form.parts) object["parts"].push_back(write_part(part));
        }
    }

    /// Without what it leaves as it is drawn.
    ordered_json to_json(const ShapeEntry& shape) const {
        ordered_json object{{"kind", detail::kShapeKinds.at(shape.form.index())}};
        std::visit([&](const auto& form) { put_more(object, form), object = write_part(form, object); }, shape.form);
        if (shape.is_sphere()) return object;
        ordered_json more = write_part(shape);
        const ShapeEntry plain;
        if (shape.scale == plain.scale) more.erase("scale");
        if (shape.quaternion == plain.quaternion) more.erase("quaternion");
        object.update(more);
        return object;
    }
    ordered_json to_json(const std::map<std::string, ShapeEntry>& shapes) const {
        ordered_json object = ordered_json::object();
        for (const auto& [name, shape] : shapes) object[name] = to_json(shape);
        return object;
    }

    ordered_json to_json(const BlockEntry& block, bool with_size) const {
        ordered_json object = ordered_json::object();
        if (!block.shape.empty()) {
            object["shape"] = block.shape;
        } else if (with_size) {
            object["size"] = write(block.size);
        }
        object = write_part(block, object);
        if (!block.material.empty()) object["material"] = block.material;
        if (!block.name.empty()) object["name"] = block.name;
        return object;
    }

    /// Adds what a structure has besides its fields.
    template <class Kind>
    void put_more_of(ordered_json& object, const Kind& structure, bool with_size) const {
        if constexpr (std::is_same_v<Kind, BlockList>) {
            object["blocks"] = ordered_json::array();
            for (const BlockEntry& block : structure.blocks) object["blocks"].push_back(to_json(block, with_size));
        }
        if constexpr (std::is_same_v<Kind, Tower>) {
            if (structure.tiling_file) object["tiling"]["file"] = structure.tiling_file->string();
            if (!structure.shape.empty()) object["shape"] = structure.shape;
        }
    }

    /// One structure, by its place among the kinds.
    template <class Kind>
    ordered_json to_json(const Kind& structure, std::size_t kind, bool with_size) const {
        ordered_json object = write_part(structure, ordered_json{{"kind", detail::kStructureKinds.at(kind)}});
        put_more_of(object, structure, with_size);
        return object;
    }

    ordered_json to_json(const PlacedStructure& placed, bool with_size) const {
        ordered_json object =
            std::visit([&](const auto& structure) { return to_json(structure, placed.structure.index(), with_size); }, placed.structure);
        if (!placed.name.empty()) object["name"] = placed.name;
        return write_part(placed, object);
    }

    ordered_json to_json(const Structure& structure, bool with_size) const {
        const auto* assembly = std::get_if<Assembly>(&structure);
        if (assembly == nullptr) return std::visit([&](const auto& one) { return to_json(one, structure.index(), with_size); }, structure);
        ordered_json list = ordered_json::array();
        for (const PlacedStructure& placed : assembly->structures) list.push_back(to_json(placed, with_size));
        return list;
    }

    ordered_json to_json(const RecordMotion& motion) const {
        ordered_json object{{"record", motion.file.string()}, {"components", ordered_json::object()}};
        for (std::size_t axis = 0; axis < kMotionAxes.size(); ++axis) {
            if (motion.components[axis]) object["components"][kMotionAxes[axis]] = *motion.components[axis];
        }
        object = write_part(motion, object);
        if (motion.station_xml) object["station_xml"] = motion.station_xml->string();
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
        const ordered_json kind{{"signal", detail::kSignalKinds.at(motion.signal.index())}};
        ordered_json object = std::visit([&](const auto& signal) { return write_part(signal, kind); }, motion.signal);
        object["direction"] = kMotionAxes.at(motion.axis);
        return write_part(motion, object);
    }

    ordered_json to_json(const TiltMotion& motion) const { return write_part(motion, {{"about", kMotionAxes.at(motion.about)}}); }

    ordered_json to_json(const SceneMotion& motion) const {
        ordered_json object = std::visit(
            Overloaded{[](std::monostate) -> ordered_json { return nullptr; }, [&](const auto& source) { return to_json(source); }},
            motion.source);
        if (object.is_null()) return object;
        object = write_part(motion, object);
        object["factors"] = write_part(motion.factors);
        if (motion.factors.velocity_vertical == motion.factors.velocity) object["factors"].erase("velocity_vertical");
        return object;
    }

    ordered_json to_json(const LoadEntry& load) const {
        ordered_json object{{"block", load.block}};
        if (!load.name.empty()) object["name"] = load.name;
        return write_part(load, object);
    }

    ordered_json to_json(const MotionEntry& entry) const {
        return write_part(entry, {{"name", entry.name}, {"base_motion", to_json(entry.base_motion)}});
    }

    ordered_json to_json(const SensorEntry& sensor) const {
        const auto name = [](const SensorBody& body) { return std::visit([](const auto& which) -> ordered_json { return which; }, body); };
        ordered_json object{{"name", sensor.name}, {"kind", kSensorKinds.at(static_cast<std::size_t>(sensor.kind))}};
        if (sensor.kind == SensorKind::joint) {
            for (const SensorBody& body : sensor.bodies) object["blocks"].push_back(name(body));
        } else {
            object["block"] = name(sensor.bodies.front());
        }
        object = write_part(sensor, object);
        if (sensor.normal) object["normal"] = *sensor.normal;
        if (sensor.kind == SensorKind::joint) object.erase("axes");
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
