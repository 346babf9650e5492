#include "lsdem/joint_scatter.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace musim::lsdem {
namespace {

/// Step between the states of a sequence, 2^64 over the golden ratio [Steele14].
constexpr std::uint64_t kGoldenStep = 0x9E3779B97F4A7C15ULL;

/// All bits of the result depend on all of the argument: variant 13 of [Steele14], as in scaling/random_bits.hpp, which the kernel does
/// not link.
std::uint64_t mix(std::uint64_t z) {
    z = (z ^ (z >> 30U)) * 0xBF58476D1CE4E5B9ULL;
    z = (z ^ (z >> 27U)) * 0x94D049BB133111EBULL;
    return z ^ (z >> 31U);
}

/// Uniform in (0, 1], a multiple of 2^−53.
double to_uniform(std::uint64_t bits) { return static_cast<double>((bits >> 11U) + 1) * 0x1p-53; }

}  // namespace

double draw_joint_deviate(std::uint64_t seed, std::size_t a, const std::optional<std::size_t>& b) {
    const std::uint64_t first = a, second = b.value_or(std::numeric_limits<std::size_t>::max());
    std::uint64_t state = mix(seed + kGoldenStep);
    for (const std::uint64_t block : {std::min(first, second), std::max(first, second)}) state = mix((state ^ block) + kGoldenStep);
    while (true) {
        const double radius = std::sqrt(-2.0 * std::log(to_uniform(mix(state += kGoldenStep))));
        const double z = radius * std::cos(2.0 * std::numbers::pi * to_uniform(mix(state += kGoldenStep)));
        if (std::abs(z) <= kMostJointDeviates) return z;
    }
}

}  // namespace musim::lsdem
