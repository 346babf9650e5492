#pragma once

#include <cstddef>
#include <vector>

#include "lsdem/results/history.hpp"

namespace musim::lsdem {

/// The largest force that a load came to: of a structure that gives way under an actuator, what it bears in that way.
struct LargestLoad {
    double force = 0.0;         ///< along the load's direction [N]
    double displacement = 0.0;  ///< of its point then, likewise [m]
    double time = 0.0;          ///< of the first sample with it [s]
};

/// Largest forces of the loads of a run, at its samples, load by load.
std::vector<LargestLoad> find_largest_loads(const RunData& run);

}  // namespace musim::lsdem
