#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>

#include "lsdem/detail/contact_kernel.hpp"
#include "lsdem/detail/patch_geometry.hpp"

/// The nodes of one patch, four at a time, and what they add up to. All loops over nodes are here.
namespace musim::lsdem::detail {

/// Sums over the nodes of four patches: Σ A w f (1, s, t).
struct PatchSums {
    Affine pressure;          ///< [N]
    Affine shear_u, shear_v;  ///< [N]
    Affine dashpot;           ///< the part of the normal dashpot [N]
    Affine drag_u, drag_v;    ///< the part of the tangential dashpot [N]
    Lanes elastic_normal, elastic_shear, friction, overlap, touching;

    [[gnu::always_inline]] void set_nothing(std::size_t lane) {
        for (Affine* a : {&pressure, &shear_u, &shear_v, &dashpot, &drag_u, &drag_v}) a->at[lane] = a->s[lane] = a->t[lane] = 0.0;
        for (Lanes* a : {&elastic_normal, &elastic_shear, &friction, &overlap, &touching}) (*a)[lane] = 0.0;
    }
};

/// Σ w f (1, s, t) over the nodes of one patch, still in four lanes.
struct NodeSums {
    Lanes at{}, s{}, t{};
    [[gnu::always_inline]] void add(const Lanes& value, const Lanes& w, const Lanes& ws, const Lanes& wt) {
        at += w * value;
        s += ws * value;
        t += wt * value;
    }
    [[gnu::always_inline]] void finish(double factor, std::size_t lane, Affine& into) const {
        into.at[lane] = factor * sum(at);
        into.s[lane] = factor * sum(s);
        into.t[lane] = factor * sum(t);
    }
};

[[gnu::always_inline]] inline double largest(const Lanes& v) { return std::max(std::max(v[0], v[1]), std::max(v[2], v[3])); }
[[gnu::always_inline]] inline double smallest(const Lanes& v) { return std::min(std::min(v[0], v[1]), std::min(v[2], v[3])); }

/// What the nodes of pressed patches slip, patch by patch, before the lanes of each are folded.
struct PressedSums {
    std::array<NodeSums, kWidth> u{}, v{};
    std::array<Lanes, kWidth> squares{};
    LaneMask slid{};

    /// Four patches side by side: Σ wξ(1, s, t) along u or v.
    [[gnu::always_inline]] static Affine fold(const std::array<NodeSums, kWidth>& m) {
        return {sums(m[0].at, m[1].at, m[2].at, m[3].at), sums(m[0].s, m[1].s, m[2].s, m[3].s), sums(m[0].t, m[1].t, m[2].t, m[3].t)};
    }
    [[gnu::always_inline]] Lanes fold_squares() const { return sums(squares[0], squares[1], squares[2], squares[3]); }
};

/// The nodes of four patches that touch, as sums over them and as the box on the lattice that holds them.
struct TouchingNodes {
    Lanes w, ws, wt, wss, wst, wtt;              ///< Σ w (1, s, t, s², st, t²)
    Lanes box_s, box_t, box_half_s, box_half_t;  ///< middle and half extents

    /// As noted when the nodes of `some` patches were last looked at; of the others, all nodes.
    [[gnu::always_inline]] TouchingNodes(State state, const PatchLattice& lattice, const LaneMask& some) {
        const Lanes zero = all(0.0), one = all(1.0);
        w = select(some, state.get(patch_field::touching_w), one);
        ws = select(some, state.get(patch_field::touching_ws), zero);
        wt = select(some, state.get(patch_field::touching_wt), zero);
        wss = select(some, state.get(patch_field::touching_wss), all(lattice.second_p));
        wst = select(some, state.get(patch_field::touching_wst), zero);
        wtt = select(some, state.get(patch_field::touching_wtt), all(lattice.second_q));
        box_s = select(some, state.get(patch_field::box_s), zero);
        box_t = select(some, state.get(patch_field::box_t), zero);
        box_half_s = select(some, state.get(patch_field::box_half_s), one);
        box_half_t = select(some, state.get(patch_field::box_half_t), one);
    }

    /// An affine function over the box in place of the lattice.
    [[gnu::always_inline]] Affine in_box(const Affine& a) const {
        return {(a.at + a.s * box_s) + a.t * box_t, a.s * box_half_s, a.t * box_half_t};
    }
};

/// Σ w·f·(1, s, t) over the nodes that touch.
[[gnu::always_inline]] inline Affine moments(const Affine& a, const TouchingNodes& nodes) {
    return {(nodes.w * a.at + nodes.ws * a.s) + nodes.wt * a.t, (nodes.ws * a.at + nodes.wss * a.s) + nodes.wst * a.t,
            (nodes.wt * a.at + nodes.wst * a.s) + nodes.wtt * a.t};
}

/// Looks at every node of one patch of a group.
class NodePass {
  public:
    NodePass(const PatchLattice& lattice, const PatchLaw& law, const PatchMotion& motion, double area, std::size_t lane, double* slip_u,
             double* slip_v, State state)
        : lattice_(lattice), law_(law), motion_(motion), area_(area), lane_(lane), slip_u_(slip_u), slip_v_(slip_v), state_(state) {}

