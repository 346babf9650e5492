#pragma once

#include <nlohmann/json_fwd.hpp>

#include "lsdem/scene/detail/json_object.hpp"
#include "lsdem/scene/material_presets.hpp"

namespace musim::lsdem::scene::detail {

/// A scene's "material": the name of a preset, or its properties. Throws SceneError.
BlockMaterial parse_material(const nlohmann::json& value, const JsonPlace& place);

}  // namespace musim::lsdem::scene::detail
