#include "lsdem/scene/block_heights.hpp"

#include <cmath>
#include <numbers>

#include "lsdem/scene/detail/split_mix64.hpp"

namespace musim::lsdem {
namespace {

/// One normal number from two uniform ones.
double draw_normal(detail::SplitMix64& random) {
    const double radius = std::sqrt(-2.0 * std::log(random.uniform()));
    return radius * std::cos(2.0 * std::numbers::pi * random.uniform());
}

template <class OfStructure>
std::optional<HeightVariation> variation_of(const OfStructure& structure) {
    if constexpr (requires { structure.height_deviation; }) {
        if (structure.height_deviation != scaling::Length{}) return HeightVariation{structure.height_deviation, structure.seed};
    }
    return std::nullopt;
}

}  // namespace

std::optional<HeightVariation> find_height_variation(const Scene& scene) {
    return std::visit([](const auto& structure) { return variation_of(structure); }, scene.structure);
}

std::vector<double> draw_deviates(std::size_t count, std::uint64_t seed) {
    detail::SplitMix64 random(seed);
    std::vector<double> deviates;
    deviates.reserve(count);
    while (deviates.size() < count) {
        const double z = draw_normal(random);
        if (std::abs(z) <= kMostDeviates) deviates.push_back(z);
    }
    return deviates;
}

}  // namespace musim::lsdem
