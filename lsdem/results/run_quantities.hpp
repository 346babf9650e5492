#pragma once

#include <string>
#include <vector>

#include "lsdem/results/damage.hpp"
#include "lsdem/results/history.hpp"
#include "scaling/laws/similitude.hpp"

namespace musim::lsdem {

/// Results of a motion, in numbers that can be held against those of another run: one for every level of the spine or of the structure.
struct QuantityFamily {
    std::string key;                     ///< in JSON
    std::string title;                   ///< in tables
    std::string unit;                    ///< SI, of the prototype; empty: none
    std::vector<int> level;              ///< of each value, from 1 at the base; 0: of the whole structure
    std::vector<double> value;           ///< in the prototype's units
    std::vector<std::string> name = {};  ///< of each value of a listed block, of which several may be at one level; else no entries
};

/// Quantities of a run, divided by the factors of its similitude to the prototype, always in this order and with as many values for similar
/// runs:
///
///   peak_velocity          largest velocity of a spine block relative to the base
///   residual_displacement  horizontal, of a spine block relative to the base, at the end
///   residual_rotation      of a spine block, at the end
///   slip                   mean of the joints below a level, see Damage
///   loss                   dissipated in the joints below a level, by friction and dashpots
///   total_loss             by all
///   damage_index, fallen_blocks   of the structure, see Damage
std::vector<QuantityFamily> find_quantities(const RunResult& run, const scaling::Similitude& similitude);

}  // namespace musim::lsdem
