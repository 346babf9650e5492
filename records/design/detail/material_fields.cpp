#include "records/design/detail/material_fields.hpp"

#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <filesystem>
#include <utility>

#include "records/error.hpp"
#include "scaling/laws/scale_law_catalogue.hpp"

namespace musim::records::detail {

namespace {

/// A law by name, or from a file beside the one that names it.
scaling::ScaleLaw load_law(const std::string& name, const std::string& source) {
    if (const auto shipped = scaling::find_scale_law(name)) return *shipped;
    const std::filesystem::path beside = std::filesystem::path(source).parent_path() / name;
    return scaling::load_scale_law(std::filesystem::exists(beside) ? beside.string() : name);
}

DesignLaw read_law_object(const JsonReader& fields, const std::string& source) {
    scaling::ScaleLaw law = load_law(require_text(fields, "law"), source);
    if (fields.has("hold")) {
        for (const std::string& product : read_names(fields, "hold", R"-(["F_R/(mu*m*g)"])-")) law.held.push_back(product);
    }
    std::vector<scaling::GivenFactor> set;
    if (fields.has("set")) {
        const JsonReader factors = fields["set"];
        if (!factors.json().is_object()) fields.fail("set is no object", R"(write {"F_R": "1/500"}, a factor by the quantity's name)");
        for (const auto& [quantity, value] : factors.json().items()) {
            set.push_back({quantity, require_positive<scaling::Ratio>(factors, quantity).value()});
        }
    }
    fields.refuse_unknown_keys();
    return {std::move(law), std::move(set)};
}

}  // namespace

std::optional<double> read_number(const JsonReader& fields, const std::string& key) {
    const auto value = read_positive<scaling::Ratio>(fields, key);
    return value ? std::optional(value->value()) : std::nullopt;
}

std::string require_text(const JsonReader& fields, const std::string& key) {
    std::string text = fields.find<std::string>(key).value_or("");
    if (text.empty()) fields.fail(fmt::format("{} is missing", key), "add it");
    return text;
}

std::vector<JsonReader> require_list(const JsonReader& fields, const std::string& key, const std::string& example) {
    if (!fields.has(key) || !fields[key].json().is_array() || fields[key].json().empty()) {
        fields.fail(fmt::format("{} is no list", key), "write " + example);
    }
    return fields[key].entries();
}

std::vector<std::string> read_names(const JsonReader& fields, const std::string& key, const std::string& example) {
    std::vector<std::string> names;
    for (const JsonReader& entry : require_list(fields, key, example)) {
        if (!entry.json().is_string()) fields.fail(fmt::format("an entry of {} is no text", key), "write it in quotes");
        names.push_back(entry.text());
    }
    return names;
}

Block require_block(const JsonReader& fields, const std::string& key) {
    if (!fields.has(key) || !fields[key].json().is_array() || fields[key].json().size() != 3) {
        fields.fail(fmt::format("{} is no list of three lengths", key), R"(write ["12.7 mm", "26.4 mm", "39.7 mm"], the height last)");
    }
    constexpr std::string_view kEdges[] = {"b", "w", "H"};
    Block block;
    for (std::size_t i = 0; i < block.size(); ++i) {
        block[i] = fields[key].part(i).quantity<scaling::Length>(kEdges[i]);
        if (!(block[i].value() > 0.0 && std::isfinite(block[i].value()))) {
            fields.fail(fmt::format("a length of {} is not above zero", key), "correct it");
        }
    }
    return block;
}

std::optional<scaling::Stress> read_modulus(const JsonReader& fields, const std::string& modulus_key, const std::string& stiffness_key,
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
    throw ReadError(fmt::format("{}: \"{}\" is no preset; take one of {}, or give its density and friction under a name", place, name,
                                fmt::join(names, ", ")));
}

std::optional<Material> read_preset(const JsonReader& fields, const std::vector<Material>& presets) {
    if (!fields.has("preset")) return std::nullopt;
    return find_preset(require_text(fields, "preset"), fields.place(), presets);
}

Material read_properties(const JsonReader& fields, const std::optional<Material>& preset, const std::function<Block()>& find_block) {
    Material material = preset.value_or(Material{});
    if (!preset || fields.has("density")) material.density = require_positive<scaling::Density>(fields, "density");
    if (!preset || fields.has("friction")) material.friction = require_positive<scaling::Ratio>(fields, "friction").value();
    replace(material.restitution, read_number(fields, "restitution"));
    replace(material.modulus, read_modulus(fields, "modulus", "normal_stiffness", find_block));
    replace(material.shear_modulus, read_modulus(fields, "shear_modulus", "shear_stiffness", find_block));
    replace(material.deviation, read_positive<scaling::Length>(fields, "height_deviation"));
    return material;
}

DesignLaw read_law(const JsonReader& value, const std::string& source) {
    try {
        if (value.json().is_object()) return read_law_object(value, source);
        return load_law(value.text(), source);
    } catch (const scaling::SimilitudeError& error) {
        value.fail(error.what());
    }
}

}  // namespace musim::records::detail
