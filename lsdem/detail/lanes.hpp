#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>

/// Four doubles that are computed side by side. The width is part of the arithmetic, not of the machine: sums run lane by lane and are
/// folded in one fixed order, so the same bits come out of SSE2, AVX2 and scalar code.
namespace musim::lsdem::detail {

inline constexpr std::size_t kLanes = 4;
using Lanes = double __attribute__((vector_size(32)));
using LaneMask = std::int64_t __attribute__((vector_size(32)));

[[gnu::always_inline]] inline Lanes all(double value) { return Lanes{value, value, value, value}; }

[[gnu::always_inline]] inline Lanes load(const double* from) { return Lanes{from[0], from[1], from[2], from[3]}; }

[[gnu::always_inline]] inline Lanes gather(const double* from, const std::uint32_t* index) {
    return Lanes{from[index[0]], from[index[1]], from[index[2]], from[index[3]]};
}

[[gnu::always_inline]] inline void store(const Lanes& value, double* to) {
    for (std::size_t i = 0; i < kLanes; ++i) to[i] = value[i];
}

[[gnu::always_inline]] inline Lanes select(const LaneMask& mask, const Lanes& yes, const Lanes& no) { return mask ? yes : no; }

[[gnu::always_inline]] inline Lanes larger(const Lanes& a, const Lanes& b) { return select(a > b, a, b); }

[[gnu::always_inline]] inline Lanes smaller(const Lanes& a, const Lanes& b) { return select(a < b, a, b); }

[[gnu::always_inline]] inline bool any(const LaneMask& mask) { return (mask[0] | mask[1] | mask[2] | mask[3]) != 0; }

[[gnu::always_inline]] inline bool all_of(const LaneMask& mask) { return (mask[0] & mask[1] & mask[2] & mask[3]) != 0; }

[[gnu::always_inline]] inline Lanes root(const Lanes& value) {
    Lanes result{};
    for (std::size_t i = 0; i < kLanes; ++i) result[i] = std::sqrt(value[i]);
    return result;
}

[[gnu::always_inline]] inline double sum(const Lanes& value) { return (value[0] + value[1]) + (value[2] + value[3]); }

/// The sums of four lanes each, side by side; in the order of `sum`.
[[gnu::always_inline]] inline Lanes sums(const Lanes& a, const Lanes& b, const Lanes& c, const Lanes& d) {
    const Lanes ab = Lanes{a[0], b[0], a[2], b[2]} + Lanes{a[1], b[1], a[3], b[3]};
    const Lanes cd = Lanes{c[0], d[0], c[2], d[2]} + Lanes{c[1], d[1], c[3], d[3]};
    return Lanes{ab[0], ab[1], cd[0], cd[1]} + Lanes{ab[2], ab[3], cd[2], cd[3]};
}

}  // namespace musim::lsdem::detail
