#pragma once

#include <array>
#include <cstddef>

#include "lsdem/detail/contact_kernel.hpp"
#include "lsdem/detail/lanes.hpp"
#include "lsdem/patches.hpp"

/// Four patches side by side: vectors, quantities that are affine over a patch, and the rectangle in which two faces cover each other.
namespace musim::lsdem::detail {

inline constexpr std::size_t kWidth = PatchGroup::kSize;
static_assert(kWidth == kLanes);

/// The edge of a follower's face is rounded over this part of the spacing of the nodes [-]: the patch shrinks with a continuous slope. With
/// a sharp edge, blocks stacked edge on edge sit on a kink of their own energy and rounding decides which way it pushes. Half of it is the
/// error of a pivot on the follower's edge.
inline constexpr double kPatchBlend = 1.0 / 256.0;

struct LaneVector {
    Lanes x, y, z;
};

[[gnu::always_inline]] inline LaneVector operator+(const LaneVector& a, const LaneVector& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
[[gnu::always_inline]] inline LaneVector operator-(const LaneVector& a, const LaneVector& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
[[gnu::always_inline]] inline LaneVector operator*(const Lanes& f, const LaneVector& v) { return {f * v.x, f * v.y, f * v.z}; }
[[gnu::always_inline]] inline Lanes dot(const LaneVector& a, const LaneVector& b) { return (a.x * b.x + a.y * b.y) + a.z * b.z; }
[[gnu::always_inline]] inline LaneVector cross(const LaneVector& a, const LaneVector& b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
[[gnu::always_inline]] inline Lanes magnitude(const Lanes& v) { return larger(v, -v); }

using LanePointers = std::array<const double*, kWidth>;

[[gnu::always_inline]] inline LaneVector load_vectors(const LanePointers& from, std::size_t offset) {
    const double *a = from[0] + offset, *b = from[1] + offset, *c = from[2] + offset, *d = from[3] + offset;
    return {Lanes{a[0], b[0], c[0], d[0]}, Lanes{a[1], b[1], c[1], d[1]}, Lanes{a[2], b[2], c[2], d[2]}};
}

/// A quantity that is affine over the lattice: at + s·along_s + t·along_t.
struct Affine {
    Lanes at, s, t;
};

/// The affine quantity of one patch, spread over its nodes.
struct NodeAffine {
    Lanes at, s, t;
    [[gnu::always_inline]] NodeAffine(const Affine& all_patches, std::size_t lane)
        : at(all(all_patches.at[lane])), s(all(all_patches.s[lane])), t(all(all_patches.t[lane])) {}
    [[gnu::always_inline]] Lanes operator()(const Lanes& node_s, const Lanes& node_t) const { return (at + s * node_s) + t * node_t; }
};

/// Smallest and largest value over the lattice: those of its corners.
[[gnu::always_inline]] inline Lanes lowest(const Affine& a) { return a.at - (magnitude(a.s) + magnitude(a.t)); }
[[gnu::always_inline]] inline Lanes highest(const Affine& a) { return a.at + (magnitude(a.s) + magnitude(a.t)); }
[[gnu::always_inline]] inline Lanes farthest(const Affine& a) { return magnitude(a.at) + (magnitude(a.s) + magnitude(a.t)); }

/// Σ w·f·(1, s, t) over the nodes.
[[gnu::always_inline]] inline Affine moments(const Affine& a, const PatchLattice& lattice) {
    return {a.at, lattice.second_p * a.s, lattice.second_q * a.t};
}
/// Σ w·f·g from the moments of f.
[[gnu::always_inline]] inline Lanes contract(const Affine& moments_of_f, const Affine& g) {
    return (moments_of_f.at * g.at + moments_of_f.s * g.s) + moments_of_f.t * g.t;
}
[[gnu::always_inline]] inline Affine scaled(const Lanes& f, const Affine& a) { return {f * a.at, f * a.s, f * a.t}; }
[[gnu::always_inline]] inline Affine zero_affine() { return {all(0.0), all(0.0), all(0.0)}; }
[[gnu::always_inline]] inline Affine choose(const LaneMask& mask, const Affine& yes, const Affine& no) {
    return {select(mask, yes.at, no.at), select(mask, yes.s, no.s), select(mask, yes.t, no.t)};
}
[[gnu::always_inline]] inline Affine difference_of(const Affine& a, const Affine& b) { return {a.at - b.at, a.s - b.s, a.t - b.t}; }
[[gnu::always_inline]] inline Affine sum_of(const Affine& a, const Affine& b) { return {a.at + b.at, a.s + b.s, a.t + b.t}; }

/// The lengths of four patches of one kind, each with the heights of its own blocks [m].
struct PatchSizes {
    Lanes face_k, half_u, half_v;  ///< of the follower
    Lanes face_n, half_p, half_q, spacing_p, spacing_q;

    [[gnu::always_inline]] PatchSizes(const PatchKind& kind, const Lanes& leader_offset, const Lanes& follower_offset)
        : face_k(at(kind.face_k, follower_offset)),
          half_u(at(kind.half_u, follower_offset)),
          half_v(at(kind.half_v, follower_offset)),
          face_n(at(kind.face_n, leader_offset)),
          half_p(at(kind.half_p, leader_offset)),
          half_q(at(kind.half_q, leader_offset)),
          spacing_p(at(kind.spacing_p, leader_offset)),
          spacing_q(at(kind.spacing_q, leader_offset)) {}

  private:
    [[gnu::always_inline]] static Lanes at(const PatchLength& length, const Lanes& offset) {
        return length.nominal + length.per_offset * offset;
    }
};

/// The law of four patches of one kind; their dashpots go with the masses of their own blocks.
struct PatchLaw {
    double kn, ks, mu, ks_inverse;  ///< see StepLaw
    Lanes cn, cs;

    [[gnu::always_inline]] PatchLaw(const StepLaw& law, const Lanes& damping)
        : kn(law.kn), ks(law.ks), mu(law.mu), ks_inverse(law.ks_inverse), cn(law.cn * damping), cs(law.cs * damping) {}
};

/// Pose of the leader's face in the follower's frame, axes (k, u, v) = (x, y, z).
struct FacePose {
    LaneVector place, along_p, along_q;
};

[[gnu::always_inline]] inline FacePose minus(const FacePose& a, const FacePose& b) {
    return {a.place - b.place, a.along_p - b.along_p, a.along_q - b.along_q};
}

/// The state of a group in memory.
struct State {
    double* at;
    [[gnu::always_inline]] Lanes get(std::size_t index) const { return load(at + index * kWidth); }
    [[gnu::always_inline]] void set(std::size_t index, const Lanes& value) const { store(value, at + index * kWidth); }
    [[gnu::always_inline]] Affine get_affine(std::size_t index) const { return {get(index), get(index + 1), get(index + 2)}; }
    [[gnu::always_inline]] void set_affine(std::size_t index, const Affine& a) const {
        set(index, a.at), set(index + 1, a.s), set(index + 2, a.t);
    }
    [[gnu::always_inline]] LaneVector get_vector(std::size_t index) const { return {get(index), get(index + 1), get(index + 2)}; }
    [[gnu::always_inline]] void set_vector(std::size_t index, const LaneVector& v) const {
        set(index, v.x), set(index + 1, v.y), set(index + 2, v.z);
    }
};

/// One end pair of a patch, along p or q of the leader [m].
struct Span {
    Lanes low, high;
    /// How much of the end moves with the follower's edge, 0 (the leader's own edge) ... 1.
    Lanes low_follows, high_follows;
};

/// What an edge takes away that reaches `intrusion` into the face: nothing up to the edge, then a ramp of slope one with a rounded start.
struct LaneEdge {
    Lanes lost, slope;
};
[[gnu::always_inline]] inline LaneEdge find_edge(const Lanes& intrusion, const Lanes& blend) {
    const Lanes zero = all(0.0), begun = larger(intrusion, zero);
    const LaneMask rounded = begun < blend;
    const Lanes per_blend = 1.0 / blend;
    return {select(rounded, (0.5 * per_blend) * (begun * begun), begun - 0.5 * blend), select(rounded, per_blend * begun, all(1.0))};
}

[[gnu::always_inline]] inline Span find_span(const Lanes& middle, const Lanes& reach, const Lanes& half, const Lanes& blend) {
    const LaneEdge low = find_edge((middle - reach) + half, blend), high = find_edge(half - (middle + reach), blend);
    return {low.lost - half, half - high.lost, low.slope, high.slope};
}

/// The rectangle in which the two faces cover each other, in the leader's axes.
struct Cover {
    Span p, q;
    Lanes middle_p, middle_q, half_p, half_q;
    LaneMask exists;
};

[[gnu::always_inline]] inline Cover find_cover(const PatchKind& kind, const PatchSizes& sizes, const FacePose& pose) {
    Cover cover;
    const Lanes none = all(0.0);
    if (kind.bounded) {
        // the middle of the follower's face, seen from the leader
        const Lanes up = sizes.face_k - pose.place.x;
        const Lanes at_p = (pose.along_p.x * up - pose.along_p.y * pose.place.y) - pose.along_p.z * pose.place.z;
        const Lanes at_q = (pose.along_q.x * up - pose.along_q.y * pose.place.y) - pose.along_q.z * pose.place.z;
        cover.p = find_span(at_p, sizes.half_u * magnitude(pose.along_p.y), sizes.half_p, kPatchBlend * sizes.spacing_p);
        cover.q = find_span(at_q, sizes.half_v * magnitude(pose.along_q.z), sizes.half_q, kPatchBlend * sizes.spacing_q);
    } else {
        cover.p = {-sizes.half_p, sizes.half_p, none, none};
        cover.q = {-sizes.half_q, sizes.half_q, none, none};
    }
    cover.middle_p = 0.5 * (cover.p.low + cover.p.high);
    cover.middle_q = 0.5 * (cover.q.low + cover.q.high);
    cover.half_p = 0.5 * (cover.p.high - cover.p.low);
    cover.half_q = 0.5 * (cover.q.high - cover.q.low);
    cover.exists = (cover.half_p > none) & (cover.half_q > none);
    return cover;
}

/// One component of an affine map of the leader's face, over the lattice.
[[gnu::always_inline]] inline Affine over_lattice(const Cover& cover, const Lanes& place, const Lanes& along_p, const Lanes& along_q) {
    return {(place + along_p * cover.middle_p) + along_q * cover.middle_q, along_p * cover.half_p, along_q * cover.half_q};
}

/// Depth of the leader's face below the follower's, over the lattice.
[[gnu::always_inline]] inline Affine find_overlap(const PatchKind& kind, const PatchSizes& sizes, const Cover& cover,
                                                  const FacePose& pose) {
    const double side = kind.side;
    Affine overlap = over_lattice(cover, side * (sizes.face_k - pose.place.x), -side * pose.along_p.x, -side * pose.along_q.x);
    // faces beside each other do not touch
    overlap.at = select(cover.exists, overlap.at, -(magnitude(overlap.s) + magnitude(overlap.t)));
    return overlap;
}

/// What moves at the nodes in this step, and where they are.
struct PatchMotion {
    Affine overlap;           ///< less what was noticed late [m]
    Affine opening;           ///< displacement along the follower's normal over the step [m]
    Affine slide_u, slide_v;  ///< tangential displacement over the step [m]
};

/// K_n d − C_n δ_n/dt over the lattice, clamped nowhere [Pa].
[[gnu::always_inline]] inline Affine pressure_of(const PatchLaw& law, const PatchMotion& motion) {
    return {law.kn * motion.overlap.at - law.cn * motion.opening.at, law.kn * motion.overlap.s - law.cn * motion.opening.s,
            law.kn * motion.overlap.t - law.cn * motion.opening.t};
}

}  // namespace musim::lsdem::detail
