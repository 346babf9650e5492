#include "lsdem/patch_pairs.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "lsdem/detail/patch_state.hpp"

namespace musim::lsdem {
namespace {

/// A box on the ground keeps the face it stands on up to this cosine of its tilt; beyond, its nodes are computed one by one.
constexpr double kMinGroundCosine = 0.75;

/// A lattice is kept while the patch asks for no more than this many nodes more or fewer along an axis.
constexpr int kLatticeSlack = 1;

std::uint8_t largest_of(const Eigen::RowVector3d& row) {
    Eigen::Index axis = 0;
    row.cwiseAbs().maxCoeff(&axis);
    return static_cast<std::uint8_t>(axis);
}

void set_axes(const Matrix3& between, std::uint8_t k, PatchKind& kind) {
    kind.k = k;
    kind.u = static_cast<std::uint8_t>((k + 1) % 3);
    kind.v = static_cast<std::uint8_t>((k + 2) % 3);
    kind.n = largest_of(between.row(k));
    const auto a = static_cast<std::uint8_t>((kind.n + 1) % 3), b = static_cast<std::uint8_t>((kind.n + 2) % 3);
    const bool a_first = std::abs(between(kind.u, a)) >= std::abs(between(kind.u, b));
    kind.p = a_first ? a : b;
    kind.q = a_first ? b : a;
}

constexpr std::uint8_t kHeightAxis = 2;

/// Half extent of a shape along an axis, times a sign.
PatchLength half_along(const Shape& shape, std::uint8_t axis, double sign = 1.0) {
    return {sign * shape.half_extents[axis], axis == kHeightAxis ? 0.5 * sign : 0.0};
}

/// Node spacing of a shape along an axis; that along the height stretches with it.
PatchLength spacing_along(const Shape& shape, std::uint8_t axis) {
    const double spacing = shape.node_spacing[axis];
    return {spacing, axis == kHeightAxis ? spacing / (2.0 * shape.half_extents[axis]) : 0.0};
}

void set_leader_face(const Shape& leader, double normal_component, PatchKind& kind) {
    const double toward = kind.side * normal_component < 0.0 ? 1.0 : -1.0;
    kind.face_n = half_along(leader, kind.n, toward);
    kind.half_p = half_along(leader, kind.p);
    kind.half_q = half_along(leader, kind.q);
    kind.spacing_p = spacing_along(leader, kind.p);
    kind.spacing_q = spacing_along(leader, kind.q);
    kind.height = 2.0 * leader.half_extents.z();
    kind.spacing = leader.patch_spacing;
}

std::optional<PatchKind> find_ground_kind(const Shape& leader, const PairPoses& poses) {
    PatchKind kind;
    set_axes(poses.leader, 2, kind);
    if (std::abs(poses.leader(kind.k, kind.n)) < kMinGroundCosine) return std::nullopt;
    kind.bounded = false;
    set_leader_face(leader, poses.leader(kind.k, kind.n), kind);
    return kind;
}

bool is_box(const Shape& shape) { return shape.faceted && std::holds_alternative<BoxLevelSet>(shape.level_set); }

int count_along(double length, double spacing) { return std::max(2, 1 + static_cast<int>(std::lround(length / spacing))); }

/// Slip of a patch at any place of its old lattice.
class OldSlip {
  public:
    explicit OldSlip(const PatchView& patch) : patch_(patch) {}

    double u(double s, double t) const {
        return between(s, t, [&](std::size_t node) { return patch_.slip_u(node); });
    }
    double v(double s, double t) const {
        return between(s, t, [&](std::size_t node) { return patch_.slip_v(node); });
    }

  private:
    /// A place that was open has not slipped.
    template <class AtNode>
    double between(double s, double t, const AtNode& at_node) const {
        if (!patch_.touched(s, t)) return 0.0;
        const PatchLattice& lattice = patch_.lattice();
        const auto count = static_cast<std::size_t>(lattice.count_p);
        const auto [i, along_p] = find_place(s, lattice.s, count, 1);
        const auto [j, along_q] = find_place(t, lattice.t, static_cast<std::size_t>(lattice.count_q), count);
        const auto at = [&](std::size_t a, std::size_t b) { return at_node(b * count + a); };
        const double low = at(i, j) + along_p * (at(i + 1, j) - at(i, j)),
                     high = at(i, j + 1) + along_p * (at(i + 1, j + 1) - at(i, j + 1));
        return low + along_q * (high - low);
    }

