#include "lsdem/results/history.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace musim::lsdem {

std::string to_string(RunStatus status) {
    constexpr std::array kNames{"completed", "collapsed", "diverged"};
    return kNames.at(static_cast<std::size_t>(status));
}

std::string BlockTable::label(std::size_t block) const {
    return block < name.size() && !name[block].empty() ? name[block] : fmt::format("block {}", block);
}

std::string BlockTable::describe(std::size_t block) const {
    const std::string number = fmt::format("block {}", block);
    return label(block) == number ? number : fmt::format("{} (\"{}\")", number, label(block));
}

std::vector<std::string> label_spine(const RunData& run) {
    std::vector<std::string> labels;
    for (std::size_t s = 0; s < run.spine.size(); ++s) {
        labels.push_back(run.blocks.is_listed() ? run.blocks.label(run.spine.block[s]) : fmt::format("level {}", run.spine.level[s]));
    }
    return labels;
}

std::vector<std::string> head_spine(const RunData& run) {
    std::vector<std::string> heads = label_spine(run);
    for (std::size_t s = 0; s < heads.size(); ++s) {
        const bool has_name = run.blocks.is_listed() && !run.blocks.name[run.spine.block[s]].empty();
        if (!has_name) heads[s].erase(heads[s].find(' '), 1);
    }
    return heads;
}

std::vector<std::size_t> sort_spine_by_height(const RunData& run) {
    std::vector<std::size_t> order(run.spine.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    const std::vector<Vector3>& position = run.history.spine_position;
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return position[a].z() < position[b].z(); });
    return order;
}

double compute_energy_closure(const std::vector<Energy>& energy) {
    double change = 0.0;
    double in_play = 0.0;
    for (const Energy& now : energy) {
        const Energy& start = energy.front();
        change = std::max(change, std::abs(now.balance() - start.balance()));
        in_play = std::max(in_play, now.kinetic + std::abs(now.gravitational - start.gravitational) + now.elastic_normal +
                                        now.elastic_shear + now.friction_loss + now.damping_loss + now.preparation_loss +
                                        std::abs(now.base_work) + std::abs(now.load_work));
    }
    return in_play > 0.0 ? change / in_play : 0.0;
}

}  // namespace musim::lsdem
