#include "lsdem/detail/patch_kernel.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "lsdem/detail/instructions.hpp"
#include "lsdem/detail/patch_geometry.hpp"
#include "lsdem/detail/patch_nodes.hpp"
#include "lsdem/detail/prefetch.hpp"

namespace musim::lsdem::detail {
namespace {

/// Push of the edges that move with the follower, along one axis of the leader: the gradient of the energy stored in the patch as it
/// shrinks, and, where the faces are tilted, what turns the pressure into the normal of the face on which the follower's edge rests.
struct EdgePush {
    Lanes both, difference;  ///< high + low, high − low [N]
};

[[gnu::always_inline]] inline EdgePush find_edge_push(const Span& span, const Lanes& half, const LaneMask& exists, const Lanes& energy,
                                                      const Lanes& slope, const Lanes& pressure, const Lanes& pressure_moment) {
    const Lanes density = select(exists, energy / (half + half), all(0.0));
    const Lanes low = span.low_follows * (0.5 * slope * (pressure - pressure_moment) - density);
    const Lanes high = span.high_follows * (0.5 * slope * (pressure + pressure_moment) + density);
    return {high + low, high - low};
}

/// The poses of all blocks and the base at one step.
struct StepPoses {
    const std::vector<Matrix3>& rotation;
    const std::vector<Vector3>& position;
    const Vector3& base;
};

/// Poses of the blocks of four patches, world frame.
struct GroupPoses {
    LaneVector offset;                  ///< leader's centre less the follower's [m]
    LaneVector axis_k, axis_u, axis_v;  ///< of the follower
    FacePose face;                      ///< the leader's face in the follower's frame

    [[gnu::always_inline]] GroupPoses(const PatchGroup& group, const PatchKind& kind, const PatchSizes& sizes, const StepPoses& at) {
        static constexpr std::array<double, 9> kWorld{1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0};
        LanePointers leader_rotation, leader_position, follower_rotation, follower_position;
        for (std::size_t lane = 0; lane < kWidth; ++lane) {
            leader_rotation[lane] = at.rotation[group.leader[lane]].data();
            leader_position[lane] = at.position[group.leader[lane]].data();
            follower_rotation[lane] = kind.bounded ? at.rotation[group.follower[lane]].data() : kWorld.data();
            follower_position[lane] = kind.bounded ? at.position[group.follower[lane]].data() : at.base.data();
        }
        // matrices are stored by columns: an axis of a block is three numbers in a row
        constexpr std::size_t kAxis = 3;
        offset = load_vectors(leader_position, 0) - load_vectors(follower_position, 0);
        axis_k = load_vectors(follower_rotation, kAxis * kind.k);
        axis_u = load_vectors(follower_rotation, kAxis * kind.u);
        axis_v = load_vectors(follower_rotation, kAxis * kind.v);
        const LaneVector center = offset + sizes.face_n * load_vectors(leader_rotation, kAxis * kind.n);
        face = {seen(center), seen(load_vectors(leader_rotation, kAxis * kind.p)), seen(load_vectors(leader_rotation, kAxis * kind.q))};
    }

    [[gnu::always_inline]] LaneVector seen(const LaneVector& v) const { return {dot(axis_k, v), dot(axis_u, v), dot(axis_v, v)}; }
    [[gnu::always_inline]] LaneVector to_world(const LaneVector& v) const { return (v.x * axis_k + v.y * axis_u) + v.z * axis_v; }
};

[[gnu::always_inline]] inline PatchMotion find_motion(const PatchKind& kind, const PatchSizes& sizes, const Cover& cover,
                                                      const FacePose& pose, const FacePose& change) {
    const double side = kind.side;
    PatchMotion motion;
    motion.overlap = find_overlap(kind, sizes, cover, pose);
    motion.opening = over_lattice(cover, side * change.place.x, side * change.along_p.x, side * change.along_q.x);
    motion.slide_u = over_lattice(cover, change.place.y, change.along_p.y, change.along_q.y);
    motion.slide_v = over_lattice(cover, change.place.z, change.along_p.z, change.along_q.z);
    return motion;
}

/// What a new patch overlapped before it was noticed carries nothing, unless its area begins at zero too.
[[gnu::always_inline]] inline Lanes find_late(const PatchSizes& sizes, const PatchMotion& motion, const Lanes& area, const Lanes& touched,
                                              const Lanes& late) {
    const Lanes zero = all(0.0);
    const Lanes sudden = smaller((1.0 / (kSuddenPart * sizes.spacing_p * sizes.spacing_q)) * area, all(1.0));
    const Lanes noticed = larger(highest(sum_of(motion.overlap, motion.opening)), zero) * sudden;
    return select(touched > zero, smaller(late, larger(highest(motion.overlap), zero)), noticed);
}

/// How far the two blocks of each patch have travelled.
[[gnu::always_inline]] inline Lanes find_travel(const PatchGroup& group, const Bodies& bodies) {
    return gather(bodies.travel.data(), group.leader.data()) + gather(bodies.travel.data(), group.follower.data());
}

/// How far faces that do not touch are apart, or beside each other; `overlap`: the whole, with what carries no force [m].
[[gnu::always_inline]] inline Lanes find_gap(const Cover& cover, const Lanes& overlap) {
    return select(cover.exists, -overlap, larger(-cover.half_p, -cover.half_q));
}

/// Slips of the nodes of four patches: what is common to them, and the moments of their own.
struct PatchSlips {
    Affine common_u, common_v, own_u, own_v;
    Lanes own_squared;

