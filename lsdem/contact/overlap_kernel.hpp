#pragma once

#include <array>
#include <cstddef>

#include "lsdem/contact/box_meeting.hpp"
#include "lsdem/contact/overlap_rims.hpp"

/// Both roles of several pairs side by side, see overlap_role.hpp.
namespace musim::lsdem::detail {

constexpr double kLeastCosine = 0.9613;  ///< of the tilt: 16°
constexpr double kMostDepth = 0.05;      ///< of the least half extent
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
    using Base::add_bisectors, Base::add_flush_rim, Base::add_main_cell, Base::add_rim_ends, Base::find_side_planes;
    using Base::all, Base::larger, Base::smaller;
    using typename Base::Across, typename Base::Flush, typename Base::LaneMask, typename Base::Lanes, typename Base::Lanes3,
        typename Base::Role;
    using LaneOverlap = detail::LaneOverlap<W>;

    /// A box with its axes named.
    struct FaceAxes {
        std::array<Lanes3, 2> axis;  ///< in the plane of the face
        Lanes3 n;                    ///< outward normal of it
        std::array<Lanes, 2> half;
        Lanes half_n;

        MUSIM_WIDE Lanes3 to_world(const Lanes& x, const Lanes& y, const Lanes& z) const { return (x * axis[0] + y * axis[1]) + z * n; }
    };
    /// A box as it lies in memory.
    struct Box : BoxAxes<W> {
        Lanes3 position;

        /// Value, of three that belong to the axes, that is `from` places after that of the face's normal.
        template <class Value>
        MUSIM_WIDE static Value pick(const std::array<LaneMask, 3>& along, const std::array<Value, 3>& of, std::size_t from) {
            return choose(along[0], of[from], choose(along[1], of[(from + 1) % 3], of[(from + 2) % 3]));
        }
        MUSIM_WIDE FaceAxes seen_from(const std::array<LaneMask, 3>& along, const Lanes& sign) const {
            return {{pick(along, this->axis, 1), pick(along, this->axis, 2)},
                    sign * pick(along, this->axis, 0),
                    {pick(along, this->half, 1), pick(along, this->half, 2)},
                    pick(along, this->half, 0)};
        }
    };
    template <class Pairs>
    MUSIM_WIDE static Box gather_box(const Pairs& pairs, const BodyPose* BoxMeeting::*which) {
        // numbers behind each other, with one that nobody asks for
        static_assert(offsetof(BodyPose, position) == 9 * sizeof(double) && offsetof(BodyPose, half) == 12 * sizeof(double));
        const std::array<Lanes, 16> f =
            gather_fields<Lanes, 16>([&](std::size_t lane) MUSIM_WIDE_LAMBDA { return (pairs(lane).*which)->rotation.data(); });
        return {{{Lanes3{f[0], f[1], f[2]}, Lanes3{f[3], f[4], f[5]}, Lanes3{f[6], f[7], f[8]}}, {f[12], f[13], f[14]}},
                {f[9], f[10], f[11]}};
    }

