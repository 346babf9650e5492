#pragma once

#include <cstddef>
#include <cstdint>

namespace musim::lsdem {

/// How a structure is brought to rest before anything is done to it.
struct Settling {
    double damping_rate = 0.0;  ///< α of v' = −α v while it settles [1/s]
    /// At rest when every block's kinetic energy is below this part of its weight times its height: velocities below 1.4e-5 of sqrt(gH),
    /// a thousandth of what an earthquake brings [-].
    double rest = 1e-10;
    double reaction = 1e-5;  ///< and the base bears the weight to within this [-]
    double patience = 60.0;  ///< given up after this many times 1/α; a ring of 38 layers, whose blocks tip one by one, needs 18 [-]
};

/// How settling ended.
struct Rest {
    bool at_rest = false;               ///< false: patience ran out
    std::uint64_t steps = 0;            ///< taken
    double kinetic = 0.0;               ///< of the liveliest block, over its weight times its height [-]
    double reaction_over_weight = 0.0;  ///< at the end
    std::size_t fallen = 0;             ///< blocks that stand in their layer no more, see count_fallen; where layers are known
};

/// How far a settling has come; with the state of its simulation, all it needs to go on to the same bits.
struct SettlingState {
    std::uint64_t steps = 0;  ///< taken
    int checks_at_rest = 0;   ///< in a row, up to now
    double liveliest = 0.0;   ///< largest kinetic energy of a block so far, over its weight times its height [-]
};

}  // namespace musim::lsdem