    /// For a patch of which a node may part, begin, or be pulled by its dashpot: everything node by node.
    template <bool Viscous>
    [[gnu::always_inline]] void run(PatchSums& sums) const {
        const NodeAffine d(motion_.overlap, lane_), opening(motion_.opening, lane_);
        const NodeAffine slide_u(motion_.slide_u, lane_), slide_v(motion_.slide_v, lane_);
        const NodeAffine since_u(state_.get_affine(patch_field::slip_u), lane_), since_v(state_.get_affine(patch_field::slip_v), lane_);
        const Lanes zero = all(0.0), one = all(1.0), cn = all(law_.cn[lane_]), cs = all(law_.cs[lane_]);
        // what is common to the nodes moved those that touched at the last look
        const NodeAffine seen(state_.get_affine(patch_field::seen), lane_);
        const LaneMask all_touched = all(get(patch_field::touching)) == all(static_cast<double>(lattice_.size()));
        NodeSums pressures, dashpots, drags_u, drags_v, owns_u, owns_v;
        Lanes normal_energy{}, squares{}, lost{}, count{}, deepest{};
        LaneMask sliding{}, clamped{};

        for (std::size_t i = 0; i < lattice_.w.size(); i += kLanes) {
            const Lanes s = load(&lattice_.s[i]), t = load(&lattice_.t[i]), w = load(&lattice_.w[i]);
            const Lanes overlap = d(s, t);
            const LaneMask active = (overlap > zero) & (w > zero);
            const LaneMask touched = all_touched | (seen(s, t) > zero);
            // most nodes of a patch that stands on an edge are open, and were: they have not slipped
            if (!any(active | touched)) continue;
            const Lanes old_u = load(slip_u_ + i) + select(touched, since_u(s, t), zero),
                        old_v = load(slip_v_ + i) + select(touched, since_v(s, t), zero);
            const Lanes apart = opening(s, t), elastic = law_.kn * overlap, damped = elastic - cn * apart;
            const LaneMask pulled = damped <= zero;
            clamped |= pulled & active;
            const Lanes pressure = select(active & ~pulled, damped, zero);

            // all of the displacement is elastic at first; of a node that began to touch in this step, the part that came after
            const LaneMask begins = active & (apart < -overlap);
            Lanes step_u = slide_u(s, t), step_v = slide_v(s, t);
            if (any(begins)) {
                const Lanes part = select(begins, overlap / select(begins, -apart, one), one);
                step_u *= part;
                step_v *= part;
            }
            Lanes new_u = old_u + step_u, new_v = old_v + step_v;
            Lanes drag_u = zero, drag_v = zero;
            if (Viscous) drag_u = -cs * step_u, drag_v = -cs * step_v;
            Lanes shear_u = drag_u - law_.ks * new_u, shear_v = drag_v - law_.ks * new_v;

            const Lanes limit = law_.mu * pressure, squared = shear_u * shear_u + shear_v * shear_v;
            const LaneMask slides = (squared > limit * limit) & active;
            sliding |= slides;
            const Lanes scale = select(slides, limit / root(select(slides, squared, one)), one);
            // a node that has just ended gives up what its spring held
            shear_u = select(active, shear_u * scale, zero);
            shear_v = select(active, shear_v * scale, zero);
            new_u = select(active, select(slides, -law_.ks_inverse * shear_u, new_u), zero);
            new_v = select(active, select(slides, -law_.ks_inverse * shear_v, new_v), zero);
            const Lanes stored = new_u * new_u + new_v * new_v, stored_before = old_u * old_u + old_v * old_v;
            const Lanes work = (law_.ks * old_u - shear_u) * step_u + (law_.ks * old_v - shear_v) * step_v;
            lost += w * select(slides | ~active, work - law_.ks * (stored - stored_before), zero);
            store(new_u, slip_u_ + i);
            store(new_v, slip_v_ + i);

            const Lanes ws = load(&lattice_.ws[i]), wt = load(&lattice_.wt[i]);
            pressures.add(pressure, w, ws, wt);
            dashpots.add(select(active, pressure - elastic, zero), w, ws, wt);
            owns_u.add(new_u, w, ws, wt);
            owns_v.add(new_v, w, ws, wt);
            if (Viscous) {
                drags_u.add(select(active & ~slides, drag_u, zero), w, ws, wt);
                drags_v.add(select(active & ~slides, drag_v, zero), w, ws, wt);
            }
            normal_energy += w * select(active, elastic * overlap, zero);
            squares += w * stored;
            count += select(active, one, zero);
            deepest = larger(deepest, select(active, overlap, zero));
        }

        pressures.finish(area_, lane_, sums.pressure);
        dashpots.finish(area_, lane_, sums.dashpot);
        // the dashpot of a node that slides is empty, so that its traction is that of its spring too
        owns_u.finish(-law_.ks * area_, lane_, sums.shear_u);
        owns_v.finish(-law_.ks * area_, lane_, sums.shear_v);
        if (Viscous) {
            drags_u.finish(area_, lane_, sums.drag_u);
            drags_v.finish(area_, lane_, sums.drag_v);
            add_lane(sums.drag_u, sums.shear_u);
            add_lane(sums.drag_v, sums.shear_v);
        }
        const double touching = sum(count);
        sums.elastic_normal[lane_] = 0.5 * area_ * sum(normal_energy);
        sums.elastic_shear[lane_] = 0.5 * law_.ks * area_ * sum(squares);
        sums.friction[lane_] = 0.5 * area_ * sum(lost);
        sums.overlap[lane_] = largest(deepest);
        sums.touching[lane_] = touching;
        const bool settled = touching > 0.0 && law_.mu > 0.0 && !any(sliding) && !any(clamped);
        const bool stays = get(patch_field::slack) >= 0.0 && get(patch_field::touching) == touching;
        write_own(owns_u, owns_v, sum(squares));
        for (std::size_t i = 0; i < 3; ++i) set(patch_field::seen + i, part(motion_.overlap, i));
        if (!settled) {
            set(patch_field::slack, -1.0);
        } else if (touching == static_cast<double>(lattice_.size())) {
            set(patch_field::slack, find_slack());
        } else if (stays) {
            note_touching();
        } else {
            // a block that rocks or slides changes its nodes from step to step: noting them would not pay
            set(patch_field::slack, 0.0);
        }
    }