    /// Data that role X in Y is made from; `apart`: from the middle of X to that of Y.
    MUSIM_WIDE static void set_up(Role& role, const FaceAxes& x, const FaceAxes& y, const Lanes3& apart, const Lanes& cosine) {
        role.cosine = cosine, role.half_normal = x.half_n;
        role.depth_at = (y.half_n + dot(apart, y.n)) + x.half_n * cosine;
#pragma GCC unroll 2
        for (std::size_t k = 0; k < 2; ++k) {
            Across& u = role.across[k];
            u.half = x.half[k], u.side = y.half[k];
            u.by_x = dot(x.axis[k], y.axis[k]), u.by_y = dot(x.axis[1 - k], y.axis[k]), u.by_s = dot(x.n, y.axis[k]);
            u.at = u.by_s * x.half_n - dot(apart, y.axis[k]);
            u.depth_by_x = -dot(x.axis[k], y.n);
        }
    }
    /// World axes: force on and moment about the middle of X by what pushes X's faces.
    struct RoleLoad {
        Lanes3 force, moment;
    };
    MUSIM_WIDE static RoleLoad turn_to_world(const Role& role, const FaceAxes& x, const Lanes& handed) {
        RoleLoad load;
        load.force = x.to_world(role.side[0], role.side[1], role.load);
        const Lanes z0 = role.half_normal * role.side[0] - role.side_below[0], z1 = role.half_normal * role.side[1] - role.side_below[1];
        load.moment = handed * x.to_world(role.load_place[1] - z1, z0 - role.load_place[0], role.side_along[1] - role.side_along[0]);
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
        boxes = {first.seen_from(faces.along[0], faces.sign[0]), second.seen_from(faces.along[1], faces.sign[1])};
        const FaceAxes& a = boxes[0];
        FaceAxes& b = boxes[1];
        // b's axes in its face take names and signs from those of a that they are closest to
        {
            const Lanes pp = dot(b.axis[0], a.axis[0]), pq = dot(b.axis[0], a.axis[1]), qp = dot(b.axis[1], a.axis[0]),
                        qq = dot(b.axis[1], a.axis[1]);
            const LaneMask swap = magnitude(pp) + magnitude(qq) < magnitude(pq) + magnitude(qp);
            const Lanes sign_p = choose(choose(swap, qp, pp) < zero, all(-1.0), all(1.0)),
                        sign_q = choose(choose(swap, pq, qq) < zero, all(-1.0), all(1.0));
            const std::array<Lanes3, 2> axis = b.axis;
            const std::array<Lanes, 2> half = b.half;
            b.axis = {sign_p * choose(swap, axis[1], axis[0]), sign_q * choose(swap, axis[0], axis[1])};
            b.half = {choose(swap, half[1], half[0]), choose(swap, half[0], half[1])};
        }
        // a's axes and normal are right-handed for sign 1, b's then left-handed
        cosine = -dot(a.n, b.n);
        set_up(roles[0], a, b, c, cosine);
        set_up(roles[1], b, a, -c, cosine);
    }
    MUSIM_WIDE void find_main_cells(LaneOverlap& result) {
        for (std::size_t i = 0; i < 2; ++i) {
            MainCell<W>& cell = result.cells[i];
            add_main_cell(roles[i], cell);
            cell.along = boxes[i].axis, cell.normal = boxes[i].n;
            cell.middle = all(i == 0 ? -0.5 : 0.5) * c + boxes[i].half_n * boxes[i].n;
        }
    }
    /// Parts beside the main cells.
    MUSIM_WIDE void add_rims(LaneOverlap& result) {
        const Lanes zero{};
        deepest = larger(roles[0].deepest, roles[1].deepest), area = all(0.5) * (roles[0].area + roles[1].area);
        const auto least_of = [&](const FaceAxes& x) MUSIM_WIDE_LAMBDA {
            // a sheet of no thickness, as the ground is given, has no far face
            return smaller(smaller(x.half[0], x.half[1]), choose(x.half_n > zero, x.half_n, x.half[0]));
        };
        least = smaller(least_of(boxes[0]), least_of(boxes[1]));
        const Lanes size = smaller(larger(boxes[0].half[0], boxes[0].half[1]), larger(boxes[1].half[0], boxes[1].half[1]));
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
        LaneMask apart = LaneMask{};
        for (const Role& role : roles) {
            for (std::size_t k = 0; k < 2; ++k) {
                const Across &u = role.across[k], &v = role.across[1 - k];
                const Lanes reach = (u.half * magnitude(u.by_x) + v.half * magnitude(u.by_y)) + u.side;
                apart |= reach + role.half_normal * magnitude(u.by_s) < magnitude(u.at - role.half_normal * u.by_s);
            }
            const Lanes most = (role.depth_at + magnitude(role.across[0].depth_by_x) * role.across[0].half) +
                               magnitude(role.across[1].depth_by_x) * role.across[1].half;
            apart |= most <= zero;
        }
        const LaneMask fits = (cosine > all(kLeastCosine)) & (deepest < all(kMostDepth) * least) &
                              ~(roles[0].sides_face | roles[1].sides_face) & (roles[0].area > zero) & (roles[1].area > zero);
        result.irregular = ~(faces.found & (fits | (apart & (cosine > all(kLeastCosine)))));

        const FaceAxes &a = boxes[0], &b = boxes[1];
        const RoleLoad of_a = turn_to_world(roles[0], a, faces.sign[0]), of_b = turn_to_world(roles[1], b, -faces.sign[0]);
        // pairs that are apart give nothing, whatever was summed up
        const Lanes half = choose(fits, all(0.5), zero);
        result.apart = c;
        result.force = half * (of_a.force - of_b.force);
        result.moment = half * ((of_a.moment - of_b.moment) - cross(c, half * (of_a.force + of_b.force)));
        result.deepest = choose(fits, deepest, zero);
        result.energy = half * (roles[0].energy + roles[1].energy);
        result.area = choose(fits, area, zero);
        result.area_depth = half * (roles[0].area_depth + roles[1].area_depth);
        const auto place = [&](const Role& role, const FaceAxes& x) MUSIM_WIDE_LAMBDA {
            return x.to_world(role.area_place[0], role.area_place[1], role.half_normal * role.area);
        };
        const Lanes shift = all(0.25) * (roles[1].area - roles[0].area);
        result.area_place = half * (place(roles[0], a) + place(roles[1], b)) + shift * c;
        const auto square = [&](const Role& role, const FaceAxes& x, const Lanes Lanes3::*i, const Lanes Lanes3::*j) MUSIM_WIDE_LAMBDA {
            const Lanes3 &p = x.axis[0], &q = x.axis[1];
            return half * ((role.area_square[0] * (p.*i * p.*j) + role.area_square[1] * (q.*i * q.*j)) +
                           role.area_mixed * (p.*i * q.*j + q.*i * p.*j));
        };
        constexpr auto kX = &Lanes3::x, kY = &Lanes3::y, kZ = &Lanes3::z;
        const auto sum = [&](const Lanes Lanes3::*i, const Lanes Lanes3::*j)
                             MUSIM_WIDE_LAMBDA { return square(roles[0], a, i, j) + square(roles[1], b, i, j); };
        result.area_square = {sum(kX, kX), sum(kY, kY), sum(kZ, kZ)};
        result.area_cross = {sum(kY, kZ), sum(kZ, kX), sum(kX, kY)};
    }

    // what the stages hand on
    std::array<FaceAxes, 2> boxes;
    Lanes3 c;  ///< from the middle of the first to that of the second [m]
    Lanes cosine;
    Lanes deepest, area, least;  ///< of both roles; half of their main cells'; the least half extent [m, m², m]
    MeetingFaces<W> faces;
    std::array<Role, 2> roles;
};

}  // namespace musim::lsdem::detail
