#pragma once

#include <array>
#include <cstddef>

#include "lsdem/detail/wide.hpp"

/// The mathematics of a contact of two bodies that overlap, for one pair or several side by side; see docs/theory/overlap_contact.md, "Area
/// and dashpots" and "Friction". World axes; what acts acts on the second body.
namespace musim::lsdem::detail {

/// Faces that face each other under a smaller cosine than this bear no friction and no dashpot [-]; above, in proportion. So the narrow
/// strips along the edges of a flat contact, which lie at right angles to what they are nearest to, have no part in it.
inline constexpr double kLeastFacing = 0.3;
/// Part that a face has in friction and dashpots which faces another under a cosine [-].
template <class Real>
MUSIM_WIDE Real share_of_facing(const Real& cosine) {
    return larger_of<Real>((cosine - kLeastFacing) * (1.0 / (1.0 - kLeastFacing)), Real{});
}

template <class W>
struct ContactStep {
    using Real = typename W::Real;
    using Mask = typename W::Mask;
    using Vector = Triple<Real>;

    MUSIM_WIDE static Real square_of(const Real& a) { return a * a; }
    MUSIM_WIDE static Real square_of(const Vector& a) { return dot(a, a); }

    /// A force at a point, with a couple [N, N·m].
    struct Wrench {
        Vector force, couple;
    };
    /// See FrictionSprings; `Value` a force or a couple.
    template <class Value>
    struct Springs {
        Real area{}, core{};
        Value in_core{}, in_rest{};

        MUSIM_WIDE Value total() const { return in_core + in_rest; }
        MUSIM_WIDE Real rest() const { return larger_of<Real>(area - core, Real{}); }
        /// Over another area. What is lost, of the rest first, keeps its slip; what is new joins the rest without any, so that the force
        /// stays. Neither gives energy. Of the rest the part `kept` stays apart from the core.
        MUSIM_WIDE void fit(const Real& now, const Real& kept) {
            const Real one = broadcast<Real>(1.0), rest_before = rest(), core_left = smaller_of<Real>(core, now);
            in_core = choose(core_left < core, core_left / core, one) * in_core;
            core = core_left, area = now;
            const Real rest_now = rest();
            in_rest = choose(rest_now < rest_before, rest_now / rest_before, one) * in_rest;
            const Real joins = one - kept;
            core += joins * rest_now;
            in_core = in_core + joins * in_rest;
            in_rest = kept * in_rest;
        }
        /// All of it slips alike.
        MUSIM_WIDE void slip(const Real& stiffness, const Value& by) {
            in_core = in_core - (stiffness * core) * by;
            in_rest = in_rest - (stiffness * rest()) * by;
        }
        /// The same by so much that the total becomes `value`.
        MUSIM_WIDE void set_total(const Value& value) {
            const Value change = value - total(), of_core = choose(area > Real{}, core / area, Real{}) * change;
            in_core = in_core + of_core;
            in_rest = in_rest + (change - of_core);
        }
        /// [J]
        MUSIM_WIDE Real energy(const Real& stiffness) const {
            const Real zero{}, of_core = stiffness * core, of_rest = stiffness * rest();
            return choose(of_core > zero, 0.5 * square_of(in_core) / of_core, zero) +
                   choose(of_rest > zero, 0.5 * square_of(in_rest) / of_rest, zero);
        }
        MUSIM_WIDE void keep_where(const Mask& mask) {
            in_core = choose(mask, in_core, Value{});
            in_rest = choose(mask, in_rest, Value{});
        }
    };
    /// See OverlapContact.
    struct Memory {
        Mask touches{};
        Springs<Vector> sliding;
        Springs<Real> turning;
        Real lightest{};
        Vector place, couple;
        Wrench dashpots;

        MUSIM_WIDE Wrench springs() const { return {sliding.total(), couple}; }
    };
    /// See Interface.
    struct Law {
        Real normal_stiffness, shear_stiffness, friction, normal_damping, shear_damping;
    };
    /// See OverlapGeometry.
    struct Geometry {
        Vector force, moment;         ///< for a stiffness per area of one [m³, m⁴]
        Real deepest{};               ///< [m]
        Real energy{};                ///< [m⁴]
        Real area{};                  ///< [m²]
        Vector arm;                   ///< of its middle from `pressed` [m]
        Vector square, cross_square;  ///< its second moments (xx, yy, zz) and (yz, zx, xy) about its middle [m⁴]