    struct Place {
        std::size_t first;
        double fraction;
    };
    /// Between which two of `count` nodes, `stride` apart in `places`, a point lies.
    static Place find_place(double s, const std::vector<double>& places, std::size_t count, std::size_t stride) {
        std::size_t first = 0;
        while (first + 2 < count && places[(first + 1) * stride] <= s) ++first;
        const double low = places[first * stride], high = places[(first + 1) * stride];
        return {first, (s - low) / (high - low)};
    }

    const PatchView& patch_;
};

/// The same faces with the same law, whatever the nodes.
bool same_faces(PatchKind a, const PatchKind& b) {
    a.lattice = b.lattice;
    return a == b;
}

/// New patches whose faces are nearer than this part of the nodes' spacing will touch soon [-]. Affects speed only.
constexpr double kAlmost = 1.0 / 1024.0;

class PatchPlacer {
  public:
    PatchPlacer(const Bodies& bodies, const BasePose& base, const ContactList& previous, const std::vector<std::uint32_t>& old_pair,
                ContactList& list)
        : bodies_(bodies), base_(base), previous_(previous), old_pair_(old_pair), list_(list) {}

    void place(PatchPlan plan) {
        const ContactPair& pair = list_.pairs[plan.pair];
        const ContactPair* old = find_old(plan);
        const PatchHeights heights{bodies_.height_offset[pair.leader],
                                   pair.follower == kGround ? 0.0 : bodies_.height_offset[pair.follower], plan.damping};
        choose_lattice(pair, old, heights, plan);
        const std::uint32_t kind = list_.patches.find_kind(plan.kind);
        open_.resize(list_.patches.kinds.size(), {kNone, kNone});
        // patches that touch nothing keep to themselves: a group of them costs little
        const bool touches = old != nullptr ? previous_.patches.field(old->patch_group, patch_field::touching)[old->patch_lane] > 0.0
                                            : measure(plan.kind, pair, heights).depth > -kAlmost * plan.kind.spacing_p.nominal;
        std::uint32_t& index = open_[kind][touches ? 1 : 0];
        if (index == kNone) index = add_group(kind);
        add_lane(plan.pair, heights, index);
        start_lane(plan.pair, heights, old);
        if (list_.patches.groups[index].count == PatchGroup::kSize) index = kNone;
    }

  private:
    static constexpr std::uint32_t kNone = ContactPair::kNoPatch;

    const ContactPair* find_old(const PatchPlan& plan) const {
        if (old_pair_[plan.pair] == kNone) return nullptr;
        const ContactPair& old = previous_.pairs[old_pair_[plan.pair]];
        if (!old.is_patch()) return nullptr;
        return same_faces(kind_of(previous_.patches, old), plan.kind) ? &old : nullptr;
    }

    static const PatchKind& kind_of(const PatchList& patches, const ContactPair& pair) {
        return patches.kinds[patches.groups[pair.patch_group].kind];
    }

    detail::PatchSize measure(const PatchKind& kind, const ContactPair& pair, const PatchHeights& heights) const {
        const PairPoses poses = find_pair_poses(bodies_, base_, pair.leader, pair.follower, false);
        return detail::measure_patch(kind, heights, poses.leader, poses.follower, poses.offset);
    }

    void choose_lattice(const ContactPair& pair, const ContactPair* old, const PatchHeights& heights, PatchPlan& plan) const {
        PatchKind& kind = plan.kind;
        if (plan.count_p >= 2 && plan.count_q >= 2) {
            kind.lattice = list_.patches.find_lattice(plan.count_p, plan.count_q, kind.spacing);
            return;
        }
        const detail::PatchSize size = measure(kind, pair, heights);
        const auto count = [&](double length, const PatchLength& spacing) {
            return count_along(length, spacing.nominal + spacing.per_offset * heights.leader);
        };
        const int p = count(size.p, kind.spacing_p), q = count(size.q, kind.spacing_q);
        if (old != nullptr) {
            const PatchLattice& lattice = previous_.patches.lattices[kind_of(previous_.patches, *old).lattice];
            if (std::abs(lattice.count_p - p) <= kLatticeSlack && std::abs(lattice.count_q - q) <= kLatticeSlack) {
                kind.lattice = list_.patches.find_lattice(lattice.count_p, lattice.count_q, kind.spacing);
                return;
            }
        }
        kind.lattice = list_.patches.find_lattice(p, q, kind.spacing);
    }

