#pragma once

#include <array>
#include <cstddef>

#include "lsdem/contact/overlap_role.hpp"

namespace musim::lsdem::detail {

/// Parts beside the main cell: along rims that are flush with a side plane of Y, at their ends, and at the corners of Y.
template <class W>
struct OverlapRims : OverlapRole<W> {
    using Base = OverlapRole<W>;
    using Base::all, Base::guarded, Base::kFar, Base::larger, Base::sign_of, Base::smaller;
    using typename Base::Across, typename Base::Interval, typename Base::LaneMask, typename Base::Lanes, typename Base::Powers,
        typename Base::Role;

    /// A side plane m of Y along a rim: d = at + by y + by_s s.
    struct SidePlane {
        Lanes at, by, by_s;
        Lanes inverse, wedge;  ///< 1/by, 1/(2(ζ + by_s)), once find_side_planes was asked
        MUSIM_WIDE Lanes operator()(const Lanes& y) const { return at + by * y; }
    };
    MUSIM_WIDE static SidePlane side_plane(const Across& u, std::size_t side, const Lanes& at, const Lanes& by, const Lanes& inverse) {
        return side == 0 ? SidePlane{u.side + at, by, -u.by_s, inverse, u.wedge[0]}
                         : SidePlane{u.side - at, -by, u.by_s, -inverse, u.wedge[1]};
    }
    MUSIM_WIDE static SidePlane own_plane(const Across& u, const Lanes& x, std::size_t side) {
        return side_plane(u, side, u.at + u.by_x * x, u.by_y, u.inverse_y);
    }
    MUSIM_WIDE static SidePlane end_plane(const Across& v, const Lanes& x, std::size_t side) {
        return side_plane(v, side, v.at + v.by_y * x, v.by_x, v.inverse_x);
    }

    /// The part of rim `r` of direction k on which plane m is the nearest, `part`: its share in the side's load (D²/(2ζ) − (D − d)²/(2(ζ +
    /// g))) and in the strip of face a that ends there (d²/(2 by_x)), if m runs along the rim: m = 0, 1, else 2. `facing`: cosine by which
    /// the side faces the plane.
    MUSIM_WIDE static void add_rim_part(Role& role, std::size_t k, std::size_t r, std::size_t m, const SidePlane& plane, const Lanes& x,
                                        const Lanes& facing, const Lanes& d_at, const Lanes& d_by, Interval part, const LaneMask& where) {
        const Lanes zero{};
        part.keep(-plane.at * plane.inverse, plane.inverse > zero);
        const Lanes y0 = part.low, y1 = part.high, rest = choose(where, part.length(), zero);
        const Lanes p0 = larger(plane(y0), zero), p1 = larger(plane(y1), zero), e0 = d_at + d_by * y0, e1 = d_at + d_by * y1;
        const Powers full(y0, y1, rest, e0, e1), gap(y0, y1, rest, e0 - p0, e1 - p1);
        role.sides_face |= (rest > zero) & (facing > all(kLeastFacing));
        const Lanes one = role.below, two = plane.wedge;
        const Lanes sign = all(sign_of(r));
        role.side[k] += sign * (one * full.square - two * gap.square);
        role.side_along[k] += sign * (one * full.along - two * gap.along);
        role.side_below[k] += sign * (all(2.0 / 3.0) * (one * one * full.cube - two * two * gap.cube));
        if (m == 2) return;
        const Powers d(y0, y1, rest, p0, p1);
        const Lanes beside = all(-sign_of(r) * sign_of(m) * 0.5) * role.across[k].inverse_x;
        role.load += beside * d.square;
        role.load_place[1 - k] += beside * d.along;
        role.load_place[k] += beside * (x * d.square + (all(sign_of(m) / 3.0) * role.across[k].inverse_x) * d.cube);
        // between the plane and the rim, below the strip: ∫ (D d²/2 − d³/6)
        const Lanes s0 = p0 * p0, s1 = p1 * p1, both = (p0 * p1) + (p0 * p1);
        const Lanes deep = (e0 * (all(3.0) * s0 + both + s1) + e1 * (s0 + both + all(3.0) * s1)) * (rest * all(1.0 / 24.0));
        role.energy += (beside + beside) * (deep - all(1.0 / 6.0) * d.cube);
    }

