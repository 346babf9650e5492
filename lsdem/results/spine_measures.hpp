#pragma once

#include <string>
#include <vector>

#include "lsdem/results/history.hpp"

/// Motion of the spine of a run, level by level.
namespace musim::lsdem {

/// One level of the spine. Displacements and rotations since the start, seen from the base.
struct SpineLevel {
    int level = 0;                                    ///< of several listed blocks it may be the same
    std::string name = {};                            ///< of a listed block, see BlockTable::label; else empty
    double height = 0.0;                              ///< of the centre at the start [m]
    Vector3 residual_displacement = Vector3::Zero();  ///< at the end [m]
    Vector3 peak_displacement = Vector3::Zero();      ///< largest absolute value of each component [m]
    Vector3 peak_velocity = Vector3::Zero();          ///< likewise, absolute motion [m/s]
    double in_plane_peak = 0.0,
           in_plane_residual = 0.0;  ///< rotation about the horizontal axis across the motion, as a camera sees it [rad]
    double vertical_peak = 0.0, vertical_residual = 0.0;  ///< rotation about the vertical [rad]
};

/// The axis along which the base moves most (0, 1, 2: x, y, z); along which the spine does when the base stands.
int find_strongest_axis(const History& history);

/// The spine's levels; in-plane rotations are those about the horizontal axis across `axis`.
std::vector<SpineLevel> measure_spine(const RunData& run, int axis);

/// "x", "y" or "z".
std::string axis_name(int axis);

}  // namespace musim::lsdem
