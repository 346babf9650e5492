#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "scaling/units.hpp"

namespace musim::lsdem {

/// Way in which blocks come to their places before the motion begins.
enum class BlockPlacing {
    as_drawn,           ///< where the structure has them
    resting,            ///< each on the plane it rests on, see put_to_rest, with inertia added while they settle
    layers,             ///< layer by layer, each lowered onto those that have settled [Harmon23, section 5]
    layers_mass_scaled  ///< the same, with inertia added so that steps are longer, see docs/theory/preparation.md
};

/// Preparation before the motion: blocks are placed, or taken from a specimen prepared before, and come to rest under damped velocities.
struct Preparation {
    bool none = false;                    ///< nothing: weight begins to act when the motion does, "preparation": "none"
    std::optional<BlockPlacing> placing;  ///< default: layers_mass_scaled when blocks differ in height, else as drawn
    std::optional<scaling::Frequency>
        damping_rate;  ///< α of v' = −α v; default: half of the blocks' frequency parameter, see lsdem/run/settle.hpp
    std::optional<std::filesystem::path> specimen;  ///< absolute path of a prepared specimen, instead of placing

    bool operator==(const Preparation&) const = default;
};

/// "as_drawn", "resting", "layers", "layers_mass_scaled", in this order.
const std::vector<std::string>& placing_names();
std::string to_string(BlockPlacing placing);

}  // namespace musim::lsdem