    /// Where plane m ends on the side below the rim: the line d_m = 0 at s = −d_m(y)/g. There D² g/(2ζ(ζ + g)) dy.
    MUSIM_WIDE static void add_side_line(Role& role, std::size_t k, std::size_t r, const SidePlane& plane, const SidePlane& other_low,
                                         const SidePlane& other_high, const Lanes& d_at, const Lanes& d_by, Interval part,
                                         const LaneMask& where) {
        const Lanes zero{};
        const LaneMask up = plane.by_s > zero;
        const Lanes g = larger(magnitude(plane.by_s), all(1e-18));
        const Lanes a0 = choose(up, -plane.at, plane.at), a1 = choose(up, -plane.by, plane.by);  // g s
        const Lanes w0 = g * d_at - role.cosine * a0, w1 = g * d_by - role.cosine * a1;          // g D
        part.keep(-plane.at * plane.inverse, (plane.inverse > zero) ^ up);
        part.clip(w0, w1);
        if (some(role.corner)) {
            const auto clip_end = [&](const SidePlane& end) MUSIM_WIDE_LAMBDA {
                const Lanes slope = guarded(g * end.by + end.by_s * a1), at = -(g * end.at + end.by_s * a0) / slope;
                const LaneMask above = slope > zero;
                part.keep(choose(role.corner, at, choose(above, all(-kFar), all(kFar))), above);
            };
            clip_end(other_low), clip_end(other_high);
        }
        const Lanes length = choose(where, part.length(), zero);
        const Lanes over = all(1.0) / g;
        const Lanes s0 = over * larger(a0 + a1 * part.low, zero), s1 = over * larger(a0 + a1 * part.high, zero);
        const Lanes d0 = over * larger(w0 + w1 * part.low, zero), d1 = over * larger(w0 + w1 * part.high, zero);
        const Powers along_y(part.low, part.high, length, d0, d1), along_s(s0, s1, length, d0, d1);
        const Lanes wedge = role.cosine + plane.by_s, both = all(2.0) * (role.below * plane.wedge);
        const Lanes factor = (all(sign_of(r)) * g) * both;
        role.side[k] += factor * along_y.square;
        role.side_along[k] += factor * along_y.along;
        role.side_below[k] += factor * (along_s.along + (role.cosine + wedge) * (all(2.0 / 3.0) * both) * along_y.cube);
    }

    /// On the side below the rim, the line on which planes m and n are equally near: D − d falls at different rates on its two sides.
    MUSIM_WIDE static void add_side_bisector(Role& role, std::size_t k, std::size_t r, const SidePlane& m, const SidePlane& n,
                                             const Lanes& y, const Lanes& inverse, const Lanes& half, const Lanes& d_at, const Lanes& d_by,
                                             const LaneMask& where) {
        const Lanes zero{}, differ = n.by_s - m.by_s, lean = -differ * inverse;  // y + lean s
        const Lanes gap_at = (d_at + d_by * y) - m(y), gap_by = (d_by - m.by) * lean - (role.cosine + m.by_s);
        Interval part{zero, -gap_at / gap_by};
        part.clip(m(y), m.by * lean + m.by_s);
        part.clip(half - y, -lean);
        part.clip(half + y, lean);
        const Lanes length = choose(where, part.length(), zero);
        const Powers gap(part.low, part.high, length, gap_at + gap_by * part.low, gap_at + gap_by * part.high);
        const Lanes factor =
            all(-0.5 * sign_of(r)) * ((differ * differ) * magnitude(inverse)) / ((role.cosine + m.by_s) * (role.cosine + n.by_s));
        role.side[k] += factor * gap.square;
        role.side_along[k] += factor * (y * gap.square + lean * gap.along);
        role.side_below[k] +=
            factor * (gap.along + all(1.0 / 3.0) * ((all(1.0) / (role.cosine + m.by_s)) + all(1.0) / (role.cosine + n.by_s)) * gap.cube);
    }

    /// Data of rim `r` of direction k.
    struct Rim {
        Lanes x, d_at, d_by, half;
        std::array<SidePlane, 2> own, end;                       ///< along it, and across its ends; lower, upper
        std::array<std::array<Lanes, 2>, 2> meet, meet_inverse;  ///< [own][end]: where both are equally near; 1 / (slope of end − own)
        MUSIM_WIDE Rim(const Role& role, std::size_t k, std::size_t r) {
            const Across &u = role.across[k], &v = role.across[1 - k];
            x = r == 0 ? -u.half : u.half, half = v.half;
            d_at = role.depth_at + u.depth_by_x * x, d_by = v.depth_by_x;
#pragma GCC unroll 2
            for (std::size_t i = 0; i < 2; ++i) own[i] = own_plane(u, x, i), end[i] = end_plane(v, x, i);
#pragma GCC unroll 2
            for (std::size_t i = 0; i < 2; ++i) {
#pragma GCC unroll 2
                for (std::size_t j = 0; j < 2; ++j) {
                    // slopes: end ∓by_x, own ∓by_y
                    meet_inverse[i][j] = j == 0 ? v.bisector[i] : -v.bisector[1 - i];
                    meet[i][j] = (own[i].at - end[j].at) * meet_inverse[i][j];
                }
            }
        }
        /// Stretch of `part` where own plane i is nearer than those of the ends.
        MUSIM_WIDE Interval nearer_own(std::size_t i, Interval part) const {
            part.keep(meet[i][0], meet_inverse[i][0] > all(0.0));
            part.keep(meet[i][1], meet_inverse[i][1] > all(0.0));
            return part;
        }
        MUSIM_WIDE Interval nearer_end(std::size_t j, Interval part) const {
            part.keep(meet[0][j], meet_inverse[0][j] < all(0.0));
            part.keep(meet[1][j], meet_inverse[1][j] < all(0.0));
            return part;
        }
    };

