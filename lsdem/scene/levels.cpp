#include "lsdem/scene/levels.hpp"

#include <algorithm>
#include <cstddef>
#include <numeric>

namespace musim::lsdem {
namespace {

/// Part of the height of the lower of two blocks by which centres of two levels differ at least [-].
constexpr double kLevelGap = 0.5;

}  // namespace

std::vector<int> find_levels(const std::vector<Vector3>& position, const std::vector<Vector3>& extent) {
    std::vector<std::size_t> order(position.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return position[a].z() < position[b].z(); });
    std::vector<int> levels(position.size(), 0);
    int level = 0;
    std::size_t first = 0;
    for (const std::size_t b : order) {
        const double lower = std::min(extent[first].z(), extent[b].z());
        if (level == 0 || position[b].z() - position[first].z() >= kLevelGap * lower) ++level, first = b;
        levels[b] = level;
    }
    return levels;
}

}  // namespace musim::lsdem
