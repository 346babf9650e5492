#pragma once

#include <vector>

#include "lsdem/results/history.hpp"
#include "scaling/units.hpp"

namespace musim::lsdem {

/// Where a block was at an instant.
struct LevelSample {
    scaling::Time time{};
    scaling::Length x{}, y{},
        z{};  ///< displacement of its centre of mass since the start, seen from the base: along the world's axes at t = 0
};

/// Motion of the spine's block of a level against the base, sample by sample, in the prototype's units: times over λ_t, lengths over λ_l.
/// Throws std::invalid_argument for a level that the spine does not have.
std::vector<LevelSample> measure_level(const RunData& run, int level);

/// The same of the highest block of the spine.
std::vector<LevelSample> measure_top(const RunData& run);

}  // namespace musim::lsdem
