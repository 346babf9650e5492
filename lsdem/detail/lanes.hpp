#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "lsdem/detail/wide.hpp"

/// Four doubles that are computed side by side. The width is part of the arithmetic, not of the machine: sums run lane by lane and are
/// folded in one fixed order, so the same bits come out of SSE2, AVX2 and scalar code.
namespace musim::lsdem::detail {

inline constexpr std::size_t kLanes = 4;
using Lanes = Wide<kLanes>::Real;
using LaneMask = Wide<kLanes>::Mask;

[[gnu::always_inline]] inline Lanes load(const double* from) { return Lanes{from[0], from[1], from[2], from[3]}; }

[[gnu::always_inline]] inline Lanes gather(const double* from, const std::uint32_t* index) {
    return Lanes{from[index[0]], from[index[1]], from[index[2]], from[index[3]]};
}

[[gnu::always_inline]] inline void store(const Lanes& value, double* to) {
    for (std::size_t i = 0; i < kLanes; ++i) to[i] = value[i];
}

[[gnu::always_inline]] inline double sum(const Lanes& value) { return (value[0] + value[1]) + (value[2] + value[3]); }
[[gnu::always_inline]] inline double largest(const Lanes& value) {
    return std::max(std::max(value[0], value[1]), std::max(value[2], value[3]));
}

}  // namespace musim::lsdem::detail
