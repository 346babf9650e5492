#pragma once

#include <cstdint>

#include "lsdem/scene/scene.hpp"

namespace musim::lsdem {

/// Is anything of a scene's specimen drawn: heights of blocks, or its scatter? Else all seeds give the same specimen.
bool draws_specimen(const Scene& scene);

/// The seed of a scene's specimen: that of the heights where blocks of unequal height are drawn (of several structures that of the first),
/// else of the scatter, else of a structure's even heights; 1 for one that has none.
std::uint64_t seed_of(const Scene& scene);

/// The scene with another seed of its specimen. All its seeds are counted on by the same, so that structures whose seeds differ stay
/// different. Throws SceneError for one that has no seed: single blocks without scatter.
Scene with_seed(Scene scene, std::uint64_t seed);

}  // namespace musim::lsdem
