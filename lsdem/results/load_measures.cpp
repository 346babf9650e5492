#include "lsdem/results/load_measures.hpp"

namespace musim::lsdem {

std::vector<LargestLoad> find_largest_loads(const RunData& run) {
    std::vector<LargestLoad> largest(run.loads.size());
    for (std::size_t i = 0; i < run.history.load.size(); ++i) {
        const LoadState& now = run.history.load[i];
        LargestLoad& found = largest[i % run.loads.size()];
        if (now.force > found.force) found = {now.force, now.displacement, run.history.time[i / run.loads.size()]};
    }
    return largest;
}

}  // namespace musim::lsdem
