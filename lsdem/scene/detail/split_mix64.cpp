#include "lsdem/scene/detail/split_mix64.hpp"

#include <bit>

#include "scaling/random_bits.hpp"

namespace musim::lsdem::detail {

std::uint64_t SplitMix64::next() { return scaling::random_bits(seed_, drawn_++); }

std::uint64_t SplitMix64::below(std::uint64_t bound) { return next() % bound; }

std::uint64_t SplitMix64::halvings() { return static_cast<std::uint64_t>(std::countl_zero(next())); }

double SplitMix64::uniform() { return static_cast<double>((next() >> 11U) + 1) * 0x1p-53; }

}  // namespace musim::lsdem::detail
