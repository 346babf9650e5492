#include "records/design/detail/material_fields.hpp"

#include <fmt/ranges.h>

#include <algorithm>

namespace musim::design::detail {

Json parse_object(std::string_view json, const std::string& source, std::string_view schema, std::string_view what,
                  std::string_view example) {
    Json object = records::detail::parse_json(json, source, fmt::format(R"(write {{"schema": "{}", {}}})", schema, example));
    if (!object.is_object() || !object.contains("schema") || object["schema"] != schema) {
        throw records::ReadError(fmt::format("{}: is no {}; add \"schema\": \"{}\"", source, what, schema));
    }
    object.erase("schema");
    return object;
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
    constexpr std::string_view kEdges[] = {"b", "w", "H"};
    Block block;
    for (std::size_t i = 0; i < block.size(); ++i) {
        block[i] = fields.to_quantity<scaling::Length>(fields[key][i], key, kEdges[i]);
        if (!(block[i].value() > 0.0 && std::isfinite(block[i].value()))) {
            fields.fail(fmt::format("a length of {} is not above zero", key), "correct it");
        }
    }
    return block;
}

std::optional<scaling::Stress> read_modulus(JsonFields& fields, const char* modulus_key, const char* stiffness_key,
                                            const std::function<Block()>& find_block) {
    auto modulus = read_positive<scaling::Stress>(fields, modulus_key);
    const auto stiffness = read_positive<scaling::Stiffness>(fields, stiffness_key);
    if (modulus && stiffness) fields.fail(fmt::format("{} contradicts {}", modulus_key, stiffness_key), "remove one of them");
    if (!stiffness) return modulus;
    const Block block = find_block();
    return scaling::Stress(*stiffness * block[2] / (block[0] * block[1]));
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

std::optional<Material> read_preset(JsonFields& fields, const std::vector<Material>& presets) {
    if (!fields.has("preset")) return std::nullopt;
    return find_preset(require_text(fields, "preset"), fields.place(), presets);
}

Material read_properties(JsonFields& fields, const std::optional<Material>& preset, const std::function<Block()>& find_block) {
    Material material = preset.value_or(Material{});
    if (!preset || fields.has("density")) material.density = require_positive<scaling::Density>(fields, "density");
    if (!preset || fields.has("friction")) material.friction = require_positive<scaling::Ratio>(fields, "friction").value();
    replace(material.restitution, read_number(fields, "restitution"));
    replace(material.modulus, read_modulus(fields, "modulus", "normal_stiffness", find_block));
    replace(material.shear_modulus, read_modulus(fields, "shear_modulus", "shear_stiffness", find_block));
    replace(material.deviation, read_positive<scaling::Length>(fields, "height_deviation"));
    return material;
}

}  // namespace musim::design::detail
