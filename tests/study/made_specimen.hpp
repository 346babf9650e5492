#pragma once

#include <cstddef>

#include "lsdem/run/simulate.hpp"
#include "lsdem/time_step.hpp"

namespace musim::lsdem {

/// A column of unit cubes of 1000 kg on a ground of friction 0.5 that jerks along x: 2 m/s² for 0.25 s, then back to rest. It slides
/// at once if the friction is below 0.2. Each cube sinks by its static overlap, so that the column starts in equilibrium.
inline Specimen make_column(std::size_t cubes, double friction = 0.5) {
    constexpr double kGravity = 10.0;   // [m/s²]
    constexpr double kMass = 1000.0;    // [kg]
    constexpr double kStiffness = 1e9;  // [Pa/m]
    const Material material{.normal_stiffness = kStiffness,
                            .shear_stiffness = kStiffness,
                            .friction = friction,
                            .restitution = 0.3,
                            .shear_damping_ratio = 0.0};

    Specimen specimen;
    specimen.model.shapes = {make_box_shape({1.0, 1.0, 1.0}, {3, 3, 3})};
    specimen.model.materials = {material};
    specimen.model.gravity = {0.0, 0.0, -kGravity};
    specimen.model.ground.material = material;
    specimen.model.ground.motion.shift[0] = {.start = 0.0, .dt = 0.25, .velocity = {0.0, 0.5, 0.0}};
    double top = 0.0;
    for (std::size_t i = 0; i < cubes; ++i) {
        const double carried = kMass * kGravity * static_cast<double>(cubes - i);
        top -= carried / kStiffness;
        specimen.model.blocks.push_back({.mass = kMass, .position = {0.0, 0.0, top + 0.5}});
        top += 1.0;
        specimen.spine.block.push_back(i);
        specimen.spine.level.push_back(static_cast<int>(i) + 1);
        specimen.layer.push_back(static_cast<int>(i) + 1);
    }
    return specimen;
}

/// A plan of `samples` samples, 20 steps each, at half the critical time step.
inline TimePlan make_plan(const Specimen& specimen, std::uint64_t samples) {
    return {.time_step = 0.5 * compute_critical_time_step(specimen.model), .steps_per_sample = 20, .samples = samples};
}

}  // namespace musim::lsdem
