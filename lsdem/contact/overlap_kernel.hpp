#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

#include "lsdem/contact/box_meeting.hpp"
#include "lsdem/contact/overlap_rims.hpp"

/// Both roles of several pairs side by side, see overlap_role.hpp.
namespace musim::lsdem::detail {

constexpr double kLeastCosine = 0.9613;  ///< of the tilt: 16°
constexpr double kMostDepth = 0.05;      ///< of the least half extent
constexpr double kLeastWidth = 8.0;      ///< of the touching area, in depths
constexpr double kLeastMain = 0.3;       ///< part of the load that the main cells bear
/// Terms below this part of size · area are left out [-]: a fraction of what rounding of the positions makes of the load.
constexpr double kNegligible = 1.5e-16;

/// For a stiffness per area of one; vectors in world axes, about the point half way between the middles of the boxes.
template <class W>
struct LaneOverlap {
    using Lanes = typename W::Real;
    using Lanes3 = Triple<Lanes>;
    Lanes3 apart;   ///< from the middle of the first body to that of the second [m]
    Lanes3 force;   ///< on the second body [m³]
    Lanes3 moment;  ///< of it [m⁴]
    Lanes deepest;  ///< largest depth of a point of one body in the other [m]
    Lanes energy;   ///< but for a part overlap²/area of it [m⁴]
    // main cells, half of each body's
    Lanes area;                        ///< [m²]
    Lanes area_depth;                  ///< ∫ depth [m³]
    Lanes3 area_place;                 ///< ∫ place [m³]
    Lanes3 area_square, area_cross;    ///< ∫ of (xx, yy, zz) and (yz, zx, xy) about the cell's own middle [m⁴]
    typename W::Mask irregular;        ///< nothing of the above holds: take the exact function
    typename W::Mask corner;           ///< terms of corners were worth it
    Lanes flush;                       ///< where rims end on the side planes: 1, 2 of the first body's directions, 4, 8 of the second's
    std::array<MainCell<W>, 2> cells;  ///< of both bodies
};

template <class W>
struct Kernel : OverlapRims<W> {
    using Base = OverlapRims<W>;
    using Base::add_bisectors, Base::add_flush_rim, Base::add_main_cell, Base::add_rim_ends, Base::combine, Base::find_side_planes,
        Base::finish_main_cell, Base::scaled;
    using Base::all, Base::guarded, Base::invert, Base::kFar, Base::larger, Base::sign_of, Base::smaller;
    using typename Base::Across, typename Base::Cell, typename Base::Interval, typename Base::LaneMask, typename Base::Lanes,
        typename Base::Lanes3, typename Base::Powers, typename Base::Role;
    using typename Base::Flush, typename Base::Strips;
    using LaneOverlap = detail::LaneOverlap<W>;

    /// A box with its axes named: two in the plane of the face, and the face's outward normal.
    struct FaceAxes {
        Lanes3 p, q, n;
        Lanes half_p, half_q, half_n;
    };
    /// A box as it lies in memory.
    struct Box : BoxAxes<W> {
        Lanes3 position;

        /// Of three that belong to the axes, the one `from` places after that of the face's normal.
        template <class Value>
        MUSIM_WIDE static Value pick(const std::array<LaneMask, 3>& along, const std::array<Value, 3>& of, std::size_t from) {
            return choose(along[0], of[from], choose(along[1], of[(from + 1) % 3], of[(from + 2) % 3]));
        }
        MUSIM_WIDE FaceAxes seen_from(const std::array<LaneMask, 3>& along, const Lanes& sign) const {
            return {pick(along, this->axis, 1), pick(along, this->axis, 2), scaled(pick(along, this->axis, 0), sign),
                    pick(along, this->half, 1), pick(along, this->half, 2), pick(along, this->half, 0)};
        }
    };
    template <class Pairs>
    MUSIM_WIDE static Box gather_box(const Pairs& pairs, BoxMeeting::Box BoxMeeting::*which) {
        const std::array<Lanes, 9> r =
            gather_fields<Lanes, 9>([&](std::size_t lane) MUSIM_WIDE_LAMBDA { return (pairs(lane).*which).rotation; });
        const auto three = [&](const double* BoxMeeting::Box::*from) MUSIM_WIDE_LAMBDA {
            return gather_fields<Lanes, 3>([&](std::size_t lane) MUSIM_WIDE_LAMBDA { return pairs(lane).*which.*from; });
        };
        const std::array<Lanes, 3> place = three(&BoxMeeting::Box::position);
        return {{{Lanes3{r[0], r[1], r[2]}, Lanes3{r[3], r[4], r[5]}, Lanes3{r[6], r[7], r[8]}}, three(&BoxMeeting::Box::half)},
                {place[0], place[1], place[2]}};
    }

