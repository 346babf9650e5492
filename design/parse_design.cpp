#include "design/parse_design.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "design/candidate.hpp"
#include "records/detail/json_fields.hpp"

namespace musim::design {
namespace {

using records::detail::JsonFields;
using Json = JsonFields::Json;
using Block = std::array<scaling::Length, 3>;

constexpr std::string_view kSchema = "musim-design/1";

template <class Quantity>
std::optional<Quantity> read_positive(JsonFields& fields, const char* key) {
    auto value = fields.optional_quantity<Quantity>(key);
    if (value && !(value->value() > 0.0 && std::isfinite(value->value()))) {
        fields.fail(fmt::format("{} is not above zero", key), "correct it, or remove it where it is not known");
    }
    return value;
}

template <class Quantity>
Quantity require_positive(JsonFields& fields, const char* key) {
    const auto value = read_positive<Quantity>(fields, key);
    if (!value) fields.fail(fmt::format("{} is missing", key), "add it");
    return *value;
}

std::optional<double> read_number(JsonFields& fields, const char* key) {
    const auto value = read_positive<scaling::Ratio>(fields, key);
    return value ? std::optional(value->value()) : std::nullopt;
}

std::string require_text(JsonFields& fields, const char* key) {
    std::string text = fields.text(key, "");
    if (text.empty()) fields.fail(fmt::format("{} is missing", key), "add it");
    return text;
}

const Json& require_list(JsonFields& fields, const char* key, const std::string& example) {
    if (!fields.has(key) || !fields[key].is_array() || fields[key].empty()) {
        fields.fail(fmt::format("{} is no list", key), "write " + example);
    }
    return fields[key];
}

std::vector<std::string> read_names(JsonFields& fields, const char* key, const std::string& example) {
    std::vector<std::string> names;
    for (const Json& entry : require_list(fields, key, example)) {
        if (!entry.is_string()) fields.fail(fmt::format("an entry of {} is no text", key), "write it in quotes");
        names.push_back(entry.get<std::string>());
    }
    return names;
}

Block require_block(JsonFields& fields, const char* key) {
    if (!fields.has(key) || !fields[key].is_array() || fields[key].size() != 3) {
        fields.fail(fmt::format("{} is no list of three lengths", key), R"(write ["12.7 mm", "26.4 mm", "39.7 mm"], the height last)");
    }
    Block block;
    for (std::size_t i = 0; i < block.size(); ++i) {
        block[i] = fields.to_quantity<scaling::Length>(fields[key][i], key);
        if (!(block[i].value() > 0.0 && std::isfinite(block[i].value()))) {
            fields.fail(fmt::format("a length of {} is not above zero", key), "correct it");
        }
    }
    return block;
}

/// E = k H/A of a face stiffness k, or the modulus itself; `block` is asked for only when a stiffness is given.
template <class FindBlock>
std::optional<scaling::Stress> read_modulus(JsonFields& fields, const char* modulus_key, const char* stiffness_key,
                                            const FindBlock& find_block) {
    auto modulus = read_positive<scaling::Stress>(fields, modulus_key);
    const auto stiffness = read_positive<scaling::Stiffness>(fields, stiffness_key);
    if (modulus && stiffness) fields.fail(fmt::format("{} contradicts {}", modulus_key, stiffness_key), "remove one of them");
    if (!stiffness) return modulus;
    const Block block = find_block();
    return scaling::Stress(*stiffness * block[2] / (block[0] * block[1]));
}

Prototype read_prototype(const Json& object, const std::string& place) {
    JsonFields fields(object, place);
    Prototype prototype;
    prototype.block = require_block(fields, "block");
    prototype.height = require_positive<scaling::Length>(fields, "height");
    prototype.density = require_positive<scaling::Density>(fields, "density");
    prototype.friction = require_positive<scaling::Ratio>(fields, "friction").value();
    prototype.mass = read_positive<scaling::Mass>(fields, "mass").value_or(scaling::Mass{});
    prototype.mass_center = read_positive<scaling::Length>(fields, "mass_center").value_or(0.5 * prototype.height);
    prototype.restitution = read_number(fields, "restitution");
    const auto block = [&] { return prototype.block; };
    prototype.modulus = read_modulus(fields, "modulus", "normal_stiffness", block);
    prototype.shear_modulus = read_modulus(fields, "shear_modulus", "shear_stiffness", block);
    prototype.deviation = read_positive<scaling::Length>(fields, "height_deviation");
    fields.refuse_unknown_keys();
    return prototype;
}

Material find_preset(const std::string& name, const std::string& place, const std::vector<Material>& presets) {
    const auto preset = std::find_if(presets.begin(), presets.end(), [&](const Material& each) { return each.name == name; });
    if (preset != presets.end()) return *preset;
    std::vector<std::string> names;
    names.reserve(presets.size());
    for (const Material& each : presets) names.push_back(each.name);
    throw records::ReadError(fmt::format("{}: \"{}\" is no preset; take one of {}, or give its density and friction under a name", place,
                                         name, fmt::join(names, ", ")));
}

Material read_material(const Json& value, const std::string& place, const std::vector<Material>& presets) {
    if (value.is_string()) return find_preset(value.get<std::string>(), place, presets);
    JsonFields fields(value, place);
    Material material;
    const bool is_preset = fields.has("preset");
    if (is_preset) material = find_preset(require_text(fields, "preset"), place, presets);
    material.name = is_preset ? fields.text("name", material.name) : require_text(fields, "name");
    if (!is_preset || fields.has("density")) material.density = require_positive<scaling::Density>(fields, "density");
    if (!is_preset || fields.has("friction")) material.friction = require_positive<scaling::Ratio>(fields, "friction").value();
    const auto replace = [](auto& old, const auto& given) {
        if (given) old = given;
    };
    const auto block = [&] { return require_block(fields, "stiffness_block"); };
    replace(material.restitution, read_number(fields, "restitution"));
    replace(material.modulus, read_modulus(fields, "modulus", "normal_stiffness", block));
    replace(material.shear_modulus, read_modulus(fields, "shear_modulus", "shear_stiffness", block));
    replace(material.deviation, read_positive<scaling::Length>(fields, "height_deviation"));
    replace(material.smallest_edge, read_positive<scaling::Length>(fields, "smallest_edge"));
    replace(material.price, read_number(fields, "price"));
    fields.refuse_unknown_keys();
    return material;
}

std::vector<Material> read_materials(JsonFields& fields, const std::vector<Material>& presets) {
    std::vector<Material> materials;
    for (const Json& entry : require_list(fields, "materials", R"(["wood", {"name": "resin", "density": ..., "friction": ...}])")) {
        const Material material = read_material(entry, fmt::format("{}: materials {}", fields.place(), materials.size() + 1), presets);
        if (std::any_of(materials.begin(), materials.end(), [&](const Material& other) { return other.name == material.name; })) {
            fields.fail(fmt::format("the material \"{}\" comes twice", material.name), "give every one its own \"name\"");
        }
        materials.push_back(material);
    }
    return materials;
}

std::vector<GivenPeaks> read_peaks(JsonFields& fields) {
    std::vector<GivenPeaks> list;
    for (const Json& entry : require_list(fields, "peaks", R"([{"axis": "x", "acceleration": "0.5 g", ...}])")) {
        JsonFields row(entry, fmt::format("{}: peaks {}", fields.place(), list.size() + 1));
        GivenPeaks peaks{.axis = require_text(row, "axis"), .acceleration = require_positive<scaling::Acceleration>(row, "acceleration")};
        peaks.velocity = read_positive<scaling::Velocity>(row, "velocity");
        peaks.displacement = read_positive<scaling::Length>(row, "displacement");
        peaks.lowest_frequency = read_positive<scaling::Frequency>(row, "lowest_frequency");
        peaks.highest_frequency = read_positive<scaling::Frequency>(row, "highest_frequency");
        row.refuse_unknown_keys();
        list.push_back(peaks);
    }
    return list;
}

RecordFile read_record_file(JsonFields& fields) {
    RecordFile record{.file = require_text(fields, "file")};
    if (fields.has("axes")) {
        if (!fields["axes"].is_object()) fields.fail("axes is no object", R"(write {"360": "x"}, component before axis)");
        for (const auto& [component, axis] : fields["axes"].items()) {
            if (!axis.is_string()) fields.fail("an axis is no text", R"(write {"360": "x"}, component before axis)");
            record.axes.emplace_back(component, axis.get<std::string>());
        }
    }
    record.high_pass = read_positive<scaling::Frequency>(fields, "high_pass");
    return record;
}

std::variant<RecordFile, std::vector<GivenPeaks>> read_motion(const Json& object, const std::string& place) {
    JsonFields fields(object, place);
    std::variant<RecordFile, std::vector<GivenPeaks>> motion;
    if (fields.has("peaks")) {
        motion = read_peaks(fields);
    } else {
        motion = read_record_file(fields);
    }
    fields.refuse_unknown_keys();
    return motion;
}

Limits read_limits(const Json& object, const std::string& place) {
    JsonFields fields(object, place);
    Limits limits;
    limits.hall_height = read_positive<scaling::Length>(fields, "hall_height");
    limits.deviation_ratio = read_number(fields, "deviation_ratio");
    limits.overlap_ratio = read_number(fields, "overlap_ratio");
    if (fields.has("camera")) {
        JsonFields camera(fields["camera"], place + ": camera");
        limits.camera_rate = require_positive<scaling::Frequency>(camera, "rate");
        limits.pictures = require_positive<scaling::Ratio>(camera, "pictures").value();
        camera.refuse_unknown_keys();
    }
    fields.refuse_unknown_keys();
    return limits;
}

/// Every limit must find what it needs, lest it be passed over in silence.
void check_limits(const JsonFields& fields, const Design& design) {
    for (const Material& material : design.materials) {
        if ((design.limits.deviation_ratio || design.limits.overlap_ratio) && !material.deviation) {
            fields.fail(fmt::format("material {} has no height_deviation (limits ask for it)", material.name),
                        "add it, or remove the limit");
        }
        if (design.limits.overlap_ratio && !material.modulus) {
            fields.fail(fmt::format("material {} has no modulus (overlap_ratio asks for it)", material.name),
                        "add it, or remove the limit");
        }
    }
}

std::vector<scaling::Law> read_laws(JsonFields& fields) {
    if (!fields.has("laws")) return {scaling::Law::mu};
    std::vector<scaling::Law> laws;
    for (const std::string& name : read_names(fields, "laws", R"(["mu", "froude"])")) {
        try {
            laws.push_back(scaling::parse_law(name));
        } catch (const scaling::SimilitudeError& error) {
            throw records::ReadError(fmt::format("{}: laws: {}", fields.place(), error.what()));
        }
    }
    return laws;
}

std::vector<std::string> read_groups(JsonFields& fields) {
    if (!fields.has("groups")) return default_groups();
    const std::vector<std::string> known = known_groups(), names = read_names(fields, "groups", R"(["mu^N", "omega/p"])");
    for (const std::string& name : names) {
        if (std::find(known.begin(), known.end(), name) == known.end()) {
            fields.fail(fmt::format("groups: \"{}\" is no group", name), fmt::format("take some of {}", fmt::join(known, ", ")));
        }
    }
    return names;
}

}  // namespace

Design parse_design(std::string_view json, const std::string& source, const std::vector<Material>& presets) {
    const Json object = Json::parse(json, nullptr, false);
    if (object.is_discarded()) {
        throw records::ReadError(source + R"(: is no JSON; write {"schema": "musim-design/1", "prototype": {...}, "materials": [...]})");
    }
    if (!object.is_object() || !object.contains("schema") || object["schema"] != kSchema) {
        throw records::ReadError(fmt::format("{}: is no design; add \"schema\": \"{}\"", source, kSchema));
    }
    JsonFields fields(object, source);
    fields.has("schema");
    Design design;
    design.name = fields.text("name", "");
    if (!fields.has("prototype")) fields.fail("prototype is missing", R"(add {"block": [...], "height", "density", "friction"})");
    design.prototype = read_prototype(object["prototype"], source + ": prototype");
    design.table_file = fields.text("table", "");
    const bool has_record = fields.has("record");
    if (has_record != !design.table_file.empty()) {
        fields.fail(has_record ? "table is missing (it is to make the record)" : "record is missing (the table is to make it)",
                    "give both, or neither");
    }
    if (has_record) design.motion = read_motion(object["record"], source + ": record");
    if (fields.has("limits")) design.limits = read_limits(object["limits"], source + ": limits");
    design.materials = read_materials(fields, presets);
    design.laws = read_laws(fields);
    design.gravity = read_number(fields, "gravity").value_or(1.0);
    design.length = read_number(fields, "length");
    design.groups = read_groups(fields);
    fields.refuse_unknown_keys();
    check_limits(fields, design);
    return design;
}

}  // namespace musim::design