        MUSIM_WIDE Vector second_times(const Vector& v) const {
            return {(square.x * v.x + cross_square.z * v.y) + cross_square.y * v.z,
                    (cross_square.z * v.x + square.y * v.y) + cross_square.x * v.z,
                    (cross_square.y * v.x + cross_square.x * v.y) + square.z * v.z};
        }
    };
    /// Where two bodies are and were, about the origin of the pair.
    struct Motion {
        std::array<Vector, 2> center, previous_center;  ///< of mass now, and one step ago about the origin of that time [m]
        Vector shift;                                   ///< of the second centre against the first over the step [m]
        /// Turn of each body: T v = v + 2w (u×v) + 2u×(u×v), w cosine of half the angle, u the axis times its sine.
        struct Turn {
            Vector half;    ///< u
            Vector turned;  ///< 2w u, the axis times the sine of the angle

            MUSIM_WIDE static Turn of(const Vector& half, const Real& cosine) { return {half, (2.0 * cosine) * half}; }
            /// T v − v
            MUSIM_WIDE Vector change(const Vector& v) const { return cross(turned, v) + cross(half + half, cross(half, v)); }
            /// v − T⁻¹ v
            MUSIM_WIDE Vector change_of_turned(const Vector& v) const { return cross(turned, v) - cross(half + half, cross(half, v)); }
        };
        std::array<Turn, 2> turn;

        MUSIM_WIDE Vector displacement(const Vector& x) const {
            return shift + (turn[1].change_of_turned(x - center[1]) - turn[0].change_of_turned(x - center[0]));
        }
        MUSIM_WIDE Vector displacement_of_previous(const Vector& x) const {
            return shift + (turn[1].change(x - previous_center[1]) - turn[0].change(x - previous_center[0]));
        }
    };
    /// A pressure that is affine over the area: at + slope·(x − about) [Pa], and what it comes to.
    struct Pressure {
        Real at;
        Vector slope, about;
    };
    struct PressureSum {
        Real sum{};
        Vector at{};
    };
    /// Outcome of a step of a contact.
    struct Result {
        Vector force{}, moment{};                ///< on the second body; about the origin of the pair [N, N·m]
        Real elastic_normal{}, elastic_shear{};  ///< stored now, the first but for a part overlap/size of it [J]
        Real friction_work{}, damping_work{};    ///< dissipated over the step [J]
        Mask may_slide{};                        ///< friction is beyond the limit with the least reach
        Mask may_pull{};                         ///< dashpots may pull somewhere, or act before a point touches
        Mask may_both{};                         ///< they may do both
    };

    /// Friction of a contact: a force across the normal, and a couple about the normal.
    struct Friction {
        Vector force;
        Real couple;
    };
    /// The limit of friction as a whole: |f|² + (m/r̄)² ≤ (μN)², m about where the pressure acts [GoyalRuinaPapadopoulos91].
    struct Limit {
        Real force, reach;
        Vector arm;  ///< of the friction's force from where the pressure acts [m]
        Vector normal;

        MUSIM_WIDE Real about_pressure(const Friction& friction) const { return friction.couple + dot(normal, cross(arm, friction.force)); }
        /// Excess beyond the limit, 0 on it, in squares of it.
        MUSIM_WIDE Real excess(const Friction& friction) const {
            const Real turning = about_pressure(friction) / reach;
            return (dot(friction.force, friction.force) + turning * turning) / (force * force) - 1.0;
        }
        /// Back to the limit: first along the slip that it goes with, which is normal to the limit, then in proportion. The first makes the
        /// slip of a steady slide what the bodies do, the second makes the limit hold. For what lies beyond.
        MUSIM_WIDE void hold(const Real& beyond, const Real& stiffness, const Real& turning_stiffness, Friction& friction) const {
            const Real over = 1.0 / (force * force), turn = about_pressure(friction) * (over / (reach * reach));
            const Vector slip = over * friction.force, change = -stiffness * (slip + turn * cross(normal, arm));
            const Real couple_change = -turning_stiffness * turn;
            const Real slope = 2.0 * (dot(slip, change) + turn * (couple_change + dot(normal, cross(arm, change))));
            const Real part = choose(slope < Real{}, beyond / -slope, Real{});
            friction.force = friction.force + part * change;
            friction.couple += part * couple_change;
            const Real scale = 1.0 / square_root(1.0 + larger_of<Real>(excess(friction), Real{}));
            friction.force = scale * friction.force;
            friction.couple *= scale;
        }
    };

    /// A load that grows by more than this factor over its least forgets, in proportion, which part of the area bore it [-]. A choice: more
    /// than the load of a joint that rocks is expected to vary by, far less than a rebound, whose load goes through zero.
    static constexpr double kForgottenGrowth = 8.0;

    /// Turns a vector with the mean turn of both bodies over the step, without changing its length.
    MUSIM_WIDE static Vector carried(const Vector& v, const Motion& motion) {
        const Vector half = broadcast<Real>(0.25) * (motion.turn[0].turned + motion.turn[1].turned), across = cross(half, v);
        return v + (2.0 / (1.0 + dot(half, half))) * (across + cross(half, across));
    }
    MUSIM_WIDE static Vector across(const Vector& normal, const Vector& v) { return v - dot(normal, v) * normal; }

