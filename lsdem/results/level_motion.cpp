#include "lsdem/results/level_motion.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstddef>
#include <stdexcept>

#include "lsdem/results/base_frame.hpp"

namespace musim::lsdem {
namespace {

std::vector<LevelSample> measure_block(const RunData& run, std::size_t spine_block) {
    const History& history = run.history;
    std::vector<LevelSample> samples(history.samples());
    for (std::size_t k = 0; k < samples.size(); ++k) {
        const Vector3 moved = find_moved(run, spine_block, k);
        const auto length = [&](double value) { return run.similitude.to_prototype(scaling::Length::from_value(value)); };
        samples[k] = {run.similitude.to_prototype(scaling::Time::from_value(history.time[k])), length(moved.x()), length(moved.y()),
                      length(moved.z())};
    }
    return samples;
}

}  // namespace

std::vector<LevelSample> measure_level(const RunData& run, int level) {
    const auto found = std::find(run.spine.level.begin(), run.spine.level.end(), level);
    if (found == run.spine.level.end()) {
        throw std::invalid_argument(fmt::format("level {} is not of the spine, which has {}", level, fmt::join(run.spine.level, ", ")));
    }
    return measure_block(run, static_cast<std::size_t>(found - run.spine.level.begin()));
}

std::vector<LevelSample> measure_top(const RunData& run) {
    if (run.spine.size() == 0) throw std::invalid_argument("the run has no spine, hence no top");
    return measure_block(run, sort_spine_by_height(run).back());
}

}  // namespace musim::lsdem
