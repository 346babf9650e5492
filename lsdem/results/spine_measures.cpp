#include "lsdem/results/spine_measures.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "lsdem/results/base_frame.hpp"

namespace musim::lsdem {

int find_strongest_axis(const History& history) {
    Vector3 base = Vector3::Zero(), spine = Vector3::Zero();
    for (const BaseState& state : history.base) base += state.velocity.cwiseAbs2();
    for (const Vector3& v : history.spine_velocity) spine += v.cwiseAbs2();
    Eigen::Index axis = 0;
    (base.sum() > 0.0 ? base : spine).maxCoeff(&axis);
    return static_cast<int>(axis);
}

std::vector<SpineLevel> measure_spine(const RunData& run, int axis) {
    const History& history = run.history;
    const std::size_t ns = run.spine.size();
    // rotation as a camera sees it that looks along the horizontal axis across the motion
    const int across = axis == 1 ? 0 : 1;
    std::vector<SpineLevel> levels(ns);
    for (std::size_t s = 0; s < ns; ++s) {
        SpineLevel& level = levels[s];
        level.level = run.spine.level[s];
        if (run.blocks.is_listed()) level.name = run.blocks.label(run.spine.block[s]);
        level.height = history.spine_position[s].z();
        for (std::size_t k = 0; k < history.samples(); ++k) {
            const Vector3 moved = find_moved(run, s, k);
            const Vector3& turned = history.spine_rotation[k * ns + s];
            level.residual_displacement = moved;
            level.peak_displacement = level.peak_displacement.cwiseMax(moved.cwiseAbs());
            level.peak_velocity = level.peak_velocity.cwiseMax(history.spine_velocity[k * ns + s].cwiseAbs());
            level.in_plane_residual = turned[across];
            level.in_plane_peak = std::max(level.in_plane_peak, std::abs(turned[across]));
            level.vertical_residual = turned.z();
            level.vertical_peak = std::max(level.vertical_peak, std::abs(turned.z()));
        }
    }
    return levels;
}

std::string axis_name(int axis) { return std::string(1, "xyz"[axis]); }

}  // namespace musim::lsdem
