#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>

#include "lsdem/detail/free_rotation.hpp"
#include "lsdem/motion/motion_kernel.hpp"

/// Motion of motion_kernel.hpp, for any number of lanes.
namespace musim::lsdem::detail {

template <class W>
struct BlockLanes {
    using Real = typename W::Real;
    using Mask = typename W::Mask;
    using Vector = Triple<Real>;
    using Turn = Orientation<Real>;
    static constexpr std::size_t kCount = kWidth<Real>;
    /// So many blocks side by side; past the end of a range the last one is repeated.
    using Indices = std::array<std::size_t, kCount>;

    /// So many blocks before its turn the forces on a block are asked for. Affects speed only.
    static constexpr std::size_t kAhead = 16;
    /// More than the rounding of a sum: a travel that many small ways make does not fall behind them.
    static constexpr double kUpward = 1.0 + 2.0 * std::numeric_limits<double>::epsilon();

    MUSIM_WIDE static Real pick(const std::vector<double>& from, const Indices& i) {
        return gather_lanes<Real>([&](std::size_t lane) MUSIM_WIDE_LAMBDA { return from[i[lane]]; });
    }
    MUSIM_WIDE static Vector pick(const std::vector<Vector3>& from, const Indices& i) {
        const auto v = gather_fields<Real, 3>([&](std::size_t lane) MUSIM_WIDE_LAMBDA { return from[i[lane]].data(); });
        return {v[0], v[1], v[2]};
    }
    MUSIM_WIDE static Turn pick(const std::vector<Quaternion>& from, const Indices& i) {
        const auto q = gather_fields<Real, 4>([&](std::size_t lane) MUSIM_WIDE_LAMBDA { return from[i[lane]].coeffs().data(); });
        return {q[3], q[0], q[1], q[2]};
    }
    MUSIM_WIDE static void put(const Vector& v, std::vector<Vector3>& to, const Indices& i) {
        scatter_fields<Real, 3>({v.x, v.y, v.z}, [&](std::size_t lane) MUSIM_WIDE_LAMBDA { return to[i[lane]].data(); });
    }
    /// The same vector in all lanes.
    MUSIM_WIDE static Vector spread(const Vector3& v) { return {broadcast<Real>(v.x()), broadcast<Real>(v.y()), broadcast<Real>(v.z())}; }
    /// |a − b|²
    MUSIM_WIDE static Real square_of_difference(const Turn& a, const Turn& b) {
        const Real w = a.w - b.w, x = a.x - b.x, y = a.y - b.y, z = a.z - b.z;
        return (w * w + x * x) + (y * y + z * z);
    }

    MUSIM_WIDE static Turn spread(const Quaternion& q) {
        return {broadcast<Real>(q.w()), broadcast<Real>(q.x()), broadcast<Real>(q.y()), broadcast<Real>(q.z())};
    }
    /// The turn b, then a.
    MUSIM_WIDE static Turn product(const Turn& a, const Turn& b) {
        return {((a.w * b.w - a.x * b.x) - a.y * b.y) - a.z * b.z, ((a.w * b.x + a.x * b.w) + a.y * b.z) - a.z * b.y,
                ((a.w * b.y + a.y * b.w) + a.z * b.x) - a.x * b.z, ((a.w * b.z + a.z * b.w) + a.x * b.y) - a.y * b.x};
    }
    /// The ground after the step, and its step.
    struct Ground {
        Vector position, shift, before;
        Turn orientation, turn;
        RotationRows<Real> rows;

        MUSIM_WIDE explicit Ground(const Bodies& bodies)
            : position(spread(bodies.pose.back().position)),
              shift(spread(bodies.pose.back().step.shift)),
              before(position - shift),
              orientation(spread(bodies.orientation.back())),
              turn(spread(bodies.pose.back().step.turn)),
              rows(orientation) {}
        /// Displacement over the step, beyond its shift, of the point that was at `x` before it.
        MUSIM_WIDE Vector change(const Vector& x) const {
            const Vector arm = x - before, half{turn.x, turn.y, turn.z}, across = cross(half, arm);
            const Vector sum = turn.w * across + cross(half, across);
            return sum + sum;
        }
    };

