#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "lsdem/contact_law.hpp"
#include "lsdem/shape.hpp"

namespace musim::lsdem {

/// Blocks whose faces meet within this angle of each other, as sin(tilt), form a patch; what meets at a larger angle, by the polygon
/// that the faces share (detail/tilted_kernel.hpp). Towers shake, rock and overturn well inside it.
inline constexpr double kMaxPatchTilt = 0.5;
/// The same for a turn about the normal, to the nearest quarter turn: the sides of the two faces count as parallel.
inline constexpr double kMaxPatchYaw = 0.2;
/// And a bound on tilt times turn: the corners of the rectangle lie beside those of the true overlap by half an edge times the turn, so
/// that their depth is off by half an edge times this.
inline constexpr double kMaxPatchTwist = 1e-3;

/// Nodes of a contact patch: n_p x n_q points on [−1, 1]², edges and corners included, with weights whose sum is one.
///
/// The weights of inner nodes are equal; those of the edges make Σ w s² = 1/3 from three nodes on, so that a patch in full contact has the
/// area, and the rocking and twisting stiffness, of the continuous face, whatever the number of nodes. (Three nodes: Simpson's rule; four:
/// the 3/8 rule. The trapezoidal rule would be too stiff by 1 + 2/(n − 1)².) Gauss-Lobatto places have the weights of that quadrature,
/// which meet the same two conditions from three nodes on.
struct PatchLattice {
    PatchSpacing spacing = PatchSpacing::even;
    int count_p = 0, count_q = 0;
    double second_p = 0.0, second_q = 0.0;  ///< Σ w s², Σ w t² [-]
    std::vector<double> s, t, w, ws, wt;    ///< position and weight of every node, filled up with zeros to a multiple of four
    std::size_t size() const { return static_cast<std::size_t>(count_p) * static_cast<std::size_t>(count_q); }
};

/// `count_p`, `count_q` ≥ 2 nodes along the two axes.
PatchLattice make_patch_lattice(int count_p, int count_q, PatchSpacing spacing = PatchSpacing::even);

/// A length of one block of a patch: that of its shape, and what a metre adds by which the block is taller than its shape.
struct PatchLength {
    double nominal = 0.0;     ///< [m]
    double per_offset = 0.0;  ///< 0 along body x and y; along z ±1/2 for half a height [-]

    bool operator==(const PatchLength&) const = default;
};

/// What many patches have in common: which faces meet, their sizes and the contact law. Blocks that differ in height only share it. Axes:
/// k, u, v of the follower (k along the normal, cyclic), n, p, q of the leader (n along the normal, p beside u, q beside v).
struct PatchKind {
    std::uint8_t k = 2, u = 0, v = 1, n = 2, p = 0, q = 1;
    bool bounded = true;                        ///< a face with edges; the ground has none
    bool viscous = false;                       ///< the law has a tangential dashpot
    double side = 1.0;                          ///< outward normal of the follower's face = side·e_k
    PatchLength face_k;                         ///< place of the follower's face along e_k, side·h_k
    PatchLength half_u, half_v;                 ///< half extents of the follower's face
    PatchLength face_n;                         ///< place of the leader's face along e_n
    PatchLength half_p, half_q;                 ///< half extents of the leader's face
    PatchLength spacing_p, spacing_q;           ///< of the leader's nodes
    double height = 0.0;                        ///< of the leader's shape, for reporting the overlap [m]
    PatchSpacing spacing = PatchSpacing::even;  ///< of the nodes of the patch
    std::uint32_t lattice = 0;                  ///< into PatchList::lattices
    Interface law;                              ///< of blocks of their shapes' heights

