#include <fmt/format.h>

#include "lsdem/scene/detail/scene_parts.hpp"

namespace musim::lsdem::detail {
namespace {

using scaling::JsonReader;

CompoundForm parse_compound(const JsonReader& object, const std::filesystem::path& origin) {
    CompoundForm compound;
    if (object.has("parts") == object.has("file")) {
        object.fail("either \"parts\" or a \"file\" makes a compound",
                    object.has("file") ? "leave one of the two out" : "add one of the two");
    }
    if (object.has("file")) {
        compound.file = resolve(object.get<std::string>("file"), origin);
        compound.unit = object.get<std::string>("unit");
        return compound;
    }
    const JsonReader parts = object["parts"];
    if (!parts.json().is_array()) parts.fail("a list [ ... ] of parts is wanted; correct the value");
    for (const JsonReader& part : parts.entries()) read_fields(to_object(part, "shape_part"), compound.parts.emplace_back());
    read_fields(object, compound);
    return compound;
}

ShapeEntry parse_shape_entry(const JsonReader& value, const std::filesystem::path& origin) {
    const std::size_t kind = read_kind(value, "kind", {kShapeKinds.begin(), kShapeKinds.end()});
    const JsonReader object = to_object(value, std::string(kShapeKinds[kind]) + "_shape");
    ShapeEntry shape;
    shape.form = make_alternative<ShapeForm>(kind);
    std::visit([&](auto& form) { read_fields(object, form); }, shape.form);
    if (auto* mesh = std::get_if<MeshForm>(&shape.form)) mesh->file = resolve(object.get<std::string>("file"), origin);
    if (auto* compound = std::get_if<CompoundForm>(&shape.form)) *compound = parse_compound(object, origin);
    if (!shape.is_sphere()) read_fields(object, shape);
    return shape;
}

/// The entries of a list that may have any number.
std::vector<JsonReader> read_list(const JsonReader& json, const char* of) {
    if (!json.json().is_array()) json.fail(fmt::format("a list [ ... ] of {} is wanted; correct the value", of));
    return json.entries();
}

}  // namespace

void read_value(const JsonReader& json, ShapeAxis& axis) {
    axis = static_cast<ShapeAxis>(to_choice(json, {kShapeAxes.begin(), kShapeAxes.end()}));
}

void read_value(const JsonReader& json, std::array<double, 3>& scale) {
    scale = json.json().is_array() ? json.as<std::array<double, 3>>() : std::array{json.number(), json.number(), json.number()};
}

void read_value(const JsonReader& json, ChosenPart& part) {
    if (json.json().is_string()) {
        part = json.text();
    } else {
        part = json.as<std::size_t>();
    }
}

void read_value(const JsonReader& json, std::vector<std::array<scaling::Length, 2>>& outline) {
    for (const JsonReader& corner : read_list(json, "corners")) {
        if (!corner.json().is_array() || corner.json().size() != 2) corner.fail("two coordinates of a corner are wanted; correct the list");
        const std::vector<JsonReader> both = corner.entries();
        outline.push_back({both[0].quantity<scaling::Length>(), both[1].quantity<scaling::Length>()});
    }
}

void read_value(const JsonReader& json, std::vector<std::string>& names) {
    for (const JsonReader& name : read_list(json, "names")) names.push_back(name.text());
}

void read_value(const JsonReader& json, std::vector<Triple<scaling::Length>>& points) {
    for (const JsonReader& point : read_list(json, "points")) points.push_back(point.as<Triple<scaling::Length>>());
}

void read_value(const JsonReader& json, std::vector<std::vector<std::uint32_t>>& faces) {
    for (const JsonReader& face : read_list(json, "faces")) {
        std::vector<std::uint32_t>& corners = faces.emplace_back();
        for (const JsonReader& corner : read_list(face, "numbers of corners")) corners.push_back(corner.as<std::uint32_t>());
    }
}

void read_value(const JsonReader& json, std::array<Triple<scaling::Inertia>, 3>& tensor) {
    const std::vector<JsonReader> rows = json.triple();
    for (std::size_t k = 0; k < 3; ++k) tensor[k] = rows[k].as<Triple<scaling::Inertia>>();
}

std::map<std::string, ShapeEntry> parse_shapes(const JsonReader& value, const std::filesystem::path& origin) {
    if (!value.json().is_object()) value.fail("an object of named shapes is wanted; correct the value");
    std::map<std::string, ShapeEntry> shapes;
    for (const auto& [name, unused] : value.json().items()) shapes.emplace(name, parse_shape_entry(value.at(name), origin));
    return shapes;
}

}  // namespace musim::lsdem::detail
