#pragma once

#include <array>
#include <cstddef>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "lsdem/results/base_frame.hpp"
#include "lsdem/results/damage.hpp"
#include "lsdem/results/history.hpp"
#include "scaling/laws/similitude.hpp"

namespace musim::lsdem {

/// A largest value, and the block that has it.
struct LargestAt {
    double value = 0.0;
    std::size_t block = 0;
    int level = 0;          ///< of the block, from 1 at the base; 0: in none
    std::string name = {};  ///< of a listed block that has one
};

/// A top moves at the end that is faster than this part of its largest velocity, both horizontal and relative to the base [-]. A choice.
inline constexpr double kStillMoving = 0.01;

/// Outcome of a run, in the numbers that a laboratory asks for first. SI units of the run; peaks are those at the samples. Slip and
/// rotation are of blocks that stand (has_fallen): a fallen block has left its place. All but the motion of the base is seen from the base.
struct Outcome {
    int axis = 0;                       ///< 0, 1, 2: along which the base moves most
    Vector3 pga = Vector3::Zero();      ///< absolute, see RunResult::peak_base_acceleration [m/s²]
    BaseChanges base_changes;           ///< of the base's motion against what it was made from
    Vector3 pgv = Vector3::Zero();      ///< likewise of the velocity [m/s]
    std::optional<BaseTurn> base_turn;  ///< nothing of a base that does not turn
    bool shaken = true;                 ///< false: blocks fell while the structure was prepared, so the motion was not run
    int top_level = 0;                  ///< of the highest spine block; 0: the run has no spine
    std::string top_name;               ///< of that block when it is a listed one, see BlockTable::label; else empty
    double top_peak = 0.0;              ///< its largest horizontal displacement relative to the base [m]
    double top_residual = 0.0;          ///< likewise at the end [m]
    double top_speed = 0.0;             ///< its horizontal velocity relative to the base at the end [m/s]
    bool top_moves = false;             ///< then, by more than kStillMoving: what is called residual is none yet
    double drift = 0.0;   ///< largest |Δu|/Δz, horizontal, between spine blocks above one another or one and the base, see DriftPair [-]
    int drift_level = 0;  ///< of the upper block of the two
    std::string drift_name;  ///< of that block, as top_name
    std::optional<LargestAt> slip,
        rotation;  ///< at the end: horizontal on what carries it [m]; from the start [rad]; nothing when none stands
    std::size_t blocks = 0, fallen = 0;
};

Outcome find_outcome(const RunResult& run);

/// The outcome in the units of a prototype that the run is a model of.
Outcome scale_back(Outcome outcome, const scaling::Similitude& similitude);

/// Sentences with units: base motion, top, slip and rotation, fallen blocks.
std::vector<std::string> describe(const Outcome& outcome);

/// pga_g, base_changes, pgv_m_s (lists along x, y, z), axis, shaken, top (level, peak_displacement_m, residual_displacement_m,
/// speed_at_end_m_s, moves_at_end), drift (value, level), largest_slip and largest_rotation (m or deg, block, level; null when no block
/// stands), fallen, blocks; of a base that turns, base_turn (largest_deg, at_end_deg, largest_rate_deg_s). Of listed blocks, top, drift and
/// the largest have a name as well.
nlohmann::json to_json(const Outcome& outcome);

}  // namespace musim::lsdem
