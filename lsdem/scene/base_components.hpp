#pragma once

#include <string>

#include "lsdem/model.hpp"
#include "lsdem/scene/scene.hpp"

namespace musim::lsdem {

/// Motion of the base for the kernel [m/s, rad/s, s].
///
/// Signals are sampled from their closed-form velocity. Records are read, then filtered, integrated and cut (records::make_base_motion);
/// a window starts at t = 0, and so does the earliest component without one. A record's own scale comes next; the factors of scale_scene
/// come last, one multiplication or division a sample, so that factors that are powers of two are exact.
/// Throws records::ReadError for a record that cannot be used, and SceneError, which names the motion's `place` in the scene, for one that
/// cannot be processed as asked.
BaseComponents make_base_components(const SceneMotion& motion, const std::string& place = "scene: /base_motion");

}  // namespace musim::lsdem