    /// For a patch all of whose nodes touched and do, without tangential dashpots: only what friction makes of each of them.
    [[gnu::always_inline]] void run_pressed(const Affine& pressure, PressedSums& sums) const {
        const double per_ks = law_.mu * law_.ks_inverse;
        const Affine moved_u = sum_of(state_.get_affine(patch_field::slip_u), motion_.slide_u),
                     moved_v = sum_of(state_.get_affine(patch_field::slip_v), motion_.slide_v);
        const NodeAffine along_u(moved_u, lane_), along_v(moved_v, lane_), limit(scaled(all(per_ks), pressure), lane_);
        const Lanes one = all(1.0);
        NodeSums owns_u, owns_v;
        Lanes squares{};
        LaneMask sliding{};
        for (std::size_t i = 0; i < lattice_.w.size(); i += kLanes) {
            const Lanes s = load(&lattice_.s[i]), t = load(&lattice_.t[i]);
            const Lanes trial_u = load(slip_u_ + i) + along_u(s, t), trial_v = load(slip_v_ + i) + along_v(s, t);
            const Lanes most = limit(s, t), squared = trial_u * trial_u + trial_v * trial_v;
            const LaneMask slides = squared > most * most;
            sliding |= slides;
            const Lanes scale = select(slides, most / root(squared), one);
            const Lanes new_u = trial_u * scale, new_v = trial_v * scale;
            store(new_u, slip_u_ + i);
            store(new_v, slip_v_ + i);
            const Lanes w = load(&lattice_.w[i]), ws = load(&lattice_.ws[i]), wt = load(&lattice_.wt[i]);
            owns_u.add(new_u, w, ws, wt);
            owns_v.add(new_v, w, ws, wt);
            squares += w * (new_u * new_u + new_v * new_v);
        }
        sums.u[lane_] = owns_u;
        sums.v[lane_] = owns_v;
        sums.squares[lane_] = squares;
        sums.slid[lane_] = any(sliding) ? -1 : 0;
        set(patch_field::slack, any(sliding) ? -1.0 : find_slack());
    }

  private:
    [[gnu::always_inline]] void add_lane(const Affine& from, Affine& to) const {
        to.at[lane_] += from.at[lane_];
        to.s[lane_] += from.s[lane_];
        to.t[lane_] += from.t[lane_];
    }

    /// The nodes have taken up what was common to them.
    [[gnu::always_inline]] void write_own(const NodeSums& u, const NodeSums& v, double squares) const {
        for (std::size_t field = patch_field::slip_u; field <= patch_field::slip_vt; ++field) set(field, 0.0);
        set(patch_field::own_u, sum(u.at)), set(patch_field::own_us, sum(u.s)), set(patch_field::own_ut, sum(u.t));
        set(patch_field::own_v, sum(v.at)), set(patch_field::own_vs, sum(v.s)), set(patch_field::own_vt, sum(v.t));
        set(patch_field::own_squared, squares);
    }

