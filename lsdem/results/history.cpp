#include "lsdem/results/history.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace musim::lsdem {

std::string to_string(RunStatus status) {
    constexpr std::array kNames{"completed", "collapsed", "diverged"};
    return kNames.at(static_cast<std::size_t>(status));
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
        in_play =
            std::max(in_play, now.kinetic + std::abs(now.gravitational - start.gravitational) + now.elastic_normal + now.elastic_shear +
                                  now.friction_loss + now.damping_loss + now.preparation_loss + std::abs(now.base_work));
    }
    return in_play > 0.0 ? change / in_play : 0.0;
}

}  // namespace musim::lsdem
