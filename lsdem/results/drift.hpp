#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "lsdem/results/history.hpp"

namespace musim::lsdem {

/// Two blocks of the spine between which drift is measured, by their places in the spine, or one and the base.
struct DriftPair {
    std::size_t upper = 0;
    std::optional<std::size_t> lower;  ///< nothing: the base
    double rise = 0.0;                 ///< Δz > 0 between their centres at the start, or from the structure's underside to the centre [m]
};

/// Pairs from the lowest upwards. In a column, tower or wall each block of the spine with the next lower one. Listed blocks may stand side
/// by side, and then have no drift between them: each counts against the highest one at a lower level that lies under it, their plans
/// overlapping at the start, or against the base. Blocks in the air (Falls::airborne) have none.
std::vector<DriftPair> find_drift_pairs(const RunData& run);

/// Largest |Δu|/Δz of the pairs at a sample, and the place of its upper block.
struct Drift {
    double value = 0.0;  ///< Δu: horizontal, of displacements since the start, seen from the base [-]
    std::size_t upper = 0;
};
Drift find_drift(const RunData& run, const std::vector<DriftPair>& pairs, std::size_t sample);

/// Horizontal displacement of a block of the spine since the start, seen from the base [m].
Vector3 find_shift(const RunData& run, std::size_t spine_block, std::size_t sample);

}  // namespace musim::lsdem
