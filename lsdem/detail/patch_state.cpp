#include "lsdem/detail/patch_state.hpp"

#include <algorithm>
#include <array>

#include "lsdem/detail/patch_geometry.hpp"

namespace musim::lsdem::detail {
namespace {

/// The pose of one patch, in all lanes.
FacePose make_pose(const PatchKind& kind, const PatchSizes& sizes, const Matrix3& leader, const Matrix3& follower, const Vector3& offset) {
    const Vector3 center = offset + sizes.face_n[0] * leader.col(kind.n);
    const auto seen = [&](const Vector3& v) {
        return LaneVector{all(follower.col(kind.k).dot(v)), all(follower.col(kind.u).dot(v)), all(follower.col(kind.v).dot(v))};
    };
    return {seen(center), seen(leader.col(kind.p)), seen(leader.col(kind.q))};
}

PatchSizes make_sizes(const PatchKind& kind, const PatchHeights& heights) { return {kind, all(heights.leader), all(heights.follower)}; }

/// Halvings until an overlap without force is found, to some digits below a double's.
constexpr int kLateHalvings = 40;

/// The faces of four patches where their states have them.
struct StoredPose {
    FacePose face;
    Cover cover;

    [[gnu::always_inline]] StoredPose(const PatchKind& kind, const PatchGroup& group, const double* fields)
        : face{vector_at(fields, patch_field::place_k), vector_at(fields, patch_field::along_pk), vector_at(fields, patch_field::along_qk)},
          cover(find_cover(kind, PatchSizes(kind, load(group.leader_offset.data()), load(group.follower_offset.data())), face)) {}

    double area(std::size_t lane) const { return cover.exists[lane] != 0 ? 4.0 * cover.half_p[lane] * cover.half_q[lane] : 0.0; }

