#include "records/design/parse_facts.hpp"

#include "records/design/detail/law_fields.hpp"
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

/// What a structure has unless its object says otherwise.
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

scaling::StructureFacts read_structure(const JsonReader& fields, const std::vector<Material>& presets, const Defaults& defaults) {
    scaling::StructureFacts facts;
    const std::optional<Material> preset = detail::read_preset(fields, presets);
    facts.name = fields.find<std::string>("name").value_or(preset ? preset->name : defaults.name);
    facts.block = defaults.block && !fields.has("block") ? *defaults.block : require_block(fields, "block");
    facts.layers = read_count(fields, "layers", defaults.layers);

    const Material material = detail::read_properties(
        fields, preset, [&] { return fields.has("stiffness_block") ? require_block(fields, "stiffness_block") : facts.block; });
    facts.density = material.density;
    facts.friction = material.friction;
    facts.restitution = material.restitution;
    facts.normal_stiffness = find_face_stiffness(material.modulus, facts.block);
    facts.shear_stiffness = find_face_stiffness(material.shear_modulus, facts.block);
    facts.height_deviation = material.deviation;

    facts.gap = read_not_negative<scaling::Length>(fields, "gap");
    facts.edge_radius = read_not_negative<scaling::Length>(fields, "edge_radius");
    if (fields.has("blocks_per_layer")) facts.blocks_per_layer = read_count(fields, "blocks_per_layer", {});
    facts.ground_friction = read_number(fields, "ground_friction");
    facts.kinetic_friction = read_number(fields, "kinetic_friction");
    facts.gravity = read_positive<scaling::Acceleration>(fields, "gravity").value_or(scaling::kStandardGravity);
    fields.refuse_unknown_keys();
    return facts;
}

RecordOfMotion read_record(const JsonReader& fields) {
    detail::refuse_uncertainty(fields, "high_pass", "it is chosen");
    return {.file = require_text(fields, "file"),
            .component = fields.find<std::string>("component").value_or(""),
            .vertical = fields.find<std::string>("vertical").value_or(""),
            .high_pass = read_positive<scaling::Frequency>(fields, "high_pass")};
}

scaling::MotionFacts read_peaks(const JsonReader& fields) {
    scaling::MotionFacts motion{.acceleration = require_positive<scaling::Acceleration>(fields, "acceleration"),
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

Facts parse_facts(std::string_view json, const std::string& source, const std::vector<Material>& presets, double length,
                  scaling::UncertainReading* reading) {
    const detail::Json object =
        records::detail::parse_object(json, source, "musim-facts/1", "file of facts", R"("prototype": {...}, "model": {...})");
    const JsonRules rules(reading);
    const JsonReader fields(object, rules, source);
    Facts facts;
    fields.read("name", facts.name);
    for (const char* const side : {"prototype", "model"}) {
        if (!fields.has(side)) {
            fields.fail(fmt::format("{} is missing", side), R"(add {"preset" or "density" and "friction", "block", "layers", ...})");
        }
    }
    facts.prototype = read_structure(fields["prototype"].object(), presets, {.name = "prototype"});
    const Block& block = facts.prototype.block;
    facts.model = read_structure(
        fields["model"].object(), presets,
        {.name = "model", .block = Block{length * block[0], length * block[1], length * block[2]}, .layers = facts.prototype.layers});
    facts.motion = read_motion(fields, "motion");
    facts.model_motion = read_motion(fields, "model_motion");
    if (facts.model_motion && !facts.motion) {
        fields.fail("motion is missing (model_motion is held against it)", "add the prototype's motion, or remove model_motion");
    }
    if (fields.has("table")) facts.table = read_table(fields["table"].object());
    if (fields.has("law") && !object["law"].is_string() && !object["law"].is_object()) {
        fields.fail("law is neither a name nor an object", R"(write "true_replica" or {"law": "gravity_distorted", "set": {"a": 2}})");
    }
    if (fields.has("law")) facts.law = detail::read_law(fields["law"], source);
    fields.refuse_unknown_keys();
    return facts;
}

}  // namespace musim::records
