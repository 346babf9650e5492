#pragma once

#include <optional>

#include "lsdem/results/history.hpp"
#include "scaling/laws/similitude.hpp"

namespace musim::lsdem {

/// Difference [fraction of the block's peak velocity] at which two chaotic runs count as parted: three digits, the resolution of a good
/// measurement. Changes what is reported, not the verdict.
inline constexpr double kPartingLevel = 1e-3;

/// Difference of a model's run, scaled back, from its prototype's.
struct RunDifference {
    /// √(Σ_t |v_M/λ_v − v_P|² / Σ_t |v_P|²) of the spine block where it is largest, v_M at t/λ_t [-].
    double rms_velocity = 0.0;
    /// max_t |v_M/λ_v − v_P| / max_t |v_P| of the spine block where it is largest [-].
    double max_velocity = 0.0;
    /// max over levels of |W_M/λ_E − W_P| over all that the prototype dissipated, W: of friction and dashpots in the interfaces that the
    /// blocks of a level lead, and at the ground [-]. Nothing when the prototype dissipated nothing.
    std::optional<double> losses = {};
    /// Times, base and spine motion, energies, losses interface by interface and the final state of all blocks agree in every bit.
    bool bitwise_identical = false;

    /// Decimal digits that rms_velocity leaves in agreement, at most the 16 of a double.
    int digits() const;
};

/// Compares two runs sample by sample; both must sample at the same dimensionless times, as runs of similar TimePlans do. A run that ended
/// early is compared up to its end. A spine block that never moves in the prototype is measured against the liveliest block instead. Losses
/// are those at the end of each.
///
/// Throws std::invalid_argument when the runs have spines of different length, or losses of other blocks.
RunDifference compare_runs(const RunResult& prototype, const RunResult& model, const scaling::Similitude& similitude);

}  // namespace musim::lsdem
