#pragma once

#include <cstdint>

namespace musim::scaling {

/// The 64 random bits number `index` of the sequence `seed`: SplitMix64 [Steele14] by index instead of one after another, so that many
/// threads can draw from one sequence in any order. Whole-number arithmetic: the same on every machine.
constexpr std::uint64_t random_bits(std::uint64_t seed, std::uint64_t index) {
    std::uint64_t z = seed + (index + 1) * 0x9E3779B97F4A7C15ULL;
    z = (z ^ (z >> 30U)) * 0xBF58476D1CE4E5B9ULL;
    z = (z ^ (z >> 27U)) * 0x94D049BB133111EBULL;
    return z ^ (z >> 31U);
}

/// A probability from random bits: the middle of one of 2^52 equal parts of (0, 1), so never 0 or 1, and exact in a double.
constexpr double to_probability(std::uint64_t bits) { return (static_cast<double>(bits >> 12U) + 0.5) * 0x1p-52; }

}  // namespace musim::scaling
