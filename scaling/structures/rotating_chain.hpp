#pragma once

#include <array>

namespace musim::scaling {

/// A column of equal blocks on face springs whose blocks shift and turn in one vertical plane: a Timoshenko beam made of blocks.
///
/// Block j has the shift u_j and the rotation θ_j. For a wave e^{i q j} the face springs store, per block,
///
///   ½ k_s |u (e^{iq} − 1) − (H/2) θ (e^{iq} + 1)|²  +  ½ (k_n b²/12) |θ (e^{iq} − 1)|²,
///
/// the second being a bed of normal springs over the width b. With masses m and I = m (b² + H²)/12 this has two branches of waves. In units
/// of √(k_s/m) and H√(k_s/m) = c_e they depend on b/H and k_n/k_s alone, so all results are plain numbers. q is the phase from block to
/// block, in (0, π]; 2π/q blocks are one wave. Long waves bend: ω → (q²/√12)(b/H)√(k_n/k_s), without a speed of their own. Weight and
/// partial uplift, which soften the faces, are left out. Source: derived.
struct RotatingChain {
    double slenderness = 0.0;      ///< b/H, above zero [-]
    double stiffness_ratio = 0.0;  ///< k_n/k_s of a face, above zero [-]

    /// ω/√(k_s/m) of both branches, the lower one first: bending and shear, rotation of each block against its neighbours.
    std::array<double, 2> frequencies(double wavenumber) const;

    /// Group speed of the lower branch over c_e: H dω/dq. q below π.
    double group_speed(double wavenumber) const;
};

/// A wave of a chain: its phase from block to block and its speed over c_e.
struct ChainWave {
    double wavenumber = 0.0;  ///< q [rad]
    double speed = 0.0;       ///< over c_e [-]
};

/// The fastest group speed of the lower branch: how quickly sway climbs the column when blocks may turn. Found among kWavenumbers evenly
/// spaced q, then by golden section to a relative 1e-6 of q, which leaves 1e-12 in the
/// speed of a smooth maximum.
ChainWave find_fastest_sway(const RotatingChain& chain);

/// Number of wavenumbers that find_fastest_sway() looks at first [-]. The group speed turns over a few of them; for b/H from 0.05 to 20 and
/// k_n/k_s from 0.1 to 10 four times as many find the same wave (a test).
inline constexpr int kWavenumbers = 512;

}  // namespace musim::scaling