    /// Where side plane m along rim r is nearer than b: the other side of the crease.
    MUSIM_WIDE static Interval beyond_crease(const Across& u, const Lanes& along, std::size_t r, std::size_t m) {
        Interval part{-along, along};
        part.keep(u.crossing[m][r], m == 0 ? u.crease_inverse[0] > all(0.0) : u.crease_inverse[1] < all(0.0));
        return part;
    }
    MUSIM_WIDE static LaneMask touches(const SidePlane& plane, const Interval& part) {
        return (part.low < part.high) & (larger(plane(part.low), plane(part.high)) > all(0.0));
    }

    /// Where rim r runs along side plane m of Y at less than the depth, and where that plane ends below it.
    struct Flush {
        LaneMask touching{}, ends{};
        MUSIM_WIDE void find(const Role& role, std::size_t k, std::size_t r, std::size_t m) {
            const Across &u = role.across[k], &v = role.across[1 - k];
            const SidePlane plane = own_plane(u, r == 0 ? -u.half : u.half, m);
            touching = touches(plane, beyond_crease(u, v.half, r, m));
            const Lanes g = magnitude(plane.by_s), reach = magnitude(plane.by) * v.half + (all(1.1) * g) * role.deepest;
            ends = (magnitude(plane.at) < reach) & ((g * v.half) * (role.deepest * role.deepest) > role.negligible);
        }
        MUSIM_WIDE bool any() const { return some(touching | ends); }
    };

    /// Flush edges: rims that run along side plane m of Y at less than the depth.
    MUSIM_WIDE static void add_flush_rim(Role& role, std::size_t k, std::size_t r, std::size_t m, const Flush& flush) {
        const Across &u = role.across[k], &v = role.across[1 - k];
        const SidePlane plane = own_plane(u, r == 0 ? -u.half : u.half, m);
        const Rim rim(role, k, r);
        if (some(flush.touching)) {
            const Interval part = rim.nearer_own(m, beyond_crease(u, v.half, r, m));
            add_rim_part(role, k, r, m, plane, rim.x, all(-sign_of(r) * sign_of(m)) * u.by_x, rim.d_at, rim.d_by, part, flush.touching);
        }
        if (some(flush.ends)) {
            add_side_line(role, k, r, plane, rim.end[0], rim.end[1], rim.d_at, rim.d_by, Interval{-v.half, v.half}, flush.ends);
        }
    }