    /// One step of the blocks of a share; how far the farthest drifted from where its neighbors were searched [m], infinite for one that is
    /// lost.
    template <bool prepares>
    MUSIM_WIDE static double move(const Leap& leap, const Share& share, Bodies& bodies) {
        const NeighborSearch::Reference& reference = leap.reference;
        const Ground ground(bodies);
        const Vector gravity = spread(leap.gravity);
        const double push = leap.decay.push;
        const Real zero{}, h = broadcast<Real>(leap.h), kick_time = broadcast<Real>(leap.kick), keep = broadcast<Real>(leap.decay.keep);
        Real farthest = zero;
        Mask lost{};
        for (std::size_t begin = share.first, last = share.last; begin < last; begin += kCount) {
            Indices i{};
            std::array<TouchList::Load, kCount> load;
            for (std::size_t lane = 0; lane < kCount; ++lane) {
                i[lane] = std::min(begin + lane, last - 1);
                if (begin + lane + kAhead < last) leap.touches.prefetch(begin + lane + kAhead, leap.forces);
                load[lane] = leap.touches.sum(i[lane], leap.forces);
            }
            static_assert(sizeof(TouchList::Load) == 6 * sizeof(double));
            const auto f = gather_fields<Real, 6>([&](std::size_t lane) MUSIM_WIDE_LAMBDA { return load[lane].force.data(); });
            const Vector force{f[0], f[1], f[2]}, torque{f[3], f[4], f[5]};
            const auto place =
                gather_fields<Real, 3>([&](std::size_t lane) MUSIM_WIDE_LAMBDA { return bodies.pose[i[lane]].position.data(); });
            const Real free = pick(bodies.free, i), kick = push * free, per_mass = pick(bodies.inverse_mass, i);
            Vector v = pick(bodies.velocity, i), x{place[0], place[1], place[2]}, l = pick(bodies.momentum, i);
            const Vector v_before = v, x_before = x, l_before = l;
            const Vector acceleration = per_mass * force + gravity;
            if (prepares) v = keep * v;
            v = v + kick * acceleration;
            x = x + h * v;

            const Vector inverse_inertia = pick(bodies.inverse_inertia, i);
            const Mask turns = inverse_inertia.x > zero;
            const Real twist = choose(turns, kick, zero);
            if (prepares) l = keep * l;
            l = l + twist * torque;
            const Turn before = pick(bodies.orientation, i);
            const RotationRows<Real> rows_before(before);
            const Vector l_body = rows_before.to_body(l);
            const Turn free_q = turn_freely(before, l_body, inverse_inertia, leap.h);
            if (prepares) {
                // the impulse of the damping, and of mass scaling, times the mean of the velocities before and after it
                const Real whole = choose(free > zero, kick_time, zero), whole_turn = choose(turns, whole, zero);
                const Vector impulse = (v - v_before) - whole * acceleration;
                const Vector twist_impulse = rows_before.to_body((l - l_before) - whole_turn * torque);
                const Vector l_sum = rows_before.to_body(l_before) + l_body;
                const Vector spin_sum{inverse_inertia.x * l_sum.x, inverse_inertia.y * l_sum.y, inverse_inertia.z * l_sum.z};
                const Real loss = pick(bodies.preparation_loss, i) -
                                  0.5 * (pick(bodies.mass, i) * dot(impulse, v_before + v) + dot(twist_impulse, spin_sum));
                for (std::size_t lane = 0; lane < kCount; ++lane) bodies.preparation_loss[i[lane]] = lane_of(loss, lane);
            }
            const Turn q{choose(turns, free_q.w, before.w), choose(turns, free_q.x, before.x), choose(turns, free_q.y, before.y),
                         choose(turns, free_q.z, before.z)};
            const RotationRows<Real> rows(q);

            Vector moved = h * v - ground.shift;
            Turn held = before;  // as the block would lie had it turned with the ground
            if (leap.is_turned) moved = moved - ground.change(x_before), held = product(ground.turn, before);
            const Real diameter = pick(reference.diameter, i);
            const Real way = square_root(dot(moved, moved)) + diameter * square_root(square_of_difference(q, held));
            const Real way_before =
                gather_lanes<Real>([&](std::size_t lane) MUSIM_WIDE_LAMBDA { return bodies.pose[i[lane]].step.travel; });
            const Real travel = kUpward * (way_before + way);
            const Vector shift = x - x_before;
            const Turn turn = q.after(before);

            Vector place_on_ground = x - ground.position;
            Turn turn_on_ground = q;
            if (leap.is_turned) {
                place_on_ground = ground.rows.to_body(place_on_ground);
                turn_on_ground = product({ground.orientation.w, -ground.orientation.x, -ground.orientation.y, -ground.orientation.z}, q);
            }
            const Vector away = place_on_ground - pick(reference.position, i);
            const Real turned_away = square_of_difference(turn_on_ground, pick(reference.orientation, i));
            const Real drift = square_root(dot(away, away)) + diameter * square_root(turned_away);
            farthest = larger_of<Real>(farthest, drift);
            lost |= ~(drift <= drift);

            put(v, bodies.velocity, i);
            put(l, bodies.momentum, i);
            scatter_fields<Real, 4>({q.x, q.y, q.z, q.w},
                                    [&](std::size_t lane) MUSIM_WIDE_LAMBDA { return bodies.orientation[i[lane]].coeffs().data(); });
            static_assert(offsetof(BodyPose, position) == 9 * sizeof(double) && sizeof(BodyStep) == 8 * sizeof(double));
            scatter_fields<Real, 12>(
                {rows.x.x, rows.y.x, rows.z.x, rows.x.y, rows.y.y, rows.z.y, rows.x.z, rows.y.z, rows.z.z, x.x, x.y, x.z},
                [&](std::size_t lane) MUSIM_WIDE_LAMBDA { return bodies.pose[i[lane]].rotation.data(); });
            scatter_fields<Real, 8>({turn.x, turn.y, turn.z, turn.w, shift.x, shift.y, shift.z, travel},
                                    [&](std::size_t lane) MUSIM_WIDE_LAMBDA { return bodies.pose[i[lane]].step.turn.coeffs().data(); });
        }
        double most = 0.0;
        for (std::size_t lane = 0; lane < kCount; ++lane) most = std::max(most, lane_of(farthest, lane));
        return some(lost) ? std::numeric_limits<double>::infinity() : most;
    }

    /// With or without what prepares, so that a run without pays nothing for it.
    MUSIM_WIDE static double move(const Leap& leap, const Share& share, Bodies& bodies) {
        return leap.prepares ? move<true>(leap, share, bodies) : move<false>(leap, share, bodies);
    }
};

}  // namespace musim::lsdem::detail