  private:
    [[gnu::always_inline]] static LaneVector vector_at(const double* fields, std::size_t index) {
        const double* at = fields + index * kWidth;
        return {load(at), load(at + kWidth), load(at + 2 * kWidth)};
    }
};

}  // namespace

void write_patch_pose(const PatchKind& kind, const PatchHeights& heights, const Matrix3& leader, const Matrix3& follower,
                      const Vector3& offset, std::size_t lane, double* pose) {
    const FacePose lanes = make_pose(kind, make_sizes(kind, heights), leader, follower, offset);
    const std::array parts{&lanes.place, &lanes.along_p, &lanes.along_q};
    for (std::size_t i = 0; i < parts.size(); ++i) {
        pose[(3 * i) * kWidth + lane] = parts[i]->x[0];
        pose[(3 * i + 1) * kWidth + lane] = parts[i]->y[0];
        pose[(3 * i + 2) * kWidth + lane] = parts[i]->z[0];
    }
}

PatchSize measure_patch(const PatchKind& kind, const PatchHeights& heights, const Matrix3& leader, const Matrix3& follower,
                        const Vector3& offset) {
    const PatchSizes sizes = make_sizes(kind, heights);
    const FacePose pose = make_pose(kind, sizes, leader, follower, offset);
    const Cover cover = find_cover(kind, sizes, pose);
    return {2.0 * cover.half_p[0], 2.0 * cover.half_q[0], highest(find_overlap(kind, sizes, cover, pose))[0]};
}

PatchLoad find_load(const PatchList& patches, std::size_t group_index, std::size_t lane) {
    const PatchGroup& group = patches.groups[group_index];
    const PatchKind& kind = patches.kinds[group.kind];
    const PatchView patch(patches, group_index, lane);
    const PatchLattice& lattice = patch.lattice();
    const double stiffness = kind.law.shear_stiffness, area = StoredPose(kind, group, patches.field(group_index, 0)).area(lane);
    PatchLoad load;
    load.energy = patch.field(patch_field::elastic_normal);
    for (std::size_t i = 0; i < lattice.size(); ++i) {
        const double u = stiffness * patch.slip_u(i), v = stiffness * patch.slip_v(i);
        load.friction_u -= area * lattice.w[i] * u;
        load.friction_v -= area * lattice.w[i] * v;
        load.traction_u.push_back(u);
        load.traction_v.push_back(v);
    }
    return load;
}

void inherit_load(PatchList& patches, std::size_t group_index, std::size_t lane, const PatchLoad& load_before) {
    const double energy = load_before.energy;
    const PatchGroup& group = patches.groups[group_index];
    const PatchKind& kind = patches.kinds[group.kind];
    const PatchLattice& lattice = patches.lattices[kind.lattice];
    const PatchSizes sizes(kind, load(group.leader_offset.data()), load(group.follower_offset.data()));
    const State state{patches.field(group_index, 0)};
    const StoredPose stored_pose(kind, group, state.at);
    const Affine overlap = find_overlap(kind, sizes, stored_pose.cover, stored_pose.face);
    const double deepest = highest(overlap)[lane];
    if (!(deepest > 0.0) || stored_pose.cover.exists[lane] == 0) return;

    const double area = stored_pose.area(lane);
    const auto depth = [&](std::size_t i, double late) {
        return overlap.at[lane] + overlap.s[lane] * lattice.s[i] + overlap.t[lane] * lattice.t[i] - late;
    };
    const auto stored = [&](double late) {
        double sum = 0.0;
        for (std::size_t i = 0; i < lattice.size(); ++i) {
            const double d = std::max(0.0, depth(i, late));
            sum += lattice.w[i] * d * d;
        }
        return 0.5 * area * kind.law.normal_stiffness * sum;
    };
    double late = 0.0;
    if (stored(0.0) > energy) {
        double low = 0.0, high = deepest;
        for (int i = 0; i < kLateHalvings; ++i) {
            const double middle = 0.5 * (low + high);
            (stored(middle) > energy ? low : high) = middle;
        }
        late = high;
    }
    const auto set = [&](std::size_t field, double value) { state.at[field * kWidth + lane] = value; };
    set(patch_field::elastic_normal, stored(late));
    set(patch_field::late, late);
    set(patch_field::seen, overlap.at[lane] - late);
    set(patch_field::seen_s, overlap.s[lane]);
    set(patch_field::seen_t, overlap.t[lane]);

    double touching = 0.0, weight = 0.0;
    for (std::size_t i = 0; i < lattice.size(); ++i) {
        if (!(depth(i, late) > 0.0)) continue;
        touching += 1.0;
        weight += lattice.w[i];
    }
    set(patch_field::touching, touching);

    const double per_stiffness = kind.law.shear_stiffness > 0.0 ? 1.0 / kind.law.shear_stiffness : 0.0;
    const double per_area = area * weight > 0.0 ? 1.0 / (area * weight) : 0.0;
    const bool by_node = load_before.traction_u.size() == lattice.size() && load_before.traction_v.size() == lattice.size();
    std::array<double, 7> own{};  // Σ w (1, s, t) ξ along u and v, Σ w |ξ|²
    const std::size_t first = group.first_slot + lane * lattice.w.size();
    for (std::size_t i = 0; i < lattice.size(); ++i) {
        const bool touches = depth(i, late) > 0.0;
        const double traction_u = by_node ? load_before.traction_u[i] : -load_before.friction_u * per_area,
                     traction_v = by_node ? load_before.traction_v[i] : -load_before.friction_v * per_area;
        const double u = touches ? per_stiffness * traction_u : 0.0, v = touches ? per_stiffness * traction_v : 0.0;
        patches.slip_u[first + i] = u, patches.slip_v[first + i] = v;
        const double w = lattice.w[i], ws = lattice.ws[i], wt = lattice.wt[i];
        const std::array<double, 7> share{w * u, ws * u, wt * u, w * v, ws * v, wt * v, w * (u * u + v * v)};
        for (std::size_t k = 0; k < own.size(); ++k) own[k] += share[k];
    }
    static_assert(patch_field::own_squared == patch_field::own_u + 6);
    for (std::size_t k = 0; k < own.size(); ++k) set(patch_field::own_u + k, own[k]);
    for (std::size_t field = patch_field::slip_u; field <= patch_field::slip_vt; ++field) set(field, 0.0);
    set(patch_field::elastic_shear, 0.5 * area * kind.law.shear_stiffness * own.back());
    set(patch_field::slack, -1.0);
}

}  // namespace musim::lsdem::detail