    /// How far the node nearest to sliding is from it [Pa]; all touch and none slides. Notes the pressures this holds for.
    [[gnu::always_inline]] double find_slack() const {
        const Affine pressure = pressure_of(law_, motion_);
        const NodeAffine at(pressure, lane_);
        Lanes least = all(law_.mu * at.at[0]);
        for (std::size_t i = 0; i < lattice_.w.size(); i += kLanes) {
            const Lanes u = load(slip_u_ + i), v = load(slip_v_ + i);
            least = smaller(least, law_.mu * at(load(&lattice_.s[i]), load(&lattice_.t[i])) - law_.ks * root(u * u + v * v));
        }
        write_pressure(pressure);
        return smallest(least);
    }

    /// Of a patch that touches with some of its nodes, none of which slides: which they are, and how far all are from a change.
    [[gnu::always_inline]] void note_touching() const {
        const Affine pressure = pressure_of(law_, motion_);
        const NodeAffine at(pressure, lane_), d(motion_.overlap, lane_);
        const Lanes zero = all(0.0), one = all(1.0), never = all(std::numeric_limits<double>::infinity());
        NodeSums ones;
        Lanes sum_ss{}, sum_st{}, sum_tt{};
        Lanes slack = never, gap = never, hold = never, low_s = one, low_t = one, high_s = -one, high_t = -one;
        for (std::size_t i = 0; i < lattice_.w.size(); i += kLanes) {
            const Lanes s = load(&lattice_.s[i]), t = load(&lattice_.t[i]), w = load(&lattice_.w[i]);
            const Lanes overlap = d(s, t);
            const LaneMask exists = w > zero, touches = exists & (overlap > zero);
            gap = smaller(gap, select(exists & ~touches, -overlap, never));
            if (!any(touches)) continue;
            const Lanes u = load(slip_u_ + i), v = load(slip_v_ + i);
            slack = smaller(slack, select(touches, law_.mu * at(s, t) - law_.ks * root(u * u + v * v), never));
            hold = smaller(hold, select(touches, overlap, never));
            low_s = smaller(low_s, select(touches, s, one)), high_s = larger(high_s, select(touches, s, -one));
            low_t = smaller(low_t, select(touches, t, one)), high_t = larger(high_t, select(touches, t, -one));
            const Lanes weight = select(touches, w, zero), weight_s = select(touches, load(&lattice_.ws[i]), zero),
                        weight_t = select(touches, load(&lattice_.wt[i]), zero);
            ones.add(one, weight, weight_s, weight_t);
            sum_ss += weight_s * s, sum_st += weight_s * t, sum_tt += weight_t * t;
        }
        write_pressure(pressure);
        set(patch_field::slack, smallest(slack));
        set(patch_field::gap, smallest(gap)), set(patch_field::hold, smallest(hold));
        const double from_s = smallest(low_s), to_s = largest(high_s), from_t = smallest(low_t), to_t = largest(high_t);
        set(patch_field::box_s, 0.5 * (from_s + to_s)), set(patch_field::box_half_s, 0.5 * (to_s - from_s));
        set(patch_field::box_t, 0.5 * (from_t + to_t)), set(patch_field::box_half_t, 0.5 * (to_t - from_t));
        set(patch_field::touching_w, sum(ones.at)), set(patch_field::touching_ws, sum(ones.s));
        set(patch_field::touching_wt, sum(ones.t)), set(patch_field::touching_wss, sum(sum_ss));
        set(patch_field::touching_wst, sum(sum_st)), set(patch_field::touching_wtt, sum(sum_tt));
    }

    [[gnu::always_inline]] void write_pressure(const Affine& pressure) const {
        for (std::size_t i = 0; i < 3; ++i) set(patch_field::pressure + i, part(pressure, i));
    }
    [[gnu::always_inline]] double part(const Affine& a, std::size_t i) const { return (i == 0 ? a.at : i == 1 ? a.s : a.t)[lane_]; }
    [[gnu::always_inline]] double get(std::size_t field) const { return state_.at[field * kWidth + lane_]; }
    [[gnu::always_inline]] void set(std::size_t field, double value) const { state_.at[field * kWidth + lane_] = value; }

    const PatchLattice& lattice_;
    const PatchLaw& law_;
    const PatchMotion& motion_;
    double area_;  ///< of the patch [m²]
    std::size_t lane_;
    double* slip_u_;  ///< own slips of this patch [m]
    double* slip_v_;
    State state_;
};

}  // namespace musim::lsdem::detail
