#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "lsdem/scene/scene.hpp"
#include "lsdem/scene/scene_error.hpp"

namespace musim::lsdem {

/// Scene from JSON text of the schema musim-scene-1.schema.json.
///
/// Quantities are texts with units ("30 MN/m") or SI numbers; wherever a number stands, a fraction ("1/107") may. Files named in the scene
/// are looked for beside `origin`, the scene's own path, which also names it in messages.
/// Throws SceneError `origin: /json/path: what (why); what to do` for a syntax error (with line and column), a key that is unknown (with
/// the nearest known one), missing or given twice, a value of the wrong type, unit or range.
Scene parse_scene(std::string_view json_text, const std::filesystem::path& origin = "scene");

/// parse_scene of a file; throws SceneError also when it cannot be read.
Scene read_scene(const std::filesystem::path& path);

/// The scene as JSON text, all quantities as SI numbers: parse_scene gives back an equal scene, bit for bit.
std::string write_scene(const Scene& scene);

/// The keys that parse_scene knows, per kind of object: the properties of the definitions of the schema, in their order.
const std::map<std::string, std::vector<std::string>>& scene_keys();

}  // namespace musim::lsdem
