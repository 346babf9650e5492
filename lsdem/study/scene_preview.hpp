#pragma once

#include <string>

#include "lsdem/run/scene_summary.hpp"

namespace musim::lsdem {

/// A scene before it is run, as an SVG document: the structure as its blocks are drawn, on the ground, with a ruler for its height, its
/// width along x and y, and the blocks whose motion is sampled marked; what there is to say in numbers; below, the acceleration of the base
/// over time, several motions one after another.
std::string make_preview_svg(const SceneSummary& summary);

}  // namespace musim::lsdem