    std::uint32_t add_group(std::uint32_t kind) {
        PatchList& patches = list_.patches;
        PatchGroup group;
        group.kind = kind;
        group.first_slot = static_cast<std::uint32_t>(patches.slip_u.size());
        patches.groups.push_back(group);
        const std::size_t slots = patches.slip_u.size() + PatchGroup::kSize * patches.slots(group);
        patches.slip_u.resize(slots, 0.0);
        patches.slip_v.resize(slots, 0.0);
        patches.state.resize(patches.groups.size() * patch_field::count * PatchGroup::kSize, 0.0);
        patches.next_look.resize(patches.groups.size() * PatchGroup::kSize, 0.0);
        return static_cast<std::uint32_t>(patches.groups.size() - 1);
    }

    void add_lane(std::uint32_t index, const PatchHeights& heights, std::uint32_t group_index) {
        PatchGroup& group = list_.patches.groups[group_index];
        ContactPair& pair = list_.pairs[index];
        pair.patch_group = group_index;
        pair.patch_lane = group.count;
        // lanes not in use repeat the last one that is
        for (std::size_t lane = group.count; lane < PatchGroup::kSize; ++lane) {
            group.pair[lane] = index;
            group.leader[lane] = pair.leader;
            group.follower[lane] = pair.follower;
            group.leader_offset[lane] = heights.leader;
            group.follower_offset[lane] = heights.follower;
            group.damping[lane] = heights.damping;
        }
        ++group.count;
    }

    void start_lane(std::uint32_t index, const PatchHeights& heights, const ContactPair* old) {
        const ContactPair& pair = list_.pairs[index];
        PatchList& patches = list_.patches;
        double* state = patches.field(pair.patch_group, 0);
        const auto set = [&](std::size_t field, double value) { state[field * PatchGroup::kSize + pair.patch_lane] = value; };
        if (old == nullptr) {
            const PairPoses poses = find_pair_poses(bodies_, base_, pair.leader, pair.follower, true);
            detail::write_patch_pose(kind_of(patches, pair), heights, poses.leader, poses.follower, poses.offset, pair.patch_lane, state);
            set(patch_field::slack, -1.0);
            return;
        }
        for (std::size_t field = 0; field < patch_field::count; ++field)
            set(field, previous_.patches.field(old->patch_group, field)[old->patch_lane]);
        patches.next_look[pair.patch_group * PatchGroup::kSize + pair.patch_lane] =
            previous_.patches.next_look[old->patch_group * PatchGroup::kSize + old->patch_lane];
        set(patch_field::damping_loss, 0.0);
        set(patch_field::friction_loss, 0.0);

        const PatchLattice& lattice = patches.lattices[kind_of(patches, pair).lattice];
        const PatchLattice& old_lattice = previous_.patches.lattices[kind_of(previous_.patches, *old).lattice];
        const std::size_t slots = lattice.w.size();
        const std::size_t first = patches.groups[pair.patch_group].first_slot + pair.patch_lane * slots;
        if (lattice.count_p == old_lattice.count_p && lattice.count_q == old_lattice.count_q) {
            const std::size_t from = previous_.patches.groups[old->patch_group].first_slot + old->patch_lane * slots;
            std::copy_n(&previous_.patches.slip_u[from], slots, &patches.slip_u[first]);
            std::copy_n(&previous_.patches.slip_v[from], slots, &patches.slip_v[first]);
            return;
        }
        const PatchView before(previous_.patches, old->patch_group, old->patch_lane);
        const OldSlip slip(before);
        for (std::size_t i = 0; i < lattice.size(); ++i) {
            patches.slip_u[first + i] = slip.u(lattice.s[i], lattice.t[i]);
            patches.slip_v[first + i] = slip.v(lattice.s[i], lattice.t[i]);
        }
        for (std::size_t field = patch_field::slip_u; field <= patch_field::slip_vt; ++field) set(field, 0.0);
        set(patch_field::slack, -1.0);
        if (before.all_touched()) set(patch_field::touching, static_cast<double>(lattice.size()));
    }

