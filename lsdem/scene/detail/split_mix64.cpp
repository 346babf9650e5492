#include "lsdem/scene/detail/split_mix64.hpp"

#include <bit>

namespace musim::lsdem::scene::detail {

std::uint64_t SplitMix64::next() {
    state_ += 0x9E3779B97F4A7C15ULL;
    std::uint64_t z = state_;
    z = (z ^ (z >> 30U)) * 0xBF58476D1CE4E5B9ULL;
    z = (z ^ (z >> 27U)) * 0x94D049BB133111EBULL;
    return z ^ (z >> 31U);
}

std::uint64_t SplitMix64::below(std::uint64_t bound) { return next() % bound; }

std::uint64_t SplitMix64::halvings() { return static_cast<std::uint64_t>(std::countl_zero(next())); }

double SplitMix64::uniform() { return static_cast<double>((next() >> 11U) + 1) * 0x1p-53; }

}  // namespace musim::lsdem::scene::detail
