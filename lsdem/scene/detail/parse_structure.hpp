#pragma once

#include <filesystem>

#include "lsdem/scene/scene.hpp"
#include "scaling/json_reader.hpp"

namespace musim::lsdem::detail {

/// A scene's "shape". Throws SceneError, as the next.
ShapeSettings parse_shape(const scaling::JsonReader& value);

/// A scene's "structure"; files that it names stand beside `origin`. `needs_size`: blocks say their size, as all but spheres do.
Structure parse_structure(const scaling::JsonReader& value, const std::filesystem::path& origin, bool needs_size);

}  // namespace musim::lsdem::detail
