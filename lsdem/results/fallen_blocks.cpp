#include "lsdem/results/fallen_blocks.hpp"

#include <algorithm>

#include "lsdem/block_height.hpp"
#include "lsdem/fallen.hpp"

namespace musim::lsdem {
namespace {

/// Median height of the centres of each layer, from layer 0 [m].
std::vector<double> find_median_heights(const std::vector<int>& layer, const Kinematics& places) {
    std::vector<std::vector<double>> heights;
    for (std::size_t i = 0; i < layer.size(); ++i) {
        const auto k = static_cast<std::size_t>(layer[i]);
        if (k >= heights.size()) heights.resize(k + 1);
        heights[k].push_back(places.position[i].z());
    }
    std::vector<double> medians;
    for (std::vector<double>& of_layer : heights) {
        const auto middle = of_layer.begin() + static_cast<std::ptrdiff_t>(of_layer.size() / 2);
        std::nth_element(of_layer.begin(), middle, of_layer.end());
        medians.push_back(of_layer.empty() ? 0.0 : *middle);
    }
    return medians;
}

}  // namespace

std::size_t count_fallen(const std::vector<Vector3>& size, const std::vector<int>& layer, const Kinematics& places) {
    const std::vector<double> medians = find_median_heights(layer, places);
    std::size_t fallen = 0;
    for (std::size_t i = 0; i < layer.size(); ++i) {
        if (layer[i] == 0) continue;
        const double sunk = medians[static_cast<std::size_t>(layer[i])] - places.position[i].z();
        if (has_fallen(0.5 * size[i], Matrix3::Identity(), places.orientation[i].toRotationMatrix(), sunk)) ++fallen;
    }
    return fallen;
}

std::size_t count_fallen(const Simulation& simulation, const std::vector<int>& layer) {
    const Model& model = simulation.model();
    std::vector<Vector3> size;
    for (const Block& block : model.blocks) size.emplace_back(2.0 * half_extents(model, block));
    return count_fallen(size, layer, simulation.kinematics());
}

}  // namespace musim::lsdem