    [[gnu::always_inline]] explicit PatchSlips(State state)
        : common_u(state.get_affine(patch_field::slip_u)),
          common_v(state.get_affine(patch_field::slip_v)),
          own_u(state.get_affine(patch_field::own_u)),
          own_v(state.get_affine(patch_field::own_v)),
          own_squared(state.get(patch_field::own_squared)) {}

    /// Σ wξ(1, s, t) along u and v, and Σ w|ξ|², over the nodes that touch: a lattice or a part of it.
    template <class Nodes>
    [[gnu::always_inline]] Affine moments_u(const Nodes& nodes) const {
        return sum_of(own_u, moments(common_u, nodes));
    }
    template <class Nodes>
    [[gnu::always_inline]] Affine moments_v(const Nodes& nodes) const {
        return sum_of(own_v, moments(common_v, nodes));
    }
    template <class Nodes>
    [[gnu::always_inline]] Lanes squares(const Nodes& nodes) const {
        return (own_squared + 2.0 * (contract(own_u, common_u) + contract(own_v, common_v))) +
               (contract(moments(common_u, nodes), common_u) + contract(moments(common_v, nodes), common_v));
    }
};

/// Sums over the nodes that touch, a lattice or a part of it, none of them pulled by its dashpot; the tangential part holds if none slides
/// either. `touching`: their number.
template <class Nodes>
[[gnu::always_inline]] inline PatchSums sum_pressed(const PatchKind& kind, const Nodes& nodes, const PatchLaw& law,
                                                    const PatchMotion& motion, const Affine& pressure, const PatchSlips& slips,
                                                    const Lanes& area, const Lanes& touching) {
    PatchSums sums;
    sums.pressure = scaled(area, moments(pressure, nodes));
    sums.dashpot = scaled(-law.cn * area, moments(motion.opening, nodes));
    sums.elastic_normal = (0.5 * law.kn) * area * contract(moments(motion.overlap, nodes), motion.overlap);
    sums.overlap = highest(motion.overlap);
    sums.touching = touching;
    sums.shear_u = scaled(-law.ks * area, slips.moments_u(nodes));
    sums.shear_v = scaled(-law.ks * area, slips.moments_v(nodes));
    sums.drag_u = sums.drag_v = zero_affine();
    if (kind.viscous) {
        sums.drag_u = scaled(-law.cs * area, moments(motion.slide_u, nodes));
        sums.drag_v = scaled(-law.cs * area, moments(motion.slide_v, nodes));
        sums.shear_u = sum_of(sums.shear_u, sums.drag_u);
        sums.shear_v = sum_of(sums.shear_v, sums.drag_v);
    }
    sums.elastic_shear = (0.5 * law.ks) * area * slips.squares(nodes);
    sums.friction = all(0.0);
    return sums;
}

/// By how much the node nearest to sliding may have come nearer since the nodes were last looked at [Pa]: all that has changed since, the
/// largest change of each over the nodes that touch. `on`: an affine function there.
template <class OnNodes>
[[gnu::always_inline]] inline Lanes find_approach(const PatchKind& kind, const PatchLaw& law, const PatchMotion& motion,
                                                  const PatchSlips& slips, const Affine& relief, const OnNodes& on) {
    Lanes nearer = law.ks * (farthest(on(slips.common_u)) + farthest(on(slips.common_v))) + law.mu * larger(highest(on(relief)), all(0.0));
    if (kind.viscous) nearer += law.cs * (farthest(on(motion.slide_u)) + farthest(on(motion.slide_v)));
    return nearer;
}

/// Do the nodes that touched when `some` patches were last looked at still do, and no others?
[[gnu::always_inline]] inline LaneMask find_unchanged(const LaneMask& some, const PatchMotion& motion, const TouchingNodes& nodes,
                                                      State state) {
    const Affine risen = difference_of(state.get_affine(patch_field::seen), motion.overlap);
    return some & (-lowest(risen) < state.get(patch_field::gap)) & (highest(nodes.in_box(risen)) < state.get(patch_field::hold));
}

/// Makes tractions and history of what the nodes of pressed patches slipped. The loss is what the springs were given, by slips at both ends
/// of the step, less what they keep; `stiffness`: K_s A [N/m].
[[gnu::always_inline]] inline void take_up_slips(const LaneMask& which, const PressedSums& nodes, const PatchMotion& motion,
                                                 const PatchLattice& lattice, const Lanes& stiffness, const PatchSlips& before,
                                                 PatchSums& sums, State state) {
    const Affine own_u = PressedSums::fold(nodes.u), own_v = PressedSums::fold(nodes.v), none = zero_affine();
    const Lanes squares = nodes.fold_squares(), zero = all(0.0);
    sums.shear_u = choose(which, scaled(-stiffness, own_u), sums.shear_u);
    sums.shear_v = choose(which, scaled(-stiffness, own_v), sums.shear_v);
    sums.elastic_shear = select(which, 0.5 * stiffness * squares, sums.elastic_shear);
    const Lanes given = contract(sum_of(before.moments_u(lattice), own_u), motion.slide_u) +
                        contract(sum_of(before.moments_v(lattice), own_v), motion.slide_v);
    const Lanes lost = 0.5 * stiffness * (given - (squares - before.squares(lattice)));
    sums.friction = select(which & nodes.slid, lost, select(which, zero, sums.friction));
    // the nodes have taken up what was common to them
    const PatchSlips now(state);
    state.set_affine(patch_field::slip_u, choose(which, none, now.common_u));
    state.set_affine(patch_field::slip_v, choose(which, none, now.common_v));
    state.set_affine(patch_field::own_u, choose(which, own_u, now.own_u));
    state.set_affine(patch_field::own_v, choose(which, own_v, now.own_v));
    state.set(patch_field::own_squared, select(which, squares, now.own_squared));
}

/// Losses of the dashpots: a force works over a step with the mean of its values at both ends.
[[gnu::always_inline]] inline void book_losses(const PatchKind& kind, const PatchMotion& motion, const PatchSums& sums, State state) {
    Lanes damping = contract(sum_of(state.get_affine(patch_field::dashpot), sums.dashpot), motion.opening);
    state.set_affine(patch_field::dashpot, sums.dashpot);
    if (kind.viscous) {
        damping += contract(sum_of(state.get_affine(patch_field::drag_u), sums.drag_u), motion.slide_u);
        damping += contract(sum_of(state.get_affine(patch_field::drag_v), sums.drag_v), motion.slide_v);
        state.set_affine(patch_field::drag_u, sums.drag_u);
        state.set_affine(patch_field::drag_v, sums.drag_v);
    }
    state.set(patch_field::damping_loss, state.get(patch_field::damping_loss) - 0.5 * damping);
    state.set(patch_field::friction_loss, state.get(patch_field::friction_loss) + sums.friction);
    state.set(patch_field::elastic_normal, sums.elastic_normal);
    state.set(patch_field::elastic_shear, sums.elastic_shear);
    state.set(patch_field::touching, sums.touching);
}

/// Force on the leader, and its moment about the follower's origin; follower's frame.
struct Resultant {
    LaneVector force, moment;
};

[[gnu::always_inline]] inline Resultant find_resultant(const PatchKind& kind, const PatchSizes& sizes, const Cover& cover,
                                                       const FacePose& pose, const PatchSums& sums) {
    const Affine y_k = over_lattice(cover, pose.place.x, pose.along_p.x, pose.along_q.x),
                 y_u = over_lattice(cover, pose.place.y, pose.along_p.y, pose.along_q.y),
                 y_v = over_lattice(cover, pose.place.z, pose.along_p.z, pose.along_q.z);
    const double side = kind.side;
    const Affine push = scaled(all(side), sums.pressure);
    Resultant sum;
    sum.force = {push.at, sums.shear_u.at, sums.shear_v.at};
    sum.moment = (cross({y_k.at, y_u.at, y_v.at}, sum.force) + cross({y_k.s, y_u.s, y_v.s}, {push.s, sums.shear_u.s, sums.shear_v.s})) +
                 cross({y_k.t, y_u.t, y_v.t}, {push.t, sums.shear_u.t, sums.shear_v.t});
    if (!kind.bounded) return sum;

    // the push of an edge belongs to the springs; the dashpot acts along the follower's normal, where its work is booked
    const Affine springs = difference_of(sums.pressure, sums.dashpot);
    const Lanes energy = sums.elastic_normal + sums.elastic_shear, zero = all(0.0);
    const EdgePush p = find_edge_push(cover.p, cover.half_p, cover.exists, energy, -side * pose.along_p.x, springs.at, springs.s);
    const EdgePush q = find_edge_push(cover.q, cover.half_q, cover.exists, energy, -side * pose.along_q.x, springs.at, springs.t);
    const LaneVector on_leader = p.both * pose.along_p + q.both * pose.along_q;
    // an edge of the follower lies at ± its half extent along u or v
    const Lanes arm_u = select(pose.along_p.y < zero, -sizes.half_u * p.difference, sizes.half_u * p.difference);
    const Lanes arm_v = select(pose.along_q.z < zero, -sizes.half_v * q.difference, sizes.half_v * q.difference);
    sum.force = sum.force + on_leader;
    sum.moment = (sum.moment + cross({sizes.face_k, zero, zero}, on_leader)) +
                 (cross({zero, arm_u, zero}, pose.along_p) + cross({zero, zero, arm_v}, pose.along_q));
    return sum;
}

/// Σ w of the nodes of a patch that touch [-].
[[gnu::always_inline]] inline double find_touching_weight(const PatchLattice& lattice, const State& state, std::size_t lane) {
    const double touching = state.get(patch_field::touching)[lane];
    if (!(touching > 0.0)) return 0.0;
    if (touching == static_cast<double>(lattice.size())) return 1.0;
    // a patch in which nothing slides or changes has noted it
    if (state.get(patch_field::slack)[lane] > 0.0) return state.get(patch_field::touching_w)[lane];
    const NodeAffine seen(state.get_affine(patch_field::seen), lane);
    Lanes weight = all(0.0);
    for (std::size_t i = 0; i < lattice.w.size(); i += kLanes) {
        const LaneMask touches = seen(load(&lattice.s[i]), load(&lattice.t[i])) > all(0.0);
        weight += select(touches, load(&lattice.w[i]), all(0.0));
    }
    return sum(weight);
}

[[gnu::always_inline]] inline double compute_group(const Bodies& bodies, const BasePose& base, double dt, std::size_t index,
                                                   ContactList& list) {
    PatchList& patches = list.patches;
    const PatchGroup& group = patches.groups[index];
    const PatchKind& kind = patches.kinds[group.kind];
    const PatchLattice& lattice = patches.lattices[kind.lattice];
    const PatchLaw law(StepLaw(kind.law, dt), load(group.damping.data()));
    const PatchSizes sizes(kind, load(group.leader_offset.data()), load(group.follower_offset.data()));
    const State state{patches.field(index, 0)};
    const Lanes zero = all(0.0);

    const GroupPoses poses(group, kind, sizes, {bodies.rotation, bodies.position, base.displacement});
    FacePose last{state.get_vector(patch_field::place_k), state.get_vector(patch_field::along_pk), state.get_vector(patch_field::along_qk)};
    double* const next_look = &patches.next_look[index * kWidth];
    if (any(load(next_look) > zero)) {
        // the last step may have passed over the group
        last = GroupPoses(group, kind, sizes, {bodies.previous_rotation, bodies.previous_position, base.previous}).face;
        store(zero, next_look);
    }
    const FacePose change = minus(poses.face, last);
    state.set_vector(patch_field::place_k, poses.face.place);
    state.set_vector(patch_field::along_pk, poses.face.along_p);
    state.set_vector(patch_field::along_qk, poses.face.along_q);
    const Cover cover = find_cover(kind, sizes, poses.face);
    const Lanes area = select(cover.exists, 4.0 * cover.half_p * cover.half_q, zero);
    PatchMotion motion = find_motion(kind, sizes, cover, poses.face, change);
    const Lanes touched = state.get(patch_field::touching);
    Lanes late = state.get(patch_field::late);
    if (!list.first_step) late = find_late(sizes, motion, area, touched, late);
    state.set(patch_field::late, late);
    motion.overlap.at -= late;

    if (!any((touched > zero) | (highest(motion.overlap) > zero))) {
        for (std::size_t lane = 0; lane < group.count; ++lane) list.forces[group.pair[lane]] = PairForce{};
        if (list.demand.wanted) {
            for (std::size_t lane = 0; lane < group.count; ++lane) list.demand.ask(group.pair[lane], 0.0);
        }
        if (kind.bounded && !list.first_step) {
            const Lanes trusted = list.trusted_gap * find_gap(cover, highest(motion.overlap) + late);
            store(select(trusted > zero, find_travel(group, bodies) + trusted, zero), next_look);
        }
        return 0.0;
    }

    // overlap and pressure are affine: their corners tell whether all nodes touch and push, now and a step ago
    const Affine pressure = pressure_of(law, motion);
    const LaneMask whole = touched == all(static_cast<double>(lattice.size()));
    const LaneMask pressed = (lowest(motion.overlap) > zero) & (lowest(pressure) > zero) & cover.exists &
                             (lowest(sum_of(motion.overlap, motion.opening)) > zero) & whole;

    // no node can reach the Coulomb limit before all that has changed since the nodes were last looked at could carry the nearest there
    const PatchSlips before(state);
    PatchSlips slips = before;
    slips.common_u = sum_of(before.common_u, motion.slide_u);
    slips.common_v = sum_of(before.common_v, motion.slide_v);
    const Affine relief = difference_of(state.get_affine(patch_field::pressure), pressure);
    const Lanes slack = state.get(patch_field::slack);
    const LaneMask some = (touched > zero) & ~whole & (slack > zero) & cover.exists;
    LaneMask stuck = pressed;
    PatchSums sums;
    if (any(some)) {
        const TouchingNodes nodes(state, lattice, some);
        const auto in_box = [&](const Affine& a) MUSIM_INLINE_LAMBDA { return nodes.in_box(a); };
        stuck |= find_unchanged(some, motion, nodes, state);
        if (law.mu > 0.0) stuck &= find_approach(kind, law, motion, slips, relief, in_box) < slack;
        sums = sum_pressed(kind, nodes, law, motion, pressure, slips, area, touched);
    } else {
        const auto everywhere = [](const Affine& a) MUSIM_INLINE_LAMBDA { return a; };
        if (law.mu > 0.0) stuck &= find_approach(kind, law, motion, slips, relief, everywhere) < slack;
        sums = sum_pressed(kind, lattice, law, motion, pressure, slips, area, touched);
    }
    const LaneMask sliding = kind.viscous ? LaneMask{} : pressed & ~stuck;
    const auto pass_of = [&](std::size_t lane) MUSIM_INLINE_LAMBDA {
        const std::size_t first = group.first_slot + lane * lattice.w.size();
        return NodePass(lattice, law, motion, area[lane], lane, &patches.slip_u[first], &patches.slip_v[first], state);
    };
    if (any(~(stuck | sliding))) {
        for (std::size_t lane = 0; lane < group.count; ++lane) {
            if ((stuck[lane] | sliding[lane]) != 0) continue;
            if (!(touched[lane] > 0.0) && !(highest(motion.overlap)[lane] > 0.0)) {
                sums.set_nothing(lane);
            } else if (kind.viscous) {
                pass_of(lane).run<true>(sums);
            } else {
                pass_of(lane).run<false>(sums);
            }
        }
    }
    if (any(sliding)) {
        PressedSums nodes;
        for (std::size_t lane = 0; lane < group.count; ++lane) {
            if (sliding[lane] != 0) pass_of(lane).run_pressed(pressure, nodes);
        }
        take_up_slips(sliding, nodes, motion, lattice, law.ks * area, before, sums, state);
    }
    if (any(stuck)) {
        const PatchSlips now(state);
        state.set_affine(patch_field::slip_u, choose(stuck, slips.common_u, now.common_u));
        state.set_affine(patch_field::slip_v, choose(stuck, slips.common_v, now.common_v));
    }
    book_losses(kind, motion, sums, state);

    const Resultant resultant = find_resultant(kind, sizes, cover, poses.face, sums);
    const LaneVector force = poses.to_world(resultant.force), moment = poses.to_world(resultant.moment);
    const LaneVector leader_torque = moment - cross(poses.offset, force);
    const Lanes overlap = sums.overlap + late;
    double deepest = 0.0;
    for (std::size_t lane = 0; lane < group.count; ++lane) {
        PairForce& result = list.forces[group.pair[lane]];
        result.force = {force.x[lane], force.y[lane], force.z[lane]};
        result.leader_torque = {leader_torque.x[lane], leader_torque.y[lane], leader_torque.z[lane]};
        result.follower_torque = {-moment.x[lane], -moment.y[lane], -moment.z[lane]};
        deepest = std::max(deepest, overlap[lane]);
        if (list.demand.wanted) list.demand.ask(group.pair[lane], area[lane] * find_touching_weight(lattice, state, lane));
    }
    return deepest / kind.height;
}

/// Writes the groups of [first, last) that have a patch which may touch to PatchList::due, from `first` on; returns their end there.
[[gnu::always_inline]] inline std::size_t list_due_groups(const Bodies& bodies, std::size_t first, std::size_t last, PatchList& patches) {
    std::size_t end = first;
    for (std::size_t index = first; index < last; ++index) {
        const Lanes next_look = load(&patches.next_look[index * kWidth]);
        const bool apart = !any(next_look <= all(0.0)) && all_of(find_travel(patches.groups[index], bodies) < next_look);
        if (!apart) patches.due[end++] = static_cast<std::uint32_t>(index);
    }
    return end;
}

/// So many groups before its turn a group itself is asked for, then what it names, and last what its state says will be needed. Affects
/// speed only.
constexpr std::size_t kGroupAhead = 8;
constexpr std::size_t kStateAhead = 4;
constexpr std::size_t kSlipsAhead = 1;

/// Blocks, forces and state of a group.
[[gnu::always_inline]] inline void prefetch_state(const Bodies& bodies, const ContactList& list, std::size_t index) {
    const PatchGroup& group = list.patches.groups[index];
    for (std::size_t lane = 0; lane < kWidth; ++lane) {
        prefetch(&bodies.rotation[group.leader[lane]]);
        prefetch(&bodies.position[group.leader[lane]]);
        prefetch(&list.forces[group.pair[lane]]);
        if (group.follower[lane] == kGround) continue;
        prefetch(&bodies.rotation[group.follower[lane]]);
        prefetch(&bodies.position[group.follower[lane]]);
    }
    prefetch(list.patches.field(index, 0), patch_field::count * kWidth);
}

/// Slips of the patches of a group that will be looked at node by node: they touch, and nothing tells that none of their nodes slides.
[[gnu::always_inline]] inline void prefetch_slips(const PatchList& patches, std::size_t index) {
    const PatchGroup& group = patches.groups[index];
    const std::size_t nodes = patches.slots(group);
    const double* const touching = patches.field(index, patch_field::touching);
    const double* const slack = patches.field(index, patch_field::slack);
    for (std::size_t lane = 0; lane < group.count; ++lane) {
        if (!(touching[lane] > 0.0) || slack[lane] > 0.0) continue;
        prefetch(&patches.slip_u[group.first_slot + lane * nodes], nodes);
        prefetch(&patches.slip_v[group.first_slot + lane * nodes], nodes);
    }
}

[[gnu::always_inline]] inline double compute_range(const Bodies& bodies, const BasePose& base, double dt, std::size_t first,
                                                   std::size_t last, ContactList& list) {
    const std::size_t end = list_due_groups(bodies, first, last, list.patches);
    const std::vector<std::uint32_t>& due = list.patches.due;
    double deepest = 0.0;
    for (std::size_t i = first; i < end; ++i) {
        if (i + kGroupAhead < end) prefetch(&list.patches.groups[due[i + kGroupAhead]]);
        if (i + kStateAhead < end) prefetch_state(bodies, list, due[i + kStateAhead]);
        if (i + kSlipsAhead < end) prefetch_slips(list.patches, due[i + kSlipsAhead]);
        deepest = std::max(deepest, compute_group(bodies, base, dt, due[i], list));
    }
    return deepest;
}

MUSIM_AVX2 double compute_wide(const Bodies& bodies, const BasePose& base, double dt, std::size_t first, std::size_t last,
                               ContactList& list) {
    return compute_range(bodies, base, dt, first, last, list);
}

double compute_plain(const Bodies& bodies, const BasePose& base, double dt, std::size_t first, std::size_t last, ContactList& list) {
    return compute_range(bodies, base, dt, first, last, list);
}

}  // namespace

double compute_patches(const Bodies& bodies, const BasePose& base, double dt, std::size_t first, std::size_t last, ContactList& list) {
    const auto compute = active_instructions() >= Instructions::avx2 ? compute_wide : compute_plain;
    return compute(bodies, base, dt, first, last, list);
}

}  // namespace musim::lsdem::detail