    MUSIM_WIDE static Lanes3 combine_middle(const FaceAxes& x, const Lanes3& c, double half) {
        return broadcast<Lanes>(half) * c + x.half_n * x.n;
    }
    /// World axes: force on and moment about the middle of X by what pushes X's faces, and the main cell.
    struct RoleLoad {
        Lanes3 force, moment;
    };
    MUSIM_WIDE static RoleLoad turn_to_world(const Role& role, const FaceAxes& x, const Lanes& handed) {
        RoleLoad load;
        load.force = combine(x.p, x.q, x.n, role.side[0], role.side[1], role.load);
        const Lanes z0 = role.half_normal * role.side[0] - role.side_below[0], z1 = role.half_normal * role.side[1] - role.side_below[1];
        load.moment = scaled(
            combine(x.p, x.q, x.n, role.load_place[1] - z1, z0 - role.load_place[0], role.side_along[1] - role.side_along[0]), handed);
        return load;
    }

    /// As many pairs as there are lanes, which do not depend on each other: in four stages, so that several such groups can go through each
    /// of them in turn while its instructions are at hand.
    template <class Pairs>
    MUSIM_WIDE void gather(const Pairs& pairs) {
        const Lanes zero{};
        const Box first = gather_box(pairs, &BoxMeeting::a), second = gather_box(pairs, &BoxMeeting::b);
        c = second.position - first.position;
        faces = choose_faces<W>(first, second, c);
        a = first.seen_from(faces.along[0], faces.sign[0]);
        b = second.seen_from(faces.along[1], faces.sign[1]);
        // b's axes in its face take names and signs from those of a that they are closest to
        {
            const Lanes pp = dot(b.p, a.p), pq = dot(b.p, a.q), qp = dot(b.q, a.p), qq = dot(b.q, a.q);
            const LaneMask swap = magnitude(pp) + magnitude(qq) < magnitude(pq) + magnitude(qp);
            const Lanes sign_p = choose(choose(swap, qp, pp) < zero, all(-1.0), all(1.0)),
                        sign_q = choose(choose(swap, pq, qq) < zero, all(-1.0), all(1.0));
            const Lanes3 p = b.p;
            const Lanes half_p = b.half_p;
            b.p = scaled(choose(swap, b.q, p), sign_p);
            b.q = scaled(choose(swap, p, b.q), sign_q);
            b.half_p = choose(swap, b.half_q, half_p);
            b.half_q = choose(swap, half_p, b.half_q);
        }
        // a's p, q, n are right-handed for sign 1, b's then left-handed
        const Lanes pp = dot(a.p, b.p), pq = dot(a.p, b.q), pn = dot(a.p, b.n), qp = dot(a.q, b.p), qq = dot(a.q, b.q), qn = dot(a.q, b.n),
                    np = dot(a.n, b.p), nq = dot(a.n, b.q);
        cosine = -dot(a.n, b.n);
        {
            Role& x = roles[0];
            x.cosine = cosine, x.half_normal = a.half_n;
            x.depth_at = (b.half_n + dot(c, b.n)) + a.half_n * cosine;
            Across &u = x.across[0], &v = x.across[1];
            u.half = a.half_p, u.side = b.half_p, u.by_x = pp, u.by_y = qp, u.by_s = np, u.at = np * a.half_n - dot(c, b.p),
            u.depth_by_x = -pn;
            v.half = a.half_q, v.side = b.half_q, v.by_x = qq, v.by_y = pq, v.by_s = nq, v.at = nq * a.half_n - dot(c, b.q),
            v.depth_by_x = -qn;
        }
        {
            Role& x = roles[1];
            x.cosine = cosine, x.half_normal = b.half_n;
            x.depth_at = (a.half_n - dot(c, a.n)) + b.half_n * cosine;
            Across &u = x.across[0], &v = x.across[1];
            u.half = b.half_p, u.side = a.half_p, u.by_x = pp, u.by_y = pq, u.by_s = pn, u.at = pn * b.half_n + dot(c, a.p),
            u.depth_by_x = -np;
            v.half = b.half_q, v.side = a.half_q, v.by_x = qq, v.by_y = qp, v.by_s = qn, v.at = qn * b.half_n + dot(c, a.q),
            v.depth_by_x = -nq;
        }
    }
    MUSIM_WIDE void find_main_cells(LaneOverlap& result) {
        for (std::size_t i = 0; i < 2; ++i) {
            Strips strips;
            add_main_cell(roles[i], result.cells[i], strips);
            finish_main_cell(roles[i], strips);
            result.cells[i].load = roles[i].area_depth, result.cells[i].spread = roles[i].spread;
        }
        result.cells[0].along = {a.p, a.q}, result.cells[0].normal = a.n, result.cells[0].middle = combine_middle(a, c, -0.5);
        result.cells[1].along = {b.p, b.q}, result.cells[1].normal = b.n, result.cells[1].middle = combine_middle(b, c, 0.5);
    }
    /// What lies beside the main cells.
    MUSIM_WIDE void add_rims(LaneOverlap& result) {
        const Lanes zero{};
        // a sheet of no thickness, as the ground is given, has no far face
        const Lanes thick_a = choose(a.half_n > zero, a.half_n, a.half_p), thick_b = choose(b.half_n > zero, b.half_n, b.half_p);
        deepest = larger(roles[0].deepest, roles[1].deepest), area = all(0.5) * (roles[0].area + roles[1].area);
        least = smaller(smaller(smaller(a.half_p, a.half_q), thick_a), smaller(smaller(b.half_p, b.half_q), thick_b));
        const Lanes size = smaller(larger(a.half_p, a.half_q), larger(b.half_p, b.half_q));
        const Lanes negligible = all(kNegligible) * (size * area);
        const LaneMask corner = (deepest * deepest) * deepest > negligible;
        result.corner = corner;
        result.flush = zero;
        double bit = 1.0;
        for (Role& role : roles) {
            role.deepest = deepest, role.corner = corner, role.negligible = negligible;
            std::array<std::array<std::array<Flush, 2>, 2>, 2> flush;  // [direction][rim][side plane]
            bool any = some(corner);
            for (std::size_t k = 0; k < 2; ++k, bit *= 2.0) {
#pragma GCC unroll 2
                for (std::size_t r = 0; r < 2; ++r) {
                    flush[k][r][r].find(role, k, r, r);
                    any |= flush[k][r][r].any();
                }
                result.flush += choose(flush[k][0][0].ends | flush[k][1][1].ends, all(bit), zero);
                // a rim crosses the side plane of the other side where the touching area ends in a tip
                const Across &u = role.across[k], &v = role.across[1 - k];
                const LaneMask opposite = (u.side + u.by_x * u.half) - magnitude(u.at) < magnitude(u.by_y) * v.half + all(1.1) * deepest;
                if (!some(opposite)) continue;
#pragma GCC unroll 2
                for (std::size_t r = 0; r < 2; ++r) {
                    Flush& other = flush[k][r][1 - r];
                    other.find(role, k, r, 1 - r);
                    other.touching &= opposite, other.ends &= opposite;
                    any |= other.any();
                }
            }
            if (!any) continue;
            find_side_planes(role);
            for (std::size_t k = 0; k < 2; ++k) {
#pragma GCC unroll 2
                for (std::size_t r = 0; r < 2; ++r) {
#pragma GCC unroll 2
                    for (std::size_t m = 0; m < 2; ++m) {
                        if (flush[k][r][m].any()) add_flush_rim(role, k, r, m, flush[k][r][m]);
                    }
                }
            }
            if (!some(corner)) continue;
            // the lines in which two planes of Y meet X's sides lean with the tilt; what that makes is of the second order in it
            const Lanes lean = magnitude(role.across[0].by_s) + magnitude(role.across[1].by_s);
            const bool leaning = some(corner & ((lean * lean) * ((deepest * deepest) * deepest) > negligible));
            for (std::size_t k = 0; k < 2; ++k) {
#pragma GCC unroll 2
                for (std::size_t r = 0; r < 2; ++r) add_rim_ends(role, k, r, leaning);
            }
            add_bisectors(role);
        }
    }
    MUSIM_WIDE void sum_up(LaneOverlap& result) const {
        const Lanes zero{};
        // how far the touching area reaches across
        LaneMask apart = LaneMask{}, narrow = LaneMask{}, minor = LaneMask{};
        for (const Role& role : roles) {
            for (std::size_t k = 0; k < 2; ++k) {
                const Across &u = role.across[k], &v = role.across[1 - k];
                const Lanes reach = (u.half * magnitude(u.by_x) + v.half * magnitude(u.by_y)) + u.side, width = reach - magnitude(u.at);
                apart |= reach + role.half_normal * magnitude(u.by_s) < magnitude(u.at - role.half_normal * u.by_s);
                narrow |= width < all(kLeastWidth) * deepest;
            }
            const Lanes most = (role.depth_at + magnitude(role.across[0].depth_by_x) * role.across[0].half) +
                               magnitude(role.across[1].depth_by_x) * role.across[1].half;
            apart |= most <= zero;
            minor |= ~(role.area_depth >= all(kLeastMain) * ((role.load + magnitude(role.side[0])) + magnitude(role.side[1])));
        }
        const LaneMask fits = (cosine > all(kLeastCosine)) & (deepest < all(kMostDepth) * least) & ~narrow & ~minor &
                              (roles[0].area > zero) & (roles[1].area > zero);
        result.irregular = ~(faces.found & (fits | (apart & (cosine > all(kLeastCosine)))));

        const RoleLoad of_a = turn_to_world(roles[0], a, faces.sign[0]), of_b = turn_to_world(roles[1], b, -faces.sign[0]);
        // pairs that are apart give nothing, whatever was summed up
        const Lanes half = choose(fits, all(0.5), zero);
        result.apart = c;
        const Lanes3 fa = of_a.force, fb = of_b.force;
        result.force = {half * (fa.x - fb.x), half * (fa.y - fb.y), half * (fa.z - fb.z)};
        const Lanes3 f{half * (fa.x + fb.x), half * (fa.y + fb.y), half * (fa.z + fb.z)};
        result.moment = {half * ((of_a.moment.x - of_b.moment.x) - (c.y * f.z - c.z * f.y)),
                         half * ((of_a.moment.y - of_b.moment.y) - (c.z * f.x - c.x * f.z)),
                         half * ((of_a.moment.z - of_b.moment.z) - (c.x * f.y - c.y * f.x))};
        result.deepest = choose(fits, deepest, zero);
        result.energy = half * (roles[0].energy + roles[1].energy);
        result.area = choose(fits, area, zero);
        result.area_depth = half * (roles[0].area_depth + roles[1].area_depth);
        const auto place = [&](const Role& role, const FaceAxes& x) MUSIM_WIDE_LAMBDA {
            return combine(x.p, x.q, x.n, role.area_place[0], role.area_place[1], role.half_normal * role.area);
        };
        const Lanes3 place_a = place(roles[0], a), place_b = place(roles[1], b);
        const Lanes shift = all(0.25) * (roles[1].area - roles[0].area);
        result.area_place = {half * (place_a.x + place_b.x) + shift * c.x, half * (place_a.y + place_b.y) + shift * c.y,
                             half * (place_a.z + place_b.z) + shift * c.z};
        const auto square = [&](const Role& role, const FaceAxes& x, const Lanes Lanes3::*i, const Lanes Lanes3::*j) MUSIM_WIDE_LAMBDA {
            return half * ((role.area_square[0] * (x.p.*i * x.p.*j) + role.area_square[1] * (x.q.*i * x.q.*j)) +
                           role.area_mixed * (x.p.*i * x.q.*j + x.q.*i * x.p.*j));
        };
        constexpr auto X = &Lanes3::x, Y = &Lanes3::y, Z = &Lanes3::z;
        const auto sum = [&](const Lanes Lanes3::*i, const Lanes Lanes3::*j)
                             MUSIM_WIDE_LAMBDA { return square(roles[0], a, i, j) + square(roles[1], b, i, j); };
        result.area_square = {sum(X, X), sum(Y, Y), sum(Z, Z)};
        result.area_cross = {sum(Y, Z), sum(Z, X), sum(X, Y)};
    }

    // what the stages hand on
    FaceAxes a, b;
    Lanes3 c;  ///< from the middle of a to that of b [m]
    Lanes cosine;
    Lanes deepest, area, least;  ///< of both roles; half of their main cells'; the least half extent [m, m², m]
    MeetingFaces<W> faces;
    std::array<Role, 2> roles;
};

}  // namespace musim::lsdem::detail
