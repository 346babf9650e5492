#pragma once

#include <string>

#include "lsdem/scene/material_presets.hpp"

namespace musim::lsdem {

/// A measured material by name or from a file:
///
/// - a preset (find_material_preset),
/// - a material file, {"schema": "musim-material/1", "name": ..., "block": [b, w, H], "material": as in a scene}: the block is the
///   one whose whole face has the stiffnesses,
/// - a scene file: its material and block.
///
/// Throws SceneError, also for what is neither a preset nor a file.
MeasuredMaterial find_measured_material(const std::string& preset_or_file);

/// The preset that was measured at this length scale. Throws SceneError when there is none, with the scales that there are.
MeasuredMaterial find_material_at(double length);

}  // namespace musim::lsdem
