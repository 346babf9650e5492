#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <type_traits>
#include <utility>

/// One number, or several that are computed side by side: what is written for `Wide<n>` is computed for n pairs at once. Lanes never
/// meet, so how many share a register changes no bit. See lsdem/detail/instructions.hpp on why all is inlined.
namespace musim::lsdem::detail {

#if !defined(MUSIM_WIDE)
#define MUSIM_WIDE [[gnu::always_inline]] inline
#define MUSIM_WIDE_LAMBDA __attribute__((always_inline))
#endif

template <std::size_t kCount>
struct Wide;
template <>
struct Wide<1> {
    using Real = double;
    using Mask = bool;
    using Bits = std::uint64_t;
};
template <>
struct Wide<4> {
    using Real = double __attribute__((vector_size(32)));
    using Mask = std::int64_t __attribute__((vector_size(32)));
    using Bits = std::uint64_t __attribute__((vector_size(32)));
};
template <class Real>
inline constexpr std::size_t kWidth = sizeof(Real) / sizeof(double);

/// The same number in all lanes.
template <class Real>
MUSIM_WIDE Real broadcast(double value) {
    if constexpr (std::is_class_v<Real>) {
        return Real::of(value);
    } else {
        return value - Real{};
    }
}
/// The number that `of(lane)` gives for every lane.
template <class Real, class Of>
MUSIM_WIDE Real gather_lanes(const Of& of) {
    const auto gather = [&]<std::size_t... kLane>(std::index_sequence<kLane...>) MUSIM_WIDE_LAMBDA {
        if constexpr (std::is_class_v<Real>) {
            return Real::of(of(kLane)...);
        } else {
            return Real{of(kLane)...};
        }
    };
    return gather(std::make_index_sequence<kWidth<Real>>{});
}

template <class Mask, class Real>
MUSIM_WIDE Real choose(const Mask& mask, const Real& yes, const Real& no) {
    return mask ? yes : no;
}
template <class Real>
MUSIM_WIDE Real larger_of(const Real& a, const Real& b) {
    if constexpr (std::is_class_v<Real>) {
        return a.larger(b);
    } else {
        return a > b ? a : b;
    }
}
template <class Real>
MUSIM_WIDE Real smaller_of(const Real& a, const Real& b) {
    if constexpr (std::is_class_v<Real>) {
        return a.smaller(b);
    } else {
        return a < b ? a : b;
    }
}
template <class Real>
MUSIM_WIDE Real magnitude(const Real& a) {
    return larger_of<Real>(a, -a);
}
template <class Real>
MUSIM_WIDE Real square_root(const Real& value) {
    if constexpr (std::is_class_v<Real>) {
        return value.root();
    } else if constexpr (kWidth<Real> == 1) {
        return std::sqrt(value);
    } else {
        return gather_lanes<Real>([&](std::size_t lane) MUSIM_WIDE_LAMBDA { return std::sqrt(value[lane]); });
    }
}

/// The number, or the answer, in a lane.
template <class Value>
MUSIM_WIDE auto lane_of(const Value& value, std::size_t lane) {
    if constexpr (std::is_arithmetic_v<Value>) {
        return value;
    } else {
        return value[lane];
    }
}

/// Rows for columns.
MUSIM_WIDE void transpose(std::array<double, 1>& /*rows*/) {}
MUSIM_WIDE void transpose(std::array<Wide<4>::Real, 4>& rows) {
    const auto &a = rows[0], &b = rows[1], &c = rows[2], &d = rows[3];
    const auto ab_even = __builtin_shufflevector(a, b, 0, 4, 2, 6), ab_odd = __builtin_shufflevector(a, b, 1, 5, 3, 7);
    const auto cd_even = __builtin_shufflevector(c, d, 0, 4, 2, 6), cd_odd = __builtin_shufflevector(c, d, 1, 5, 3, 7);
    rows = {__builtin_shufflevector(ab_even, cd_even, 0, 1, 4, 5), __builtin_shufflevector(ab_odd, cd_odd, 0, 1, 4, 5),
            __builtin_shufflevector(ab_even, cd_even, 2, 3, 6, 7), __builtin_shufflevector(ab_odd, cd_odd, 2, 3, 6, 7)};
}
/// Copy of fields that do not fill a block of as many as there are lanes: faster as a part of one than one by one.
template <class Real, std::size_t kFields>
inline constexpr bool worth_a_block = kWidth<Real> == 8 && kFields % kWidth<Real> >= 3;
/// `kFields` numbers that lie behind each other, of every lane; `of(lane)` points to the first.
template <class Real, std::size_t kFields, class Of>
MUSIM_WIDE std::array<Real, kFields> gather_fields(const Of& of) {
    constexpr std::size_t kLaneCount = kWidth<Real>;
    std::array<Real, kFields> fields;
#pragma GCC unroll 8
    for (std::size_t first = 0; first < kFields; first += kLaneCount) {
        if (first + kLaneCount <= kFields) {
            std::array<Real, kLaneCount> block;
#pragma GCC unroll 8
            for (std::size_t lane = 0; lane < kLaneCount; ++lane) __builtin_memcpy(&block[lane], of(lane) + first, sizeof(Real));
            transpose(block);
#pragma GCC unroll 8
            for (std::size_t i = 0; i < kLaneCount; ++i) fields[first + i] = block[i];
        } else if constexpr (worth_a_block<Real, kFields>) {
            std::array<Real, kLaneCount> block;
#pragma GCC unroll 8
            for (std::size_t lane = 0; lane < kLaneCount; ++lane) block[lane] = Real::load(of(lane) + first, kFields % kLaneCount);
            transpose(block);
#pragma GCC unroll 8
            for (std::size_t i = first; i < kFields; ++i) fields[i] = block[i - first];
        } else {
#pragma GCC unroll 8
            for (std::size_t i = first; i < kFields; ++i) {
                fields[i] = gather_lanes<Real>([&](std::size_t lane) MUSIM_WIDE_LAMBDA { return of(lane)[i]; });
            }
        }
    }
    return fields;
}
/// Puts them there.
template <class Real, std::size_t kFields, class To>
MUSIM_WIDE void scatter_fields(const std::array<Real, kFields>& fields, const To& to) {
    constexpr std::size_t kLaneCount = kWidth<Real>;
#pragma GCC unroll 8
    for (std::size_t first = 0; first < kFields; first += kLaneCount) {
        if (first + kLaneCount <= kFields) {
            std::array<Real, kLaneCount> block;
#pragma GCC unroll 8
            for (std::size_t i = 0; i < kLaneCount; ++i) block[i] = fields[first + i];
            transpose(block);
#pragma GCC unroll 8
            for (std::size_t lane = 0; lane < kLaneCount; ++lane) __builtin_memcpy(to(lane) + first, &block[lane], sizeof(Real));
        } else if constexpr (worth_a_block<Real, kFields>) {
            std::array<Real, kLaneCount> block{};
#pragma GCC unroll 8
            for (std::size_t i = first; i < kFields; ++i) block[i - first] = fields[i];
            transpose(block);
#pragma GCC unroll 8
            for (std::size_t lane = 0; lane < kLaneCount; ++lane) block[lane].store(to(lane) + first, kFields % kLaneCount);
        } else {
#pragma GCC unroll 8
            for (std::size_t i = first; i < kFields; ++i) {
#pragma GCC unroll 8
                for (std::size_t lane = 0; lane < kLaneCount; ++lane) to(lane)[i] = lane_of(fields[i], lane);
            }
        }
    }
}

/// In any lane?
MUSIM_WIDE bool some(bool mask) { return mask; }
/// In all of them?
MUSIM_WIDE bool every(bool mask) { return mask; }
MUSIM_WIDE bool some(const Wide<4>::Mask& mask) {
    using Pair = std::int64_t __attribute__((vector_size(16)));
    const Pair both = __builtin_shufflevector(mask, mask, 0, 1) | __builtin_shufflevector(mask, mask, 2, 3);
    return (both[0] | both[1]) != 0;
}
MUSIM_WIDE bool every(const Wide<4>::Mask& mask) { return !some(~mask); }
/// ln(a/b) of normal numbers above zero, in sums, products and one quotient only, so that it has the same bits everywhere.
template <class W>
MUSIM_WIDE typename W::Real log_of_ratio(const typename W::Real& a, const typename W::Real& b) {
    using Real = typename W::Real;
    using Bits = typename W::Bits;
    constexpr std::uint64_t kMantissa = 0x000f'ffff'ffff'ffffU, kOne = 0x3ff0'0000'0000'0000U, kTwoTo52 = 0x4330'0000'0000'0000U;
    const Bits bits_a = __builtin_bit_cast(Bits, a), bits_b = __builtin_bit_cast(Bits, b);
    // 2⁵² + exponent, numbers without rounding
    Real exponent = __builtin_bit_cast(Real, (bits_a >> 52) | kTwoTo52) - __builtin_bit_cast(Real, (bits_b >> 52) | kTwoTo52);
    Real over = __builtin_bit_cast(Real, (bits_a & kMantissa) | kOne), under = __builtin_bit_cast(Real, (bits_b & kMantissa) | kOne);
    // their ratio from 1/√2 to √2
    const auto above = over > std::numbers::sqrt2 * under, below = under > std::numbers::sqrt2 * over;
    const Real one = broadcast<Real>(1.0);
    exponent += choose(above, one, choose(below, -one, Real{}));
    over = choose(above, 0.5 * over, over), under = choose(below, 0.5 * under, under);
    const Real t = (over - under) / (over + under), t2 = t * t;
    // Σ t²ᵏ/(2k + 1), in pairs that need not wait for each other; |t| < 0.172: below 1e-17 beyond
    const Real t4 = t2 * t2, t8 = t4 * t4;
    const Real low = (1.0 + t2 * (1.0 / 3.0)) + (1.0 / 5.0 + t2 * (1.0 / 7.0)) * t4;
    const Real middle = (1.0 / 9.0 + t2 * (1.0 / 11.0)) + (1.0 / 13.0 + t2 * (1.0 / 15.0)) * t4;
    const Real high = (1.0 / 17.0 + t2 * (1.0 / 19.0)) + t4 * (1.0 / 21.0);
    const Real series = low + (middle + high * t8) * t8;
    return 2.0 * t * series + exponent * std::numbers::ln2;
}

/// A vector in every lane.
template <class Real>
struct Triple {
    Real x, y, z;

    MUSIM_WIDE friend Triple operator+(const Triple& a, const Triple& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
    MUSIM_WIDE friend Triple operator-(const Triple& a, const Triple& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
    MUSIM_WIDE friend Triple operator*(const Real& a, const Triple& b) { return {a * b.x, a * b.y, a * b.z}; }
    MUSIM_WIDE Triple operator-() const { return {-x, -y, -z}; }
};
template <class Real>
MUSIM_WIDE Real dot(const Triple<Real>& a, const Triple<Real>& b) {
    return (a.x * b.x + a.y * b.y) + a.z * b.z;
}
template <class Real>
MUSIM_WIDE Triple<Real> cross(const Triple<Real>& a, const Triple<Real>& b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
template <class Mask, class Real>
MUSIM_WIDE Triple<Real> choose(const Mask& mask, const Triple<Real>& yes, const Triple<Real>& no) {
    return {choose(mask, yes.x, no.x), choose(mask, yes.y, no.y), choose(mask, yes.z, no.z)};
}

}  // namespace musim::lsdem::detail
