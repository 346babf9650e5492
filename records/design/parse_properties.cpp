#include "records/design/parse_properties.hpp"

#include "records/design/detail/material_fields.hpp"

namespace musim::records {
namespace {

using detail::Block;
using detail::JsonReader;
using detail::JsonRules;
using detail::read_not_negative;
using detail::read_number;
using detail::read_positive;
using detail::require_block;
using detail::require_positive;
using detail::require_text;

/// Values of a structure unless its object says otherwise.
struct Defaults {
    std::string name;
    std::optional<Block> block = {};
    std::optional<int> layers = {};
};

int read_count(const JsonReader& fields, const char* key, std::optional<int> fallback) {
    if (!fallback && !fields.has(key)) fields.fail(fmt::format("{} is missing", key), "add it");
    const int count = fields.find<int>(key).value_or(fallback.value_or(0));
    if (count < 1) fields.fail(fmt::format("{} is below 1", key), "correct it");
    return count;
}

/// k = E A/H of a face.
std::optional<scaling::Stiffness> find_face_stiffness(const std::optional<scaling::Stress>& modulus, const Block& block) {
    if (!modulus) return std::nullopt;
    return scaling::Stiffness(*modulus * block[0] * block[1] / block[2]);
}

scaling::StructureProperties read_structure(const JsonReader& fields, const std::vector<Material>& presets, const Defaults& defaults) {
    scaling::StructureProperties properties;
    const std::optional<Material> preset = detail::read_preset(fields, presets);
    properties.name = fields.find<std::string>("name").value_or(preset ? preset->name : defaults.name);
    properties.block = defaults.block && !fields.has("block") ? *defaults.block : require_block(fields, "block");
    properties.layers = read_count(fields, "layers", defaults.layers);

    const Material material = detail::read_properties(
        fields, preset, [&] { return fields.has("stiffness_block") ? require_block(fields, "stiffness_block") : properties.block; });
    properties.density = material.density;
    properties.friction = material.friction;
    properties.restitution = material.restitution;
    properties.normal_stiffness = find_face_stiffness(material.modulus, properties.block);
    properties.shear_stiffness = find_face_stiffness(material.shear_modulus, properties.block);
    properties.height_deviation = material.deviation;

    properties.gap = read_not_negative<scaling::Length>(fields, "gap");
    properties.edge_radius = read_not_negative<scaling::Length>(fields, "edge_radius");
    if (fields.has("blocks_per_layer")) properties.blocks_per_layer = read_count(fields, "blocks_per_layer", {});
    properties.ground_friction = read_number(fields, "ground_friction");
    properties.kinetic_friction = read_number(fields, "kinetic_friction");
    properties.gravity = read_positive<scaling::Acceleration>(fields, "gravity").value_or(scaling::kStandardGravity);
    fields.refuse_unknown_keys();
    return properties;
}

RecordOfMotion read_record(const JsonReader& fields) {
    detail::refuse_uncertainty(fields, "high_pass", "it is chosen");
    return {.file = require_text(fields, "file"),
            .component = fields.find<std::string>("component").value_or(""),
            .vertical = fields.find<std::string>("vertical").value_or(""),
            .high_pass = read_positive<scaling::Frequency>(fields, "high_pass")};
}

scaling::MotionProperties read_peaks(const JsonReader& fields) {
    scaling::MotionProperties motion{.acceleration = require_positive<scaling::Acceleration>(fields, "acceleration"),
                                     .velocity = read_positive<scaling::Velocity>(fields, "velocity"),
                                     .displacement = read_positive<scaling::Length>(fields, "displacement"),
                                     .vertical_acceleration = read_not_negative<scaling::Acceleration>(fields, "vertical_acceleration"),
                                     .predominant_period = read_positive<scaling::Time>(fields, "predominant_period"),
                                     .pulse_period = read_positive<scaling::Time>(fields, "pulse_period"),
                                     .duration = read_positive<scaling::Time>(fields, "duration"),
                                     .step = read_positive<scaling::Time>(fields, "step"),
                                     .lowest_frequency = read_positive<scaling::Frequency>(fields, "lowest_frequency"),
                                     .highest_frequency = read_positive<scaling::Frequency>(fields, "highest_frequency")};
    if (const auto direction = read_not_negative<scaling::Ratio>(fields, "direction")) motion.direction = direction->value();
    return motion;
}

std::optional<MotionSource> read_motion(const JsonReader& parent, const char* key) {
    if (!parent.has(key)) return std::nullopt;
    const JsonReader fields = parent[key].object();
    const MotionSource motion = fields.has("file") ? MotionSource(read_record(fields)) : MotionSource(read_peaks(fields));
    fields.refuse_unknown_keys();
    return motion;
}

std::variant<std::monostate, scaling::Bandwidth, AxisOfTable> read_table(const JsonReader& fields) {
    std::variant<std::monostate, scaling::Bandwidth, AxisOfTable> table;
    if (fields.has("file")) {
        table = AxisOfTable{.file = require_text(fields, "file"), .axis = require_text(fields, "axis")};
    } else {
        table = scaling::Bandwidth{.lowest = read_positive<scaling::Frequency>(fields, "lowest_frequency"),
                                   .highest = read_positive<scaling::Frequency>(fields, "highest_frequency")};
    }
    fields.refuse_unknown_keys();
    return table;
}

}  // namespace

Properties parse_properties(std::string_view json, const std::string& source, const std::vector<Material>& presets, double length,
                            scaling::UncertainReading* reading) {
    return read_properties(parse_properties_text(json, source), source, presets, length, reading);
}

detail::Json parse_properties_text(std::string_view json, const std::string& source) {
    return detail::parse_object(json, source, "musim-properties/1", "file of structure properties",
                                R"("prototype": {...}, "model": {...})");
}

Properties read_properties(const detail::Json& object, const std::string& source, const std::vector<Material>& presets, double length,
                           scaling::UncertainReading* reading) {
    const JsonRules rules(reading);
    const JsonReader fields(object, rules, source);
    Properties properties;
    fields.read("name", properties.name);
    for (const char* const side : {"prototype", "model"}) {
        if (!fields.has(side)) {
            fields.fail(fmt::format("{} is missing", side), R"(add {"preset" or "density" and "friction", "block", "layers", ...})");
        }
    }
    properties.prototype = read_structure(fields["prototype"].object(), presets, {.name = "prototype"});
    const Block& block = properties.prototype.block;
    properties.model = read_structure(
        fields["model"].object(), presets,
        {.name = "model", .block = Block{length * block[0], length * block[1], length * block[2]}, .layers = properties.prototype.layers});
    properties.motion = read_motion(fields, "motion");
    properties.model_motion = read_motion(fields, "model_motion");
    if (properties.model_motion && !properties.motion) {
        fields.fail("motion is missing (model_motion is held against it)", "add the prototype's motion, or remove model_motion");
    }
    if (fields.has("table")) properties.table = read_table(fields["table"].object());
    if (fields.has("law") && !object["law"].is_string() && !object["law"].is_object()) {
        fields.fail("law is neither a name nor an object", R"(write "true_replica" or {"law": "gravity_distorted", "set": {"a": 2}})");
    }
    if (fields.has("law")) properties.law = detail::read_law(fields["law"], source);
    fields.refuse_unknown_keys();
    return properties;
}

}  // namespace musim::records
