#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "lsdem/contact/contact_step.hpp"
#include "lsdem/contact/main_cells.hpp"
#include "lsdem/contact/overlap_kernel.hpp"
#include "lsdem/contact/overlap_lanes.hpp"

/// Steps and overlaps of overlap_lanes.hpp, for any number of lanes.
namespace musim::lsdem::detail {

/// Gathers and scatters fields of several pairs.
template <class W>
struct Lane {
    using Real = typename W::Real;
    using Mask = typename W::Mask;
    using Vector = Triple<Real>;
    using Step = ContactStep<W>;

    /// `apart`: from the middle of the first body to that of the second. Also the place of the pair's origin from the point half way
    /// between the middles of the boxes.
    MUSIM_WIDE static typename Step::Motion gather_motion(const LanePair* pairs, const Vector& apart, Vector& origin_shift) {
        using Turn = typename Step::Motion::Turn;
        // numbers behind each other: turn x, y, z, w, then shift
        static_assert(sizeof(BodyStep) == 8 * sizeof(double) && offsetof(BodyStep, shift) == 4 * sizeof(double));
        const auto step_of = [&](const BodyPose* BoxMeeting::*body) MUSIM_WIDE_LAMBDA {
            return gather_fields<Real, 8>(
                [&](std::size_t i) MUSIM_WIDE_LAMBDA { return reinterpret_cast<const double*>(&(pairs[i].meeting.*body)->step); });
        };
        const std::array<Real, 8> first = step_of(&BoxMeeting::a), second = step_of(&BoxMeeting::b);
        const Real origin = gather_lanes<Real>([&](std::size_t i) MUSIM_WIDE_LAMBDA { return pairs[i].meeting.origin; });
        typename Step::Motion motion;
        motion.shift = {second[4] - first[4], second[5] - first[5], second[6] - first[6]};
        const Vector apart_before = apart - motion.shift;
        const Real rest = 1.0 - origin;
        motion.center = {-origin * apart, rest * apart};
        motion.previous_center = {-origin * apart_before, rest * apart_before};
        motion.turn = {Turn::of({first[0], first[1], first[2]}, first[3]), Turn::of({second[0], second[1], second[2]}, second[3])};
        origin_shift = (origin - 0.5) * apart;
        return motion;
    }
    /// All numbers of a contact lie behind each other, from the springs on.
    static constexpr std::size_t kNumbers = 25;
    static_assert(sizeof(OverlapContact) == (1 + kNumbers) * sizeof(double) && offsetof(OverlapContact, sliding) == sizeof(double));

    MUSIM_WIDE static typename Step::Memory gather_memory(const LanePair* pairs) {
        const std::array<Real, kNumbers> f =
            gather_fields<Real, kNumbers>([&](std::size_t i) MUSIM_WIDE_LAMBDA { return &pairs[i].contact->sliding.area; });
        const Real touches = gather_lanes<Real>([&](std::size_t i) MUSIM_WIDE_LAMBDA { return pairs[i].contact->touches ? 1.0 : 0.0; });
        return {touches > Real{},
                {f[0], f[1], {f[2], f[3], f[4]}, {f[5], f[6], f[7]}},
                {f[8], f[9], f[10], f[11]},
                f[12],
                {f[13], f[14], f[15]},
                {f[16], f[17], f[18]},
                {{f[19], f[20], f[21]}, {f[22], f[23], f[24]}}};
    }
    MUSIM_WIDE static std::array<Real, kNumbers> numbers_of(const typename Step::Memory& m) {
        const auto& s = m.sliding;
        const auto& t = m.turning;
        const auto &c = s.in_core, &r = s.in_rest, &p = m.place, &w = m.couple, &f = m.dashpots.force, &d = m.dashpots.couple;
        return {s.area, s.core, c.x, c.y, c.z, r.x, r.y, r.z, t.area, t.core, t.in_core, t.in_rest, m.lightest,
                p.x,    p.y,    p.z, w.x, w.y, w.z, f.x, f.y, f.z,    d.x,    d.y,       d.z};
    }
    MUSIM_WIDE static typename Step::Law gather_law(const LanePair* pairs) {
        static_assert(sizeof(Interface) == 5 * sizeof(double));
        const std::array<Real, 5> f =
            gather_fields<Real, 5>([&](std::size_t i) MUSIM_WIDE_LAMBDA { return &pairs[i].law->normal_stiffness; });
        return {f[0], f[1], f[2], f[3], f[4]};
    }
    MUSIM_WIDE static Vector3 pick(const Vector& v, std::size_t lane) {
        return {lane_of(v.x, lane), lane_of(v.y, lane), lane_of(v.z, lane)};
    }

