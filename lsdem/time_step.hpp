#pragma once

#include <optional>

#include "lsdem/model.hpp"

namespace musim::lsdem {

/// Largest stable time step of the leapfrog scheme with lagged damping [s], from the stiffest mode the model's own blocks can have.
///
/// A mode of mass m, stiffness k and damping c is stable while  k·dt²/(4m) + c·dt/(2m) < 1.  Since |u_a − u_b|² ≤ 2|u_a|² + 2|u_b|², no
/// mode of the assembly exceeds the largest eigenvalue over single blocks of  2·M⁻¹(K·dt²/4 + C·dt/2),  K and C (6 x 6) those of the
/// block's two faces across the axis that stands most upright at the start (of other solids: of any side that may bear
/// before a block leaves its place, see find_facing_sides, and the one that faces away from it, each with the faces within 15°), with
/// everything else held; the factor 2 drops out against the
/// ground and against fixed blocks. For a chain this is the exact limit; it counts normal and shear springs, rocking and their coupling.
/// An actuator (Load) adds its spring and dashpot to its block's.
/// Blocks that differ in height only (Block::height_offset) count by the shortest and the tallest: what lies between is no
/// stiffer by more than (4σ_H/H)²/2, and only where the heights straddle a width.
/// Frequencies: similitude of the tower, docs/theory/integration.md. Throws std::invalid_argument when the model has no moving block or a
/// stiffness is not positive.
double compute_critical_time_step(const Model& model);

/// The same; nothing for a model that has no critical step, such as one without moving blocks.
std::optional<double> find_critical_time_step(const Model& model);

/// Number of times that a step is halved once a block has left its place (see Leaving): from then on its largest faces may land, on the
/// ground or on another block. Pure numbers of the model decide, so that it is the same at every scale, whatever the step:
///
///   2^halvings ≥ max(limit/(0.95·limit'), 0.8·limit·ω/φ),      φ = min(0.19 √r, 4ζ + sqrt(16ζ² + 0.0032 r)),      r = sqrt(N/2)
///
/// limit: compute_critical_time_step; limit': the same for faces across any axis; ω² = K_n·A/m, largest of all faces; ζ: the least damping
/// ratio; N: moving blocks, two at least. The first keeps what lies stable; the second keeps what a face that lands flat leaves open of the
/// balance of energy, (ωh)²/4, below 1e-2, and what parting within a step adds, (ωh)²/4 − 2ζωh, below 1e-3, of one or two blocks; of many,
/// whose errors are random, as a part of the energy of all (docs/theory/integration.md). Zero for a model of round bodies, and for one
/// without a critical step.
int compute_landing_halvings(const Model& model);

}  // namespace musim::lsdem
