#pragma once

#include "lsdem/scene/material_presets.hpp"
#include "scaling/json_reader.hpp"

namespace musim::lsdem::detail {

/// A scene's "material": the name of a preset, or its properties. Throws SceneError.
BlockMaterial parse_material(const scaling::JsonReader& value);

}  // namespace musim::lsdem::detail
