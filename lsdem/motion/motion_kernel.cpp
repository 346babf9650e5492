#include "lsdem/motion/motion_kernel.hpp"

#include <algorithm>
#include <array>
#include <limits>

#include "lsdem/detail/free_rotation.hpp"
#include "lsdem/detail/instructions.hpp"
#include "lsdem/detail/lanes.hpp"

namespace musim::lsdem::detail {

void TouchList::rebuild(std::size_t blocks, const std::vector<ContactPair>& pairs) {
    begin_.assign(blocks + 1, 0);
    for (const ContactPair& pair : pairs) {
        ++begin_[pair.leader + 1];
        if (pair.follower != kGround) ++begin_[pair.follower + 1];
    }
    for (std::size_t i = 0; i < blocks; ++i) begin_[i + 1] += begin_[i];
    touches_.resize(begin_.back());
    std::vector<std::size_t> next(begin_.begin(), begin_.end() - 1);
    for (std::uint32_t p = 0; p < pairs.size(); ++p) {
        touches_[next[pairs[p].leader]++] = {p, true};
        if (pairs[p].follower != kGround) touches_[next[pairs[p].follower]++] = {p, false};
    }
}

namespace {

/// Four blocks; past the end of a range the last one is repeated.
using Four = std::array<std::size_t, kLanes>;

[[gnu::always_inline]] inline Lanes pick(const std::vector<double>& from, const Four& i) {
    return Lanes{from[i[0]], from[i[1]], from[i[2]], from[i[3]]};
}

[[gnu::always_inline]] inline Triple<Lanes> pick(const std::array<const double*, kLanes>& from) {
    const double *a = from[0], *b = from[1], *c = from[2], *d = from[3];
    return {Lanes{a[0], b[0], c[0], d[0]}, Lanes{a[1], b[1], c[1], d[1]}, Lanes{a[2], b[2], c[2], d[2]}};
}

[[gnu::always_inline]] inline Triple<Lanes> pick(const std::vector<Vector3>& from, const Four& i) {
    return pick({from[i[0]].data(), from[i[1]].data(), from[i[2]].data(), from[i[3]].data()});
}

[[gnu::always_inline]] inline Orientation<Lanes> pick(const std::vector<Quaternion>& from, const Four& i) {
    const double *a = from[i[0]].coeffs().data(), *b = from[i[1]].coeffs().data(), *c = from[i[2]].coeffs().data(),
                 *d = from[i[3]].coeffs().data();
    return {Lanes{a[3], b[3], c[3], d[3]}, Lanes{a[0], b[0], c[0], d[0]}, Lanes{a[1], b[1], c[1], d[1]}, Lanes{a[2], b[2], c[2], d[2]}};
}

[[gnu::always_inline]] inline void put(const Triple<Lanes>& v, std::size_t lane, double* to) {
    to[0] = v.x[lane];
    to[1] = v.y[lane];
    to[2] = v.z[lane];
}

[[gnu::always_inline]] inline void put(const Orientation<Lanes>& q, std::size_t lane, Quaternion& to) {
    double* const coefficients = to.coeffs().data();
    coefficients[0] = q.x[lane], coefficients[1] = q.y[lane], coefficients[2] = q.z[lane], coefficients[3] = q.w[lane];
}

[[gnu::always_inline]] inline Triple<Lanes> pick_position(const std::vector<BodyPose>& from, const Four& i) {
    return pick({from[i[0]].position.data(), from[i[1]].position.data(), from[i[2]].position.data(), from[i[3]].position.data()});
}

[[gnu::always_inline]] inline Lanes pick_travel(const std::vector<BodyPose>& from, const Four& i) {
    return Lanes{from[i[0]].step.travel, from[i[1]].step.travel, from[i[2]].step.travel, from[i[3]].step.travel};
}

/// The same vector in all lanes.
[[gnu::always_inline]] inline Triple<Lanes> spread(const Vector3& v) {
    return {broadcast<Lanes>(v.x()), broadcast<Lanes>(v.y()), broadcast<Lanes>(v.z())};
}

/// |a − b|²
[[gnu::always_inline]] inline Lanes square_of_difference(const Orientation<Lanes>& a, const Orientation<Lanes>& b) {
    const Lanes w = a.w - b.w, x = a.x - b.x, y = a.y - b.y, z = a.z - b.z;
    return (w * w + x * x) + (y * y + z * z);
}

/// More than the rounding of a sum: a travel that many small ways make does not fall behind them.
constexpr double kUpward = 1.0 + 2.0 * std::numeric_limits<double>::epsilon();

/// So many blocks before its turn the forces on a block are asked for. Affects speed only.
constexpr std::size_t kAhead = 2 * kLanes;

/// The rotation matrix of a lane, column by column.
[[gnu::always_inline]] inline void put(const RotationRows<Lanes>& rows, std::size_t lane, double* r) {
    r[0] = rows.x.x[lane], r[1] = rows.y.x[lane], r[2] = rows.z.x[lane];
    r[3] = rows.x.y[lane], r[4] = rows.y.y[lane], r[5] = rows.z.y[lane];
    r[6] = rows.x.z[lane], r[7] = rows.y.z[lane], r[8] = rows.z.z[lane];
}

/// One step of the blocks of a share; how far the farthest drifted from where its neighbors were searched [m], infinite for one that is
/// lost.
template <bool prepares>
[[gnu::always_inline]] inline double move_range(const Leap& leap, const Share& share, Bodies& bodies) {
    const NeighborSearch::Reference& reference = leap.reference;
    const Triple<Lanes> base = spread(leap.base_displacement), base_step = spread(leap.base_step), gravity = spread(leap.gravity);
    const double push = leap.decay.push;
    const Lanes zero = broadcast<Lanes>(0.0), h = broadcast<Lanes>(leap.h), keep = broadcast<Lanes>(leap.decay.keep);
    Lanes farthest = zero;
    LaneMask lost{};
    for (std::size_t begin = share.first, last = share.last; begin < last; begin += kLanes) {
        Four i{};
        std::array<TouchList::Load, kLanes> load;
        std::array<const double*, kLanes> force_at{}, torque_at{};
        for (std::size_t lane = 0; lane < kLanes; ++lane) {
            i[lane] = std::min(begin + lane, last - 1);
            if (begin + lane + kAhead < last) leap.touches.prefetch(begin + lane + kAhead, leap.forces);
            load[lane] = leap.touches.sum(i[lane], leap.forces);
            force_at[lane] = load[lane].force.data();
            torque_at[lane] = load[lane].torque.data();
        }
        const Triple<Lanes> force = pick(force_at), torque = pick(torque_at);
        const Lanes free = pick(bodies.free, i), kick = push * free, per_mass = pick(bodies.inverse_mass, i);
        Triple<Lanes> v = pick(bodies.velocity, i), x = pick_position(bodies.pose, i), l = pick(bodies.momentum, i);
        const Triple<Lanes> v_before = v, x_before = x, l_before = l;
        const Triple<Lanes> acceleration = per_mass * force + gravity;
        if (prepares) v = keep * v;
        v = v + kick * acceleration;
        x = x + h * v;

        const Triple<Lanes> inverse_inertia = pick(bodies.inverse_inertia, i);
        const LaneMask turns = inverse_inertia.x > zero;
        const Lanes twist = choose(turns, kick, zero);
        if (prepares) l = keep * l;
        l = l + twist * torque;
        const Orientation<Lanes> before = pick(bodies.orientation, i);
        const RotationRows<Lanes> rows_before(before);
        const Triple<Lanes> l_body = rows_before.to_body(l);
        const auto root_of = [](const Lanes& value) MUSIM_INLINE_LAMBDA { return square_root(value); };
        const Orientation<Lanes> free_q = turn_freely(before, l_body, inverse_inertia, leap.h, root_of);
        Lanes loss = zero;
        if (prepares) {
            // the impulse of the damping, and of mass scaling, times the mean of the velocities before and after it
            const Lanes whole = choose(free > zero, h, zero), whole_turn = choose(turns, whole, zero);
            const Triple<Lanes> impulse = (v - v_before) - whole * acceleration;
            const Triple<Lanes> twist_impulse = rows_before.to_body((l - l_before) - whole_turn * torque);
            const Triple<Lanes> l_sum = rows_before.to_body(l_before) + l_body;
            const Triple<Lanes> spin_sum{inverse_inertia.x * l_sum.x, inverse_inertia.y * l_sum.y, inverse_inertia.z * l_sum.z};
            loss =
                pick(bodies.preparation_loss, i) - 0.5 * (pick(bodies.mass, i) * dot(impulse, v_before + v) + dot(twist_impulse, spin_sum));
        }
        const Orientation<Lanes> q{choose(turns, free_q.w, before.w), choose(turns, free_q.x, before.x), choose(turns, free_q.y, before.y),
                                   choose(turns, free_q.z, before.z)};
        const RotationRows<Lanes> rows(q);

        const Triple<Lanes> moved = h * v - base_step;
        const Lanes diameter = pick(reference.diameter, i);
        const Lanes way = square_root(dot(moved, moved)) + diameter * square_root(square_of_difference(q, before));
        const Lanes travel = kUpward * (pick_travel(bodies.pose, i) + way);
        const Triple<Lanes> shift = x - x_before;
        const Orientation<Lanes> turn = q.after(before);

        const Triple<Lanes> away = (x - base) - pick(reference.position, i);
        const Lanes turned_away = square_of_difference(q, pick(reference.orientation, i));
        const Lanes drift = square_root(dot(away, away)) + diameter * square_root(turned_away);
        farthest = larger_of<Lanes>(farthest, drift);
        lost |= drift != drift;

        for (std::size_t lane = 0; lane < kLanes && begin + lane < last; ++lane) {
            const std::size_t block = i[lane];
            put(v, lane, bodies.velocity[block].data());
            put(l, lane, bodies.momentum[block].data());
            BodyPose& pose = bodies.pose[block];
            put(x, lane, pose.position.data());
            put(rows, lane, pose.rotation.data());
            put(turn, lane, pose.step.turn);
            put(shift, lane, pose.step.shift.data());
            pose.step.travel = travel[lane];
            if (prepares) bodies.preparation_loss[block] = loss[lane];
            put(q, lane, bodies.orientation[block]);
        }
    }
    return some(lost) ? std::numeric_limits<double>::infinity() : largest(farthest);
}

/// With or without what prepares, so that a run without pays nothing for it.
[[gnu::always_inline]] inline double move_either(const Leap& leap, const Share& share, Bodies& bodies) {
    return leap.prepares ? move_range<true>(leap, share, bodies) : move_range<false>(leap, share, bodies);
}

MUSIM_AVX2 double move_wide(const Leap& leap, const Share& share, Bodies& bodies) { return move_either(leap, share, bodies); }

double move_plain(const Leap& leap, const Share& share, Bodies& bodies) { return move_either(leap, share, bodies); }

}  // namespace

double move_blocks(const Leap& leap, const Share& share, Bodies& bodies) {
    return (active_instructions() >= Instructions::avx2 ? move_wide : move_plain)(leap, share, bodies);
}

}  // namespace musim::lsdem::detail
