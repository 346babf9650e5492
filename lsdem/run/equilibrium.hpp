#pragma once

#include <cstddef>

#include "lsdem/run/simulate.hpp"

namespace musim::lsdem {

/// Nearness of a structure to equilibrium.
struct Equilibrium {
    std::size_t solves = 0;  ///< of the linear system
    /// The largest force, and torque over half the height of a block, that is left on a block, over its weight [-].
    double residual = 0.0;
};

/// Puts the blocks of a structure that stands as drawn where their contacts bear them: the equilibrium of the elastic contact law from zero
/// slip, by Newton's method on the sparse stiffness of all contacts (normal and shear springs over the areas that touch),
///
///     K Δu = w + f(u),      u ← u + Δu,      friction ← friction − K_s S Δξ,      u: shift and turn of every block
///
/// f: forces and torques of the contacts themselves, so the end is exact whatever K is. The first contacts are those between faces
/// that meet as drawn, of boxes the upper and lower ones (across body z). See docs/theory/preparation.md, "Equilibrium".
///
/// Nothing is changed, and `residual` says by how much it failed, where the structure has no such equilibrium nearby: contacts by nodes,
/// blocks that do not stand on others, friction that would have to be more than it can; or only one in which something bears that a gap
/// kept apart as drawn.
Equilibrium put_in_equilibrium(Specimen& specimen, double time_step, int threads = 1);

/// Gap of faces that are tried as meeting at first, over the height of the block below, of a block on the ground half of it [-]: boxes are
/// made taller by so much, other solids larger. A power of two, about what contacts overlap; with a wider one blocks that do not touch
/// would be called so.
inline constexpr double kEquilibriumGap = 0x1p-20;

/// A residual with which a structure counts as in equilibrium [-]. Rounding of positions leaves ε L/d of it, L a coordinate and d the
/// overlap: 2e-9 in a tower 160 m high.
inline constexpr double kInEquilibrium = 1e-6;

}  // namespace musim::lsdem
