#pragma once

#include <optional>
#include <vector>

#include "lsdem/results/rest.hpp"
#include "lsdem/run/settle.hpp"
#include "lsdem/run/simulate.hpp"
#include "lsdem/scene/preparation.hpp"

namespace musim::lsdem {

/// Settings by which a specimen is prepared.
struct PreparationSettings {
    BlockPlacing placing = BlockPlacing::layers_mass_scaled;
    Settling settling;
    bool from_equilibrium = false;  ///< of BlockPlacing::as_drawn: settles from put_in_equilibrium, not from where nothing bears yet
    /// Time step over that of a run, of BlockPlacing::layers_mass_scaled and resting: blocks that touch little are stable in it, the others
    /// get inertia that makes them so (Inertia::as_stable) [-].
    double stride = 4.0;
    double lowering = 0.02;  ///< speed at which a layer is let down, over √(gH) [-]
    /// The next layer comes when every block below has less kinetic energy than this part of its weight times its height, a drop from as
    /// much of it [-]; or after its patience over α, since a block that is nearly balanced tips slowly and goes on doing so under the next
    /// layer. Blocks that come upright have farther to tip than those that come as they will rest. See docs/theory/preparation.md.
    double layer_rest = 1e-8;
    double layer_patience = 2.5;    ///< of BlockPlacing::layers and layers_mass_scaled [-]
    double resting_patience = 0.5;  ///< of BlockPlacing::resting [-]
    /// Number of times that the whole comes to rest: to `early_rest` while blocks may still tip, in the last round to the end, with the
    /// damping that suits sway.
    std::size_t whole_rounds = 2;
    /// Time after its layers, over α, from which a structure that is not at rest while inertia is added gets its own back, and comes to
    /// rest in steps of a run.
    double added_patience = 15.0;
    double early_rest = 1e-6;  ///< all of these rounds but the last end at this: no block tips any more [-]
    /// α of the last round over that of the others: no block tips any more, sway decays. It is slower with mass scaling [-].
    double last_damping = 1.5;
    double last_damping_with_mass_scaling = 0.75;
};

/// Loads and places of prepared blocks; one entry per layer.
struct LayerState {
    double mean_tilt = 0.0, max_tilt = 0.0;   ///< of the blocks' axes from the vertical [rad]
    double mean_force = 0.0, sd_force = 0.0;  ///< normal force between two blocks, or a block and the ground, on the layer's lower side [N]
};

/// A specimen in its settled state.
struct PreparedSpecimen {
    Specimen specimen;               ///< poses as settled, and what the contacts hold, see Model::preload
    Rest rest;                       ///< of the last settling
    std::vector<LayerState> layers;  ///< from 1 at the base; empty for blocks that are in no layers
    std::vector<double> tilt;        ///< of every block [rad]
    std::vector<double> force;       ///< normal force of every contact, over m g of a block [-]
    std::uint64_t steps = 0;         ///< of all settling
    std::uint64_t block_steps = 0;   ///< the same times the blocks that moved: what it cost
    double max_overlap = 0.0;        ///< largest overlap ever met on the way, over the height of a block [-]
};

/// Work that follows a preparation, for its progress.
struct WorkToFollow {
    double preparations = 0.0;  ///< others that cost as much
    double block_steps = 0.0;   ///< of runs
};

/// Prepares a specimen whose blocks stand upright at their places in plan (make_specimen of a scene), or goes on from where a preparation
/// of the same specimen was, to the same bits. Where it stands is written to settings.checkpoint as it falls due. Throws
/// std::invalid_argument as Simulation does, and for blocks without layers that are to be placed, std::runtime_error when `from` is of
/// another specimen; a preparation that diverges says so in `rest`. Progress is counted in block steps. What the rounds of
/// the whole take is known as a range only: the part that is done counts the most, on_preparation_spare receives the difference.
PreparedSpecimen prepare(const Specimen& upright, double time_step, const PreparationSettings& preparation,
                         const RunSettings& settings = {}, const std::optional<PreparationState>& from = {},
                         const WorkToFollow& to_follow = {});

/// Work that a preparation takes, before it begins, or still takes on its way [block steps].
struct PreparationWork {
    double least = 0.0, most = 0.0;
};

/// Estimate of a preparation's work: of blocks that are placed in layers each layer takes its patience and the whole 4 to 12 times 1/α, as
/// seen in uneven walls and rings; of blocks as drawn nothing that counts: they begin in equilibrium. Throws std::invalid_argument as
/// prepare() does.
PreparationWork estimate_preparation(const Specimen& upright, double time_step, const PreparationSettings& preparation);

/// Where the blocks of a simulation are, and what they hold.
PreparedPlaces find_places(const Simulation& simulation);

/// Where the blocks of a specimen are.
PreparedPlaces places_of(const Specimen& specimen);

/// Puts the blocks of a specimen where they were. Throws std::runtime_error when those are other blocks.
void put_in_place(const PreparedPlaces& places, Specimen& specimen);

}  // namespace musim::lsdem