    /// `Cells`: what is known of the area beyond its moments.
    ///   Mask may_pull(geometry, pressure, stiffness): false only where stiffness · d + pressure is surely negative nowhere
    ///   PressureSum find_pull(pressure, stiffness), Real find_reach(normal, pressed): see contact_area.hpp
    ///   Real least_reach(normal, geometry): no more than find_reach, asked before it, and fast; decides only whether it is asked
    template <class Cells>
    MUSIM_WIDE static Result compute(const Geometry& geometry, const Motion& motion, const Law& law, double dt, bool first_step,
                                     const Real& stored_shear, Cells& cells, Memory& contact) {
        const Real zero{}, one = broadcast<Real>(1.0);
        const Memory before = contact;
        Result result;
        Vector slipped{};
        const Real squared = dot(geometry.force, geometry.force);
        const Mask touches = squared > zero;
        if (some(touches)) {
            const Real size = square_root(squared), inverse = choose(touches, 1.0 / size, zero);
            const Vector normal = inverse * geometry.force, pressed = (inverse * inverse) * cross(geometry.force, geometry.moment);
            const Real push = law.normal_stiffness * size, area = geometry.area;
            const Real polar = larger_of<Real>(
                ((geometry.square.x + geometry.square.y) + geometry.square.z) - dot(normal, geometry.second_times(normal)), zero);
            contact.touches = touches;
            contact.place = pressed + geometry.arm;

            // dashpots: C ḋ everywhere, less where that would pull more than the springs push, and less where a point has touched for a
            // part of the step only: d of the way ḋ dt
            slipped = motion.displacement(contact.place);
            const Real per_depth = law.normal_damping * (1.0 / dt);
            const Pressure dashpot{-per_depth * dot(normal, slipped),
                                   -per_depth * (motion.turn[0].change(normal) - motion.turn[1].change(normal)), contact.place};
            const Pressure opposite{-dashpot.at, -dashpot.slope, dashpot.about};
            const Mask pulls = touches & cells.may_pull(geometry, dashpot, law.normal_stiffness);
            const Mask closes = touches & cells.may_pull(geometry, opposite, per_depth);
            result.may_pull = pulls | closes, result.may_both = pulls & closes;
            PressureSum held;
            // most contacts do one of both, at the first pass; one that opens at a side and closes at another needs a second
            for (std::size_t pass = 0; pass < 2; ++pass) {
                const Mask now = pass == 0 ? result.may_pull : result.may_both, early = pass == 0 ? now ^ pulls : now;
                if (!some(now)) break;
                const PressureSum part =
                    cells.find_pull({choose(early, opposite.at, dashpot.at), choose(early, opposite.slope, dashpot.slope), dashpot.about},
                                    choose(early, per_depth, law.normal_stiffness));
                held.sum += choose(now, choose(early, -part.sum, part.sum), zero);
                held.at = held.at + choose(now, choose(early, -part.at, part.at), Vector{});
            }
            const Real damping = dashpot.at * area + held.sum;
            const Wrench damped{damping * normal, cross(geometry.second_times(dashpot.slope) + held.at, normal)};

            // springs of friction
            Springs<Vector>& sliding = contact.sliding;
            sliding.in_core = across(normal, carried(sliding.in_core, motion));
            sliding.in_rest = across(normal, carried(sliding.in_rest, motion));
            const Real least = (1.0 / kForgottenGrowth) * push;
            const Real kept = smaller_of<Real>(contact.lightest / least, one);
            contact.lightest = larger_of<Real>(smaller_of<Real>(contact.lightest, push), least);
            sliding.fit(area, kept);
            contact.turning.fit(polar, kept);
            const Real stiffness = law.shear_stiffness * area, turning_stiffness = law.shear_stiffness * polar;
            // of a first touch, the part of the step that came after it
            Real slip_part = first_step ? zero : one;
            const Mask begins = touches & (touches ^ before.touches);
            if (some(begins)) {
                const Real sunk = -dot(normal, motion.displacement(pressed));
                slip_part = choose(begins & (sunk > geometry.deepest), slip_part * (geometry.deepest / sunk), slip_part);
            }
            const Vector slip = slip_part * across(normal, slipped);
            const Real turn = slip_part * dot(normal, motion.turn[1].turned - motion.turn[0].turned);
            const Real viscous = choose(law.shear_stiffness > zero, law.shear_damping / (law.shear_stiffness * dt), zero);
            sliding.slip(law.shear_stiffness, slip);
            contact.turning.slip(law.shear_stiffness, turn);
            Friction springs{sliding.total(), contact.turning.total()};
            Friction drag{(-viscous * stiffness) * slip, (-viscous * turning_stiffness) * turn};
            Friction friction{springs.force + drag.force, springs.couple + drag.couple};
            Mask holds{};
            result.may_slide = hold_friction(geometry, law, normal, pressed, push + damping, polar, cells, springs, drag, friction, holds);
            sliding.set_total(springs.force);
            contact.turning.set_total(springs.couple);
            // what nothing presses keeps no slip
            sliding.keep_where(holds);
            contact.turning.keep_where(holds);
            contact.couple = springs.couple * normal;
            contact.dashpots = {damped.force + drag.force, damped.couple + drag.couple * normal};
            result.elastic_shear = sliding.energy(law.shear_stiffness) + contact.turning.energy(law.shear_stiffness);

            const Vector at_middle = damped.force + friction.force;
            result.force = law.normal_stiffness * geometry.force + at_middle;
            result.moment =
                law.normal_stiffness * geometry.moment + cross(contact.place, at_middle) + (damped.couple + friction.couple * normal);
            result.elastic_normal = law.normal_stiffness * geometry.energy;
        }
        if (!every(touches)) keep_where(touches, contact, result);
        add_losses(before, contact, motion, slipped, stored_shear, result);
        return result;
    }

