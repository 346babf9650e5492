#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "lsdem/scene/scene.hpp"
#include "scaling/units.hpp"

namespace musim::lsdem {

/// Heights are cut off at this many standard deviations: 6 in 100,000 draws are made again.
inline constexpr double kMostDeviates = 4.0;

/// The largest standard deviation over the height of the block that a scene may ask for [-]: the measured blocks of [Harmon23] have 0.004.
/// At four deviations a block is then a fifth taller or shorter than the others.
inline constexpr double kMostHeightDeviation = 1.0 / 20.0;

/// Variation of the heights of a structure's blocks.
struct HeightVariation {
    scaling::Length deviation{};  ///< standard deviation σ_H, not zero
    std::uint64_t seed = 1;
};

/// The variation that a scene asks for, if any; only a column, a tower and a wall have one.
std::optional<HeightVariation> find_height_variation(const Scene& scene);

/// `count` draws z_i from the normal distribution of mean 0 and deviation 1, none beyond kMostDeviates [-]; the height of block i is
/// H + z_i·σ_H. Depends on the seed alone, so that a model has the blocks of its prototype. SplitMix64 [Steele14], Box-Muller
/// [BoxMuller58].
std::vector<double> draw_deviates(std::size_t count, std::uint64_t seed);

}  // namespace musim::lsdem
