#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "lsdem/motion/settling_simulation.hpp"
#include "lsdem/results/rest.hpp"
#include "lsdem/types.hpp"

namespace musim::lsdem {

/// Where the blocks of a prepared specimen are, and what their contacts hold.
struct PreparedPlaces {
    std::vector<Vector3> position;        ///< centres of mass [m]
    std::vector<Quaternion> orientation;  ///< body to world
    std::vector<Preload> preload;         ///< see Model::preload
};

/// How far a preparation has come, and all it needs to go on to the same bits.
struct PreparationState {
    std::size_t round = 0;                     ///< which settling it is in: one per layer, then those of the whole
    std::uint64_t steps = 0, block_steps = 0;  ///< of the rounds before, see PreparedSpecimen
    SettlingState settling;                    ///< of this round
    std::vector<Release> releases;             ///< blocks put in their places so far
    std::string simulation;                    ///< Simulation::save
    double max_overlap = 0.0;                  ///< before `start`, over the height of a block [-]
    std::optional<PreparedPlaces> start;       ///< where the blocks were when their own inertia was given back to them, if it was
};

}  // namespace musim::lsdem