    /// Terms of the third order along a rim: at its ends, where it crosses Y's side planes, and about Y's corners.
    MUSIM_WIDE static void add_rim_ends(Role& role, std::size_t k, std::size_t r, bool leaning) {
        const Across &u = role.across[k], &v = role.across[1 - k];
        // a rim farther out of Y than the depth, with its lean, has no part below which it bears, nor has one that is all above plane b
        const Lanes slack = -role.deepest, x = r == 0 ? -u.half : u.half, off = magnitude(u.at + u.by_x * x);
        const LaneMask within = u.side + magnitude(u.by_y) * v.half + all(1.1) * role.deepest > off,
                       below = (role.depth_at + u.depth_by_x * x) + magnitude(v.depth_by_x) * v.half > slack;
        if (!some(role.corner & within & below)) return;
        const Rim rim(role, k, r);
        const Lanes third = (role.deepest * role.deepest) * role.deepest;
#pragma GCC unroll 2
        for (std::size_t j = 0; j < 2; ++j) {
            const SidePlane& plane = rim.end[j];
            const Lanes crease = v.crease_at[j] + v.crease_slope[j] * rim.x;
            const Interval part =
                rim.nearer_end(j, {j == 0 ? -v.half : larger(-v.half, crease), j == 0 ? smaller(v.half, crease) : v.half});
            const LaneMask touching = role.corner & touches(plane, part);
            if (some(touching)) {
                const Lanes facing = all(-sign_of(r) * sign_of(j)) * v.by_y;
                add_rim_part(role, k, r, 2, plane, rim.x, facing, rim.d_at, rim.d_by, part, touching);
            }
            if (!leaning) continue;
            const Lanes y = -plane.at * plane.inverse;
            const LaneMask near = role.corner & (magnitude(y) < v.half - slack) & (rim.d_at + rim.d_by * y > slack) &
                                  (rim.own[0](y) > slack) & (rim.own[1](y) > slack);
            const LaneMask leans = near & ((plane.by_s * plane.by_s) * third > role.negligible);
            if (some(leans)) add_side_line(role, k, r, plane, rim.own[0], rim.own[1], rim.d_at, rim.d_by, Interval{-v.half, v.half}, leans);
#pragma GCC unroll 2
            for (std::size_t i = 0; i < 2; ++i) {
                const SidePlane& own = rim.own[i];
                const Lanes at = rim.meet[i][j], differ = plane.by_s - own.by_s;
                const LaneMask meets = role.corner & ((differ * differ) * third > role.negligible) & (magnitude(at) < v.half - slack) &
                                       (rim.d_at + rim.d_by * at > own(at)) & (own(at) > slack);
                if (some(meets)) add_side_bisector(role, k, r, own, plane, at, rim.meet_inverse[i][j], v.half, rim.d_at, rim.d_by, meets);
            }
        }
    }

    /// Corners of Y seen in X: from the corner, at d = 0, the strips of two side planes share a bisector.
    MUSIM_WIDE static void add_bisectors(Role& role) {
        const Lanes zero{};
        const Across &p = role.across[0], &q = role.across[1];
        const Lanes determinant = p.by_x * q.by_x - p.by_y * q.by_y, inverse = all(1.0) / determinant;
#pragma GCC unroll 2
        for (std::size_t i = 0; i < 2; ++i) {
#pragma GCC unroll 2
            for (std::size_t j = 0; j < 2; ++j) {
                // p.by_x x + p.by_y y = a, q.by_y x + q.by_x y = b at the corner; both less by ±d along the bisector
                const Lanes si = all(sign_of(i)), sj = all(sign_of(j)), a = si * p.side - p.at, b = sj * q.side - q.at;
                const Lanes x0 = (a * q.by_x - b * p.by_y) * inverse, y0 = (b * p.by_x - a * q.by_y) * inverse;
                const Lanes x1 = (sj * p.by_y - si * q.by_x) * inverse, y1 = (si * q.by_y - sj * p.by_x) * inverse;
                const Lanes d0 = (role.depth_at + p.depth_by_x * x0) + q.depth_by_x * y0, d1 = p.depth_by_x * x1 + q.depth_by_x * y1;
                const Lanes top = d0 / (all(1.0) - d1);
                const LaneMask near =
                    role.corner & (top > zero) & (magnitude(x0) < p.half + all(4.0) * top) & (magnitude(y0) < q.half + all(4.0) * top);
                if (!some(near)) continue;
                // inside the rims
                const std::size_t same = i == j ? 0 : 1;
                const Lanes inverse_x = determinant * q.bisector[same],
                            inverse_y = determinant * p.bisector[same];  // 1/x1, 1/y1 but for the sign
                const Lanes middle_x = (si * x0) * inverse_x, middle_y = (sj * y0) * inverse_y;
                const Lanes room_x = magnitude(p.half * inverse_x), room_y = magnitude(q.half * inverse_y);
                const Interval part{larger(zero, larger(middle_x - room_x, middle_y - room_y)),
                                    smaller(top, smaller(middle_x + room_x, middle_y + room_y))};
                const Lanes length = choose(near, part.length(), zero);
                const Powers d(part.low, part.high, length, part.low, part.high);  // ∫ d², ∫ d³, ∫ d³
                const Lanes of_p = -sj * y1 * (all(0.5) * p.inverse_x), of_q = -si * x1 * (all(0.5) * q.inverse_x);
                const Lanes along_x = x0 * d.square + x1 * d.cube, along_y = y0 * d.square + y1 * d.cube;
                role.energy += d.cube;
                role.load += (of_p + of_q) * d.square;
                role.load_place[0] += (of_p + of_q) * along_x + of_p * ((all(1.0 / 3.0) * si) * p.inverse_x) * d.cube;
                role.load_place[1] += (of_p + of_q) * along_y + of_q * ((all(1.0 / 3.0) * sj) * q.inverse_x) * d.cube;
            }
        }
    }
};

}  // namespace musim::lsdem::detail
