#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "lsdem/plot/plot.hpp"
#include "lsdem/study/pair.hpp"

namespace musim::lsdem {

/// What makes a structure's motion dimensionless: time times √(μ g/l), velocities over √(μ g l) [Andrade22].
struct MotionScales {
    double friction = 0.0;  ///< μ of the lowest block [-]; 0 makes time and velocity dimensional
    double gravity = 0.0;   ///< [m/s²]
    double height = 0.0;    ///< l, from the lowest to the highest point at the start [m]
};

/// Scales of a specimen.
MotionScales find_motion_scales(const Specimen& specimen);

/// Indices of the spine blocks to show in a picture, bottom to top: at most ten, evenly chosen, the lowest and the highest among them.
std::vector<std::size_t> choose_rows(std::size_t spine);

/// Spine velocities of the prototype and its models along the axis that the base shakes most, or along which the spine
/// moves most when the base stands: v/PGV, or v/√(μ g l), over t √(μ g/l), every run scaled back to the prototype. At most ten levels,
/// evenly chosen. About the prototype's is the band of its twins, when there are any. `name` says of what.
StackedPlot make_spine_plot(const PairStudy& study, const MotionScales& scales, const std::string& name);

}  // namespace musim::lsdem
