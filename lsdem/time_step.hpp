#pragma once

#include <optional>

#include "lsdem/model.hpp"

namespace musim::lsdem {

/// Largest stable time step of the leapfrog scheme with lagged damping [s], from the stiffest mode the model's own blocks can have.
///
/// A mode of mass m, stiffness k and damping c is stable while  k·dt²/(4m) + c·dt/(2m) < 1.  Since |u_a − u_b|² ≤ 2|u_a|² + 2|u_b|², no
/// mode of the assembly exceeds the largest eigenvalue over single blocks of  2·M⁻¹(K·dt²/4 + C·dt/2),  K and C (6 x 6) those of the
/// block's two faces across the axis that stands most upright at the start, with everything else held; the factor 2 drops out against the
/// ground and against fixed blocks. For a chain this is the exact limit; it counts normal and shear springs, rocking and their coupling.
/// Of blocks that differ in height only (Block::height_offset) the shortest and the tallest are looked at: what lies between is no
/// stiffer by more than (4σ_H/H)²/2, and only where the heights straddle a width.
/// Frequencies: similitude of the tower, docs/theory/integration.md. Throws std::invalid_argument when the model has no moving block or a
/// stiffness is not positive.
double compute_critical_time_step(const Model& model);

/// The same; nothing for a model that has no critical step, such as one without moving blocks.
std::optional<double> find_critical_time_step(const Model& model);

}  // namespace musim::lsdem
