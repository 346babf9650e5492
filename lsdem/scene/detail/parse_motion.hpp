#pragma once

#include <filesystem>
#include <vector>

#include "lsdem/scene/scene.hpp"
#include "scaling/json_reader.hpp"

namespace musim::lsdem::detail {

/// A scene's "base_motion"; files that it names stand beside `origin`. Throws SceneError, as the next.
SceneMotion parse_base_motion(const scaling::JsonReader& value, const std::filesystem::path& origin);

/// A scene's "motions", one after another.
std::vector<MotionEntry> parse_motions(const scaling::JsonReader& list, const std::filesystem::path& origin);

}  // namespace musim::lsdem::detail