    /// Part that the main cells have in friction and dashpots [-].
    MUSIM_WIDE static Real share_of(const LaneOverlap<W>& found) {
        return share_of_facing<Real>(-dot(found.cells[0].normal, found.cells[1].normal));
    }
    /// The geometry of the contact about the pair's origin, and its main cells.
    MUSIM_WIDE static typename Step::Geometry make_geometry(const LaneOverlap<W>& found, const Vector& shift, MainCells<W>& cells) {
        typename Step::Geometry geometry;
        const Real zero{}, over = choose(found.area > zero, 1.0 / found.area, zero);
        geometry.force = found.force;
        geometry.moment = found.moment - cross(shift, found.force);
        geometry.deepest = found.deepest;
        const Real squared = dot(found.force, found.force);
        const Vector pressed = choose(squared > zero, 1.0 / squared, zero) * cross(geometry.force, geometry.moment);
        geometry.arm = over * found.area_place - shift - pressed;
        cells.depth = over * found.area_depth;
        cells.depth_slope = -(found.cells[0].normal + found.cells[1].normal);
        geometry.energy = found.energy;
        const Real share = share_of(found);
        geometry.area = share * found.area;
        geometry.square = share * found.area_square, geometry.cross_square = share * found.area_cross;
        cells.share = 0.5 * share;
        cells.shift = shift;
        return geometry;
    }

    /// Energies are rough where the square of the depth is more than this part of the area [-]: they are off by a fifth of that part on
    /// broad faces, by 60 times as much on slivers, as the test of the lanes holds.
    static constexpr double kRoughly = 1e-6;

    /// Step of pairs, from what they remember, which is updated. `area`: of the overlap; `rough`: see PairTally.
    template <class Cells>
    MUSIM_WIDE static typename Step::Result compute(LanePair* pairs, const typename Step::Geometry& geometry,
                                                    const typename Step::Motion& motion, double dt, bool first_step, const Real& area,
                                                    const Mask& rough, Cells& cells) {
        const Real stored_shear = gather_lanes<Real>([&](std::size_t i) MUSIM_WIDE_LAMBDA { return pairs[i].tally->elastic_shear; });
        typename Step::Memory memory = gather_memory(pairs);
        const typename Step::Result result =
            Step::compute(geometry, motion, gather_law(pairs), dt, first_step, stored_shear, cells, memory);
        const Real deepest = choose(memory.touches, geometry.deepest, Real{}), touching_area = choose(memory.touches, area, Real{});
        const Mask is_rough = memory.touches & rough;
        scatter_fields<Real, kNumbers>(numbers_of(memory),
                                       [&](std::size_t i) MUSIM_WIDE_LAMBDA { return &pairs[i].contact->sliding.area; });
        const Vector force = -result.force, leader = cross(motion.center[0], result.force) - result.moment,
                     follower = result.moment - cross(motion.center[1], result.force);
        static_assert(sizeof(PairForce) == 9 * sizeof(double));
        scatter_fields<Real, 9>({force.x, force.y, force.z, leader.x, leader.y, leader.z, follower.x, follower.y, follower.z},
                                [&](std::size_t i) MUSIM_WIDE_LAMBDA { return pairs[i].force->force.data(); });
        static_assert(offsetof(PairTally, overlap) == 2 * sizeof(double));
        scatter_fields<Real, 3>({result.elastic_normal, result.elastic_shear, deepest},
                                [&](std::size_t i) MUSIM_WIDE_LAMBDA { return &pairs[i].tally->elastic_normal; });
        for (std::size_t i = 0; i < kWidth<Real>; ++i) {
            LanePair& pair = pairs[i];
            const bool touches = lane_of(memory.touches, i) != 0;
            pair.contact->touches = touches;
            pair.tally->touching = touches ? 1 : 0;
            pair.tally->rough = lane_of(is_rough, i) != 0;
            *pair.work += {lane_of(result.friction_work, i), lane_of(result.damping_work, i)};
            pair.area = lane_of(touching_area, i);
        }
        return result;
    }