    const Bodies& bodies_;
    const BasePose& base_;
    const ContactList& previous_;
    const std::vector<std::uint32_t>& old_pair_;
    ContactList& list_;
    std::vector<std::array<std::uint32_t, 2>> open_;  ///< per kind, the groups that are not full yet: of open patches, of touching ones
};

}  // namespace

PairPoses find_pair_poses(const Bodies& bodies, const BasePose& base, std::uint32_t leader, std::uint32_t follower, bool previous) {
    const auto& rotation = previous ? bodies.previous_rotation : bodies.rotation;
    const auto& position = previous ? bodies.previous_position : bodies.position;
    if (follower == kGround)
        return {rotation[leader], Matrix3::Identity(), position[leader] - (previous ? base.previous : base.displacement)};
    return {rotation[leader], rotation[follower], position[leader] - position[follower]};
}

std::optional<PatchKind> find_patch_kind(const Model& model, const Bodies& bodies, const BasePose& base, std::uint32_t leader_index,
                                         std::uint32_t follower_index, double skin) {
    const Shape& leader = model.shapes[model.blocks[leader_index].shape];
    if (!is_box(leader)) return std::nullopt;
    const PairPoses poses = find_pair_poses(bodies, base, leader_index, follower_index, false);
    if (follower_index == kGround) return find_ground_kind(leader, poses);
    const Shape& follower = model.shapes[model.blocks[follower_index].shape];
    if (!is_box(follower)) return std::nullopt;

    // overlap of the boxes along each axis of the follower, and along the leader's axis beside it
    const Matrix3 between = poses.follower.transpose() * poses.leader, size = between.cwiseAbs();
    const Vector3 in_follower = poses.follower.transpose() * poses.offset, in_leader = poses.leader.transpose() * poses.offset;
    const Vector3 &leader_half = bodies.half[leader_index], &follower_half = bodies.half[follower_index];
    const Vector3 gap_follower = in_follower.cwiseAbs() - follower_half - size * leader_half;
    const Vector3 gap_leader = in_leader.cwiseAbs() - leader_half - size.transpose() * follower_half;
    std::array<double, 3> gap{};
    for (std::uint8_t a = 0; a < 3; ++a) gap[a] = std::max(gap_follower[a], gap_leader[largest_of(between.row(a))]);
    const auto k = static_cast<std::uint8_t>(std::max_element(gap.begin(), gap.end()) - gap.begin());

    PatchKind kind;
    set_axes(between, k, kind);
    const double tilt = std::hypot(between(kind.k, kind.p), between(kind.k, kind.q));
    const double yaw = std::max(std::abs(between(kind.u, kind.q)), std::abs(between(kind.v, kind.p)));
    const bool parallel = tilt <= kMaxPatchTilt && yaw <= kMaxPatchYaw && tilt * yaw <= kMaxPatchTwist;
    const bool certain = std::max(gap[kind.u], gap[kind.v]) <= std::min(gap[k], 0.0) - 2.0 * skin;
    if (!parallel || !certain) return std::nullopt;
    kind.side = in_follower[k] < 0.0 ? -1.0 : 1.0;
    kind.face_k = half_along(follower, kind.k, kind.side);
    kind.half_u = half_along(follower, kind.u);
    kind.half_v = half_along(follower, kind.v);
    set_leader_face(leader, between(kind.k, kind.n), kind);
    return kind;
}

void place_patches(const std::vector<PatchPlan>& plans, const Bodies& bodies, const BasePose& base, const ContactList& previous,
                   const std::vector<std::uint32_t>& old_pair, ContactList& list) {
    list.patches.clear();
    PatchPlacer placer(bodies, base, previous, old_pair, list);
    for (const PatchPlan& plan : plans) placer.place(plan);
    list.patches.due.resize(list.patches.groups.size());
}

}  // namespace musim::lsdem