    bool operator==(const PatchKind&) const = default;
};

/// What the heights of its two blocks make of one patch of a kind.
struct PatchHeights {
    double leader = 0.0, follower = 0.0;  ///< Δ of each, zero of the ground [m]
    double damping = 1.0;                 ///< factor of the kind's dashpots, sqrt(m_eff/m_eff of the kind) [-]
};

/// Four patches of one kind, computed side by side.
struct PatchGroup {
    static constexpr std::size_t kSize = 4;
    std::uint32_t kind = 0;
    std::uint32_t count = 0;                  ///< patches in use; the other lanes repeat the first
    std::array<std::uint32_t, kSize> pair{};  ///< into ContactList::pairs
    std::array<std::uint32_t, kSize> leader{}, follower{};
    std::array<double, kSize> leader_offset{}, follower_offset{};  ///< see PatchHeights [m]
    std::array<double, kSize> damping{1.0, 1.0, 1.0, 1.0};         ///< likewise [-]
    std::uint32_t first_slot = 0;  ///< of the first patch, into slip_u and slip_v; each has lattice.t.size() of them
};

/// What a patch remembers, one number per patch, four patches side by side.
namespace patch_field {
enum Index : std::size_t {
    // where the leader's face was: y = place + p·along_p + q·along_q, follower's axes k, u, v
    place_k,
    place_u,
    place_v,
    along_pk,
    along_pu,
    along_pv,
    along_qk,
    along_qu,
    along_qv,
    // slip of all nodes since their own slips were last written: affine over the lattice, along u and v [m]
    slip_u,
    slip_us,
    slip_ut,
    slip_v,
    slip_vs,
    slip_vt,
    // the nodes' own slips: Σ wξ, Σ wsξ, Σ wtξ along u and v, and Σ w|ξ|²
    own_u,
    own_us,
    own_ut,
    own_v,
    own_vs,
    own_vt,
    own_squared,
    // pressure when the own slips were written, affine over the lattice [Pa], and how far every node was from sliding; negative: unknown;
    // zero: of a patch that touches with some of its nodes, which are not noted yet
    pressure,
    pressure_s,
    pressure_t,
    slack,
    dashpot,
    dashpot_s,
    dashpot_t,  ///< normal dashpot, sums over the nodes [N]
    late,       ///< overlap when the contact was noticed, carries no force [m]
    elastic_normal,
    elastic_shear,
    touching,
    damping_loss,
    friction_loss,  ///< since the list was built [J]
    // sums of the tangential dashpot over the nodes [N]
    drag_u,
    drag_us,
    drag_ut,
    drag_v,
    drag_vs,
    drag_vt,
    // overlap when the nodes were last looked at, affine over the lattice: those touched where it is above zero [m]
    seen,
    seen_s,
    seen_t,
    // of a patch that touches with some of its nodes, at that look: how far the nearest open node was from touching, and the nearest
    // touching one from parting [m]; the box on the lattice that holds those that touch; their sums Σ w (1, s, t, s², st, t²)
    gap,
    hold,
    box_s,
    box_t,
    box_half_s,
    box_half_t,
    touching_w,
    touching_ws,
    touching_wt,
    touching_wss,
    touching_wst,
    touching_wtt,
    count
};
}  // namespace patch_field

/// All patches. A patch is the rectangle in which a face of the leader and a face of the follower cover each other; see lsdem/README.md.
struct PatchList {
    std::vector<PatchLattice> lattices;
    std::vector<PatchKind> kinds;
    std::vector<PatchGroup> groups;
    std::vector<double> state;           ///< [group][field][lane]
    std::vector<std::uint32_t> due;      ///< room for one entry per group: those that a step has to look at, per thread
    std::vector<double> next_look;       ///< [group][lane], see kTrustedGap; zero: in the next step [m]
    std::vector<double> slip_u, slip_v;  ///< own slips of the nodes along the follower's u and v [m]

    double* field(std::size_t group, std::size_t index) { return &state[(group * patch_field::count + index) * PatchGroup::kSize]; }
    const double* field(std::size_t group, std::size_t index) const {
        return &state[(group * patch_field::count + index) * PatchGroup::kSize];
    }
    std::size_t slots(const PatchGroup& group) const { return lattices[kinds[group.kind].lattice].w.size(); }

    void clear();
    /// Index of the lattice, made on first use.
    std::uint32_t find_lattice(int count_p, int count_q, PatchSpacing spacing);
    /// Index of the kind, added on first use.
    std::uint32_t find_kind(const PatchKind& kind);
};

/// One patch of a list as it is between steps.
class PatchView {
  public:
    PatchView(const PatchList& patches, std::size_t group, std::size_t lane);

    const PatchLattice& lattice() const { return lattice_; }
    double field(std::size_t index) const { return patches_.field(group_, index)[lane_]; }
    bool all_touched() const { return field(patch_field::touching) == static_cast<double>(lattice_.size()); }
    /// Did a node at this place of the lattice touch when the nodes were last looked at?
    bool touched(double s, double t) const { return all_touched() || affine(patch_field::seen, s, t) > 0.0; }
    /// ξ of a node along the follower's u and v [m]: its own, and what has been common since to those that touched.
    double slip_u(std::size_t node) const { return patches_.slip_u[first_ + node] + common(patch_field::slip_u, node); }
    double slip_v(std::size_t node) const { return patches_.slip_v[first_ + node] + common(patch_field::slip_v, node); }

  private:
    /// An affine function over the lattice, of which three fields tell.
    double affine(std::size_t first, double s, double t) const { return (field(first) + s * field(first + 1)) + t * field(first + 2); }
    double common(std::size_t slip, std::size_t node) const {
        const double s = lattice_.s[node], t = lattice_.t[node];
        return touched(s, t) ? affine(slip, s, t) : 0.0;
    }

    const PatchList& patches_;
    std::size_t group_, lane_;
    const PatchLattice& lattice_;
    std::size_t first_;  ///< of its nodes' own slips
};

}  // namespace musim::lsdem