  private:
    /// Friction within its limit, nothing but where it `holds`; `springs` and `drag` are its parts. Where the cells had to be asked for the
    /// reach.
    template <class Cells>
    MUSIM_WIDE static Mask hold_friction(const Geometry& geometry, const Law& law, const Vector& normal, const Vector& pressed,
                                         const Real& pressing, const Real& polar, Cells& cells, Friction& springs, Friction& drag,
                                         Friction& friction, Mask& holds) {
        const Real zero{};
        Limit limit{law.friction * larger_of<Real>(pressing, zero), zero, across(normal, geometry.arm), normal};
        const Mask bears = (limit.force > zero) & (polar > zero);
        limit.reach = choose(bears, cells.least_reach(normal, geometry), zero);
        const Mask may_slide = bears & (limit.excess(friction) > zero);
        if (some(may_slide)) {
            limit.reach = choose(may_slide, cells.find_reach(normal, pressed), limit.reach);
            const Real beyond = limit.excess(friction);
            const Mask slides = may_slide & (limit.reach > zero) & (beyond > zero);
            if (some(slides)) {
                Friction held = friction;
                limit.hold(beyond, law.shear_stiffness * geometry.area, law.shear_stiffness * polar, held);
                // dashpots give up their share, in proportion
                const Real left = 1.0 / square_root(1.0 + beyond);
                friction = {choose(slides, held.force, friction.force), choose(slides, held.couple, friction.couple)};
                drag = {choose(slides, left * drag.force, drag.force), choose(slides, left * drag.couple, drag.couple)};
                springs = {choose(slides, held.force - drag.force, springs.force),
                           choose(slides, held.couple - drag.couple, springs.couple)};
            }
        }
        holds = bears & (limit.reach > zero);
        for (Friction* const part : {&springs, &drag, &friction}) {
            part->force = choose(holds, part->force, Vector{});
            part->couple = choose(holds, part->couple, zero);
        }
        return may_slide;
    }
    /// Nothing elsewhere.
    MUSIM_WIDE static void keep_where(const Mask& touches, Memory& contact, Result& result) {
        const auto keep = [&](auto& value)
                              MUSIM_WIDE_LAMBDA { value = choose(touches, value, std::remove_reference_t<decltype(value)>{}); };
        contact.touches = touches;
        const auto keep_springs = [&](auto& s) MUSIM_WIDE_LAMBDA { keep(s.area), keep(s.core), keep(s.in_core), keep(s.in_rest); };
        keep_springs(contact.sliding), keep_springs(contact.turning), keep(contact.lightest), keep(contact.place);
        keep(contact.couple), keep(contact.dashpots.force), keep(contact.dashpots.couple);
        keep(result.force), keep(result.moment), keep(result.elastic_normal), keep(result.elastic_shear);
    }
    /// Losses of a step, over which forces work with the mean of their values at both ends. `moved`: of the middle of the area now.
    MUSIM_WIDE static void add_losses(const Memory& before, const Memory& contact, const Motion& motion, const Vector& moved,
                                      const Real& stored_shear, Result& result) {
        const Vector turned = motion.turn[1].turned - motion.turn[0].turned;
        const Vector moved_before = motion.displacement_of_previous(before.place);
        const auto loss = [&](const Wrench& last, const Wrench& now) MUSIM_WIDE_LAMBDA {
            return -0.5 * ((dot(last.force, moved_before) + dot(now.force, moved)) + dot(last.couple + now.couple, turned));
        };
        result.damping_work = loss(before.dashpots, contact.dashpots);
        result.friction_work = loss(before.springs(), contact.springs()) - (result.elastic_shear - stored_shear);
    }
};

}  // namespace musim::lsdem::detail