    MUSIM_WIDE static void compute(LanePair* pairs, double dt, bool first_step, const LaneOverlap<W>& found, LaneOutput& nowhere) {
        Vector shift;
        const typename Step::Motion motion = gather_motion(pairs, found.apart, shift);
        if (some(found.irregular)) {
            for (std::size_t i = 0; i < kWidth<Real>; ++i) {
                if (found.irregular[i] != 0) pairs[i].irregular = true, pairs[i].put_into(nowhere);
            }
        }
        MainCells<W> cells{found.cells, {}, {}, {}, {}};
        const Mask rough = found.deepest * found.deepest > kRoughly * found.area;
        const typename Step::Result result =
            compute(pairs, make_geometry(found, shift, cells), motion, dt, first_step, found.area, rough, cells);
        const auto company = find_company(result, found);
        for (std::size_t i = 0; i < kWidth<Real>; ++i) pairs[i].contact->company = static_cast<std::uint32_t>(company[i]);
    }
    /// See OverlapContact::company; in the lowest bits.
    MUSIM_WIDE static std::array<std::uint64_t, kWidth<Real>> find_company(const typename Step::Result& result,
                                                                           const LaneOverlap<W>& found) {
        constexpr double kTwoTo52 = 0x1p52;  // brings a small whole number into the lowest bits
        const auto bit = [](const Mask& mask, double value) MUSIM_WIDE_LAMBDA { return choose(mask, broadcast<Real>(value), Real{}); };
        const Real edges = 0x1p15 * found.cells[0].bounds + 0x1p7 * found.cells[1].bounds;
        const Real asked = bit(result.may_pull, 0x1p6) + bit(result.may_both, 0x1p5) + bit(found.corner, 0x1p4) + found.flush;
        const Real sum = bit(result.may_slide, 0x1p23) + (edges + asked);
        return __builtin_bit_cast(std::array<std::uint64_t, kWidth<Real>>, sum + kTwoTo52);
    }

    MUSIM_WIDE static void store(const LaneOverlap<W>& found, LaneFinding* results) {
        const Real share = share_of(found), area = share * found.area;
        const Vector place = share * found.area_place, square = share * found.area_square, mixed = share * found.area_cross;
        for (std::size_t i = 0; i < kWidth<Real>; ++i) {
            results[i] = {pick(found.force, i), pick(found.moment, i), found.deepest[i], found.energy[i],        area[i],
                          pick(place, i),       pick(square, i),       pick(mixed, i),   found.irregular[i] != 0};
        }
    }
};

/// Up to kLanePairs pairs, as many at once as one register holds.
template <class W>
struct LanePairs {
    static constexpr std::size_t kStep = kWidth<typename W::Real>, kGroups = kLanePairs / kStep;
    using Overlaps = std::array<LaneOverlap<W>, kGroups>;

    /// Pairs whose memory is asked for while registers are busy, some at every stage of every group.
    struct Ahead {
        const LanePair *next, *end;
        std::size_t at_a_time;

        MUSIM_WIDE void ask() {
            for (std::size_t i = 0; i < at_a_time && next != end; ++i) (next++)->prefetch();
        }
    };

    template <class Meeting>
    MUSIM_WIDE static void find(const Meeting& meeting, std::size_t groups, Overlaps& found, Ahead ahead = {}) {
        std::array<Kernel<W>, kGroups> kernels;
        for (std::size_t g = 0; g < groups; ++g) {
            ahead.ask();
            kernels[g].gather([&](std::size_t i) MUSIM_WIDE_LAMBDA -> const BoxMeeting& { return meeting(g * kStep + i); });
        }
        for (std::size_t g = 0; g < groups; ++g) ahead.ask(), kernels[g].find_main_cells(found[g]);
        for (std::size_t g = 0; g < groups; ++g) ahead.ask(), kernels[g].add_rims(found[g]);
        for (std::size_t g = 0; g < groups; ++g) ahead.ask(), kernels[g].sum_up(found[g]);
    }
    MUSIM_WIDE static void compute(LanePair* pairs, std::size_t count, double dt, bool first_step, LaneOutput& nowhere,
                                   std::span<const LanePair> next) {
        constexpr std::size_t kStages = 4;
        const std::size_t groups = count / kStep;
        Overlaps found;
        find([pairs](std::size_t i) MUSIM_WIDE_LAMBDA -> const BoxMeeting& { return pairs[i].meeting; }, groups, found,
             {next.data(), next.data() + next.size(), kLanePairs / (kStages * groups)});
        for (std::size_t g = 0; g < groups; ++g) Lane<W>::compute(pairs + g * kStep, dt, first_step, found[g], nowhere);
    }
    MUSIM_WIDE static void find_overlaps(const BoxMeeting* pairs, std::size_t count, LaneFinding* findings) {
        Overlaps found;
        find([pairs](std::size_t i) MUSIM_WIDE_LAMBDA -> const BoxMeeting& { return pairs[i]; }, count / kStep, found);
        for (std::size_t g = 0; g < count / kStep; ++g) Lane<W>::store(found[g], findings + g * kStep);
    }
};

}  // namespace musim::lsdem::detail
