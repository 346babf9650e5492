#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "lsdem/motion/settling_simulation.hpp"
#include "lsdem/types.hpp"

namespace musim::lsdem {

/// Settings by which a structure is brought to rest before anything is done to it.
struct Settling {
    double damping_rate = 0.0;  ///< α of v' = −α v while it settles [1/s]
    /// At rest when every block's kinetic energy is below this part of its weight times its height: velocities below 1.4e-5 of sqrt(gH),
    /// a thousandth of what an earthquake brings [-].
    double rest = 1e-10;
    double reaction = 1e-5;  ///< and the base bears the weight to within this [-]
    double patience = 60.0;  ///< given up after this many times 1/α; a ring of 38 layers, whose blocks tip one by one, needs 18 [-]
};

/// A block that has left the place where it was drawn.
struct MovedBlock {
    std::size_t block = 0;
    Vector3 drawn = Vector3::Zero(), now = Vector3::Zero();  ///< its centre of mass then and now [m]
    double turned = 0.0;                                     ///< whole angle since [rad]
};

/// End of a settling.
struct Rest {
    bool at_rest = false;                 ///< false: patience ran out
    std::uint64_t steps = 0;              ///< taken
    double kinetic = 0.0;                 ///< of the liveliest block, over its weight times its height [-]
    double reaction_over_weight = 0.0;    ///< at the end
    std::vector<MovedBlock> fallen = {};  ///< since they were drawn, see find_fallen
    bool collapsed = false;               ///< so many of them that the structure does not stand as drawn; its motion is not run
};

/// Progress of a settling; with the state of its simulation, all it needs to go on to the same bits.
struct SettlingState {
    std::uint64_t steps = 0;  ///< taken
    int checks_at_rest = 0;   ///< in a row, up to now
    double liveliest = 0.0;   ///< largest kinetic energy of a block so far, over its weight times its height [-]
};

/// Where the blocks of a prepared specimen are, and what their contacts hold.
struct PreparedPlaces {
    std::vector<Vector3> position;        ///< centres of mass [m]
    std::vector<Quaternion> orientation;  ///< body to world
    std::vector<Preload> preload;         ///< see Model::preload
};

/// Progress of a preparation, and all it needs to go on to the same bits.
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
