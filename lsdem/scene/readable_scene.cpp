#include "lsdem/scene/readable_scene.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>

#include "lsdem/scene/detail/scene_parts.hpp"
#include "lsdem/scene/scene_error.hpp"
#include "lsdem/scene/scene_json.hpp"
#include "lsdem/scene/tower_tiling.hpp"
#include "scaling/number.hpp"

namespace musim::lsdem {
namespace {

using nlohmann::ordered_json;
namespace fs = std::filesystem;

/// Letters of a line that an object or list may fill before it is broken into lines.
constexpr std::size_t kWidth = 140;

/// A length factor 1/n is written so where n is whole to this part [-].
constexpr double kWhole = 1e-9;

/// On one line, with blanks inside braces: { "kind": "box" }.
std::string write_line(const ordered_json& value) {
    if (!value.is_structured() || value.empty()) return value.dump();
    std::string text;
    for (const auto& [key, entry] : value.items()) {
        if (!text.empty()) text += ", ";
        if (value.is_object()) text += ordered_json(key).dump() + ": ";
        text += write_line(entry);
    }
    return value.is_object() ? "{ " + text + " }" : "[" + text + "]";
}

bool has_comment(const ordered_json& value) {
    if (value.is_object() && value.contains("comment")) return true;
    return value.is_structured() && std::any_of(value.begin(), value.end(), has_comment);
}

/// In as few lines as their width and comments allow, each object or list that is broken with an entry a line.
std::string write_lines(const ordered_json& value, std::size_t indent, bool broken = false) {
    std::string line = write_line(value);
    const bool fits = indent + line.size() <= kWidth && !has_comment(value);
    if (!value.is_structured() || value.empty() || (fits && !broken)) return line;
    const std::string margin(indent + 2, ' ');
    std::string text;
    for (const auto& [key, entry] : value.items()) {
        const std::string name = value.is_object() ? ordered_json(key).dump() + ": " : "";
        text += text.empty() ? "" : ",\n";
        text += margin;
        text += name;
        text += write_lines(entry, indent + 2, key == "comment");
    }
    return (value.is_object() ? "{\n" : "[\n") + text + "\n" + std::string(indent, ' ') + (value.is_object() ? "}" : "]");
}

/// The scene that a text means; nothing where it is none.
std::optional<Scene> try_parse(const ordered_json& root, const fs::path& origin) {
    try {
        return parse_scene(root.dump(), origin);
    } catch (const SceneError&) {
        return std::nullopt;
    }
}

/// Removes what can be left out of an object, at `pointer` of `root`, without making it another scene.
void leave_out_defaults(ordered_json& root, const ordered_json::json_pointer& pointer, const Scene& scene, const fs::path& origin,
                        const std::set<std::string>& kept) {
    const ordered_json before = root.at(pointer);
    for (const auto& [key, value] : before.items()) {
        const auto place = pointer / key;
        if (before.is_object() && !kept.contains(place.to_string())) {
            ordered_json without = root;
            without.at(pointer).erase(key);
            if (try_parse(without, origin) == scene) {
                root = std::move(without);
                continue;
            }
        }
        if (value.is_structured()) leave_out_defaults(root, place, scene, origin, kept);
    }
}

/// The factor as people write it: 1/107, or a quotient of short numbers with the same bits, 0.63/0.59 for 1.0677966101694916.
ordered_json shorten_factor(double factor) {
    const double inverse = 1.0 / factor, whole = std::round(inverse);
    if (whole > 1.0 && std::abs(inverse - whole) <= kWhole * whole) return "1/" + std::to_string(static_cast<long long>(whole));
    constexpr std::size_t kShort = 8;  // digits
    for (int hundredths = 1; hundredths < 1000 && fmt::format("{}", factor).size() > kShort; ++hundredths) {
        const double over = 0.01 * hundredths, under = std::round(factor * hundredths * 10.0);
        const std::string text = fmt::format("{:.6g}/{:.6g}", under / 1000.0, over);
        if (scaling::parse_number(text) == factor) return text;
    }
    return factor;
}

void shorten_tiling(ordered_json& structure) {
    if (!structure.contains("tiling") || structure["tiling"].contains("file")) return;
    for (const std::string& name : tiling_preset_names()) {
        const TilingSettings preset = find_tiling_preset(name);
        const ordered_json text{
            {"cells_across", preset.cells_across}, {"inner_radius", preset.inner_radius}, {"outer_radius", preset.outer_radius}};
        if (structure["tiling"] == text) structure["tiling"] = name;
        if (structure["tiling"].is_string()) return;
    }
}

/// Names that say the same in fewer letters: the tiling by its preset, factors as quotients, a record by its place beside the scene.
void shorten_names(ordered_json& root, const std::optional<fs::path>& folder) {
    if (root.contains("structure")) shorten_tiling(root["structure"]);
    if (root.contains("structures")) {
        for (ordered_json& structure : root["structures"]) shorten_tiling(structure);
    }
    const auto shorten_file = [&](ordered_json& object, const char* file) {
        if (!folder || !object.contains(file)) return;
        const fs::path near = fs::path(object[file].get<std::string>()).lexically_relative(fs::absolute(*folder).lexically_normal());
        if (!near.empty() && *near.begin() != "..") object[file] = near.string();
    };
    if (root.contains("shapes")) {
        for (ordered_json& shape : root["shapes"]) shorten_file(shape, "file");
    }
    if (!root.contains("base_motion") || !root["base_motion"].is_object() || !root["base_motion"].contains("record")) return;
    ordered_json& motion = root["base_motion"];
    for (const char* file : {"record", "station_xml"}) shorten_file(motion, file);
    if (!motion.contains("scale")) return;
    for (const char* factor : {"length", "friction"}) {
        if (motion["scale"].contains(factor)) motion["scale"][factor] = shorten_factor(motion["scale"][factor].get<double>());
    }
}

}  // namespace

std::string write_readable_scene(const Scene& scene, const ReadableText& text) {
    ordered_json root = detail::to_json(scene, detail::QuantityStyle::text);
    shorten_names(root, text.folder);
    const fs::path origin = text.folder.value_or(".") / "scene.json";
    const Scene meant = parse_scene(root.dump(), origin);
    leave_out_defaults(root, ordered_json::json_pointer(), meant, origin, text.kept);
    for (const auto& [pointer, lines] : text.comments) {
        ordered_json& object = root.at(ordered_json::json_pointer(pointer));
        // the comment comes first, but for the format of a scene
        ordered_json commented = ordered_json::object();
        if (pointer.empty()) {
            commented["schema"] = object.at("schema");
            commented["name"] = object.at("name");
        }
        commented["comment"] = lines.size() == 1 ? ordered_json(lines.front()) : ordered_json(lines);
        for (const auto& [key, value] : object.items()) {
            if (!commented.contains(key)) commented[key] = value;
        }
        object = std::move(commented);
    }
    return write_lines(root, 0, true) + "\n";
}

}  // namespace musim::lsdem
