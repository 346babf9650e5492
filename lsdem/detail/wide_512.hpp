#pragma once

#include <immintrin.h>

#include "lsdem/detail/wide.hpp"

/// Eight lanes of AVX-512. Its comparisons give masks of one bit a lane, for which vectors of the compiler have no operators. Only for
/// files that define MUSIM_WIDE with these instructions.
namespace musim::lsdem::detail {

struct Mask8 {
    __mmask8 bits;

    MUSIM_WIDE friend Mask8 operator&(Mask8 a, Mask8 b) { return {static_cast<__mmask8>(a.bits & b.bits)}; }
    MUSIM_WIDE friend Mask8 operator|(Mask8 a, Mask8 b) { return {static_cast<__mmask8>(a.bits | b.bits)}; }
    MUSIM_WIDE friend Mask8 operator^(Mask8 a, Mask8 b) { return {static_cast<__mmask8>(a.bits ^ b.bits)}; }
    MUSIM_WIDE Mask8 operator~() const { return {static_cast<__mmask8>(~bits)}; }
    MUSIM_WIDE Mask8& operator&=(Mask8 other) { return *this = *this & other; }
    MUSIM_WIDE Mask8& operator|=(Mask8 other) { return *this = *this | other; }
    MUSIM_WIDE int operator[](std::size_t lane) const { return bits >> lane & 1; }
};
MUSIM_WIDE bool some(Mask8 mask) { return mask.bits != 0; }
MUSIM_WIDE bool every(Mask8 mask) { return mask.bits == 0xff; }

struct Real8 {
    __m512d value;

    MUSIM_WIDE static Real8 of(double a) { return {_mm512_set1_pd(a)}; }
    MUSIM_WIDE static Real8 of(double a, double b, double c, double d, double e, double f, double g, double h) {
        return {_mm512_setr_pd(a, b, c, d, e, f, g, h)};
    }
    /// `count` numbers that lie behind each other; the others are zero.
    MUSIM_WIDE static Real8 load(const double* from, std::size_t count) {
        return {_mm512_maskz_loadu_pd(static_cast<__mmask8>((1U << count) - 1), from)};
    }
    MUSIM_WIDE void store(double* to, std::size_t count) const {
        _mm512_mask_storeu_pd(to, static_cast<__mmask8>((1U << count) - 1), value);
    }
    MUSIM_WIDE double operator[](std::size_t lane) const { return value[lane]; }
    // the second where one is no number or both are equal, as a > b ? a : b
    MUSIM_WIDE Real8 larger(const Real8& other) const { return {_mm512_maskz_max_pd(0xff, value, other.value)}; }
    MUSIM_WIDE Real8 smaller(const Real8& other) const { return {_mm512_maskz_min_pd(0xff, value, other.value)}; }
    MUSIM_WIDE Real8 root() const { return {_mm512_maskz_sqrt_pd(0xff, value)}; }

    MUSIM_WIDE friend Real8 operator+(const Real8& a, const Real8& b) { return {a.value + b.value}; }
    MUSIM_WIDE friend Real8 operator-(const Real8& a, const Real8& b) { return {a.value - b.value}; }
    MUSIM_WIDE friend Real8 operator*(const Real8& a, const Real8& b) { return {a.value * b.value}; }
    MUSIM_WIDE friend Real8 operator/(const Real8& a, const Real8& b) { return {a.value / b.value}; }
    MUSIM_WIDE friend Real8 operator+(const Real8& a, double b) { return a + of(b); }
    MUSIM_WIDE friend Real8 operator-(const Real8& a, double b) { return a - of(b); }
    MUSIM_WIDE friend Real8 operator*(const Real8& a, double b) { return a * of(b); }
    MUSIM_WIDE friend Real8 operator+(double a, const Real8& b) { return of(a) + b; }
    MUSIM_WIDE friend Real8 operator-(double a, const Real8& b) { return of(a) - b; }
    MUSIM_WIDE friend Real8 operator*(double a, const Real8& b) { return of(a) * b; }
    MUSIM_WIDE friend Real8 operator/(double a, const Real8& b) { return of(a) / b; }
    MUSIM_WIDE Real8 operator-() const { return {-value}; }
    MUSIM_WIDE Real8& operator+=(const Real8& other) { return *this = *this + other; }
    MUSIM_WIDE Real8& operator-=(const Real8& other) { return *this = *this - other; }
    MUSIM_WIDE Real8& operator*=(const Real8& other) { return *this = *this * other; }
    MUSIM_WIDE Real8& operator*=(double other) { return *this = *this * other; }
    MUSIM_WIDE friend Mask8 operator>(const Real8& a, const Real8& b) { return {_mm512_cmp_pd_mask(a.value, b.value, _CMP_GT_OQ)}; }
    MUSIM_WIDE friend Mask8 operator<(const Real8& a, const Real8& b) { return {_mm512_cmp_pd_mask(a.value, b.value, _CMP_LT_OQ)}; }
    MUSIM_WIDE friend Mask8 operator>=(const Real8& a, const Real8& b) { return {_mm512_cmp_pd_mask(a.value, b.value, _CMP_GE_OQ)}; }
    MUSIM_WIDE friend Mask8 operator<=(const Real8& a, const Real8& b) { return {_mm512_cmp_pd_mask(a.value, b.value, _CMP_LE_OQ)}; }
};
MUSIM_WIDE Real8 choose(const Mask8& mask, const Real8& yes, const Real8& no) {
    return {_mm512_mask_blend_pd(mask.bits, no.value, yes.value)};
}

MUSIM_WIDE void transpose(std::array<Real8, 8>& rows) {
    using V = __m512d;
    std::array<Real8, 8> pairs, fours;
#pragma GCC unroll 4
    for (std::size_t i = 0; i < 4; ++i) {
        const V a = rows[2 * i].value, b = rows[2 * i + 1].value;
        pairs[2 * i].value = __builtin_shufflevector(a, b, 0, 8, 2, 10, 4, 12, 6, 14);
        pairs[2 * i + 1].value = __builtin_shufflevector(a, b, 1, 9, 3, 11, 5, 13, 7, 15);
    }
#pragma GCC unroll 4
    for (std::size_t i = 0; i < 4; ++i) {
        const std::size_t at = i < 2 ? i : i + 2;
        const V a = pairs[at].value, b = pairs[at + 2].value;
        fours[at].value = __builtin_shufflevector(a, b, 0, 1, 4, 5, 8, 9, 12, 13);
        fours[at + 2].value = __builtin_shufflevector(a, b, 2, 3, 6, 7, 10, 11, 14, 15);
    }
#pragma GCC unroll 4
    for (std::size_t i = 0; i < 4; ++i) {
        const V a = fours[i].value, b = fours[i + 4].value;
        rows[i].value = __builtin_shufflevector(a, b, 0, 1, 4, 5, 8, 9, 12, 13);
        rows[i + 4].value = __builtin_shufflevector(a, b, 2, 3, 6, 7, 10, 11, 14, 15);
    }
}

template <>
struct Wide<8> {
    using Real = Real8;
    using Mask = Mask8;
    using Bits = std::uint64_t __attribute__((vector_size(64)));
};

}  // namespace musim::lsdem::detail
