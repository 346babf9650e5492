#pragma once

#include <cstdint>
#include <functional>
#include <optional>

#include "lsdem/model.hpp"
#include "lsdem/motion/simulation.hpp"

namespace musim::lsdem::tests {

/// Observation of a stressed run. Energies are measured against the largest energy in play (kinetic + released by gravity + elastic +
/// losses + |work of the base|), lengths against the smallest edge of all blocks.
struct Observation {
    std::optional<Divergence> divergence;  ///< how the run failed, if it did
    double time = 0.0;                     ///< simulated [s]
    std::uint64_t steps = 0;

    double closure = 0.0;  ///< largest change of the energy balance's balance [-]
    double gain = 0.0;     ///< largest rise of the mechanical energy less base work above its least so far; needs no energy balance [-]
    double drift = 0.0;    ///< largest displacement of a block relative to the base within the last quarter of the run [-]
    double kinetic_at_end = 0.0;    ///< [-]
    double reported_overlap = 0.0;  ///< Statistics::max_overlap_over_height, times the height of the tallest block [-]
    double measured_overlap = 0.0;  ///< deepest overlap of two boxes, or of a box and the ground, from their poses at any sample [-]
    bool probed_by_nodes = false;   ///< some block is: it may sink in between nodes
};

/// Runs for `duration` [s] at `time_step` [s] and looks `samples` times; `look`, if any, is called each time and once at the start.
Observation observe(const Model& model, double time_step, double duration, int samples,
                    const std::function<void(const Simulation&)>& look = {});

/// The step that a scene with "step": "auto" gets [s].
double default_time_step(const Model& model);

}  // namespace musim::lsdem::tests
