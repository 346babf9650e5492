#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "lsdem/results/history.hpp"

/// Failure of a structure, found from the way its blocks moved.
namespace musim::lsdem {

/// Failure modes of towers [Harmon23, section 6, Fig. 9].
enum class FailureMode {
    peeling,   ///< a section rocks outward, and the tower follows: blocks fall outward
    buckling,  ///< the tower bulges at mid-height, and what is above comes down and inward
    undecided  ///< neither clearly, or both
};

/// "peeling", "buckling" or "undecided".
std::string to_string(FailureMode mode);

/// Part of the blocks that decides a mode [-]. Two in three, so that twice as many blocks say yes as no.
inline constexpr double kFailureMajority = 2.0 / 3.0;

/// A level whose centre lies within this part of the height from either end of the tower is not at mid-height [-].
inline constexpr double kEndOfTower = 0.1;

/// Least widening that counts as a bulge [thin sides of a block]: a tenth is more than joints and rocking give to a whole level.
inline constexpr double kLeastBulge = 0.1;

/// Measures that decide the modes, all without dimension. With e the horizontal unit vector from the tower's axis (through its centre of
/// mass at the start) to a block's place at the start, and d the block's displacement seen from the base,
///
///   u = e·d (outward),   w = −d_z (down),   b the shorter horizontal side of the block;
///
/// a block *went outward* if u > w and u > b/2 at the first sample at which it had fallen, *down or inward* if u ≤ w then. Shares are by
/// mass, of fallen blocks; blocks less than b away from the axis have no outward and are left out.
struct FailureMeasures {
    std::size_t fallen = 0;           ///< blocks that fell before the run ended
    double outward_share = 0.0;       ///< of all that fell
    double bulge = 0.0;               ///< largest mean of u/b over a level, when the collapse is dated
    double bulge_height = 0.0;        ///< where that level was at the start: 0 for the lowest level, 1 for the highest
    double inward_share_above = 0.0;  ///< of the blocks that fell from above that level: part that went down or inward
};

struct Failure {
    FailureMode mode = FailureMode::undecided;
    double time = 0.0;  ///< of the collapse [s]
    FailureMeasures measures;
    std::string why;             ///< when undecided
    bool surrounds_axis = true;  ///< false for columns, walls, single blocks: then only the number of fallen blocks is measured
};

/// One line: mode and measures; of a structure that does not surround an axis, that it collapsed and by how many blocks.
std::string describe(const Failure& failure);

/// Data to judge by.
struct FailureData {
    const BlockTable& blocks;
    const std::vector<Vector3>& start;  ///< where the blocks stood, see Falls [m]
    const Falls& falls;
    double collapse_time;  ///< [s]
};

/// Finds the mode of a collapse.
///
///   peeling:   outward_share ≥ 2/3
///   buckling:  inward_share_above ≥ 2/3, bulge ≥ 0.1, and its level at mid-height (from 0.1 to 0.9)
///
/// Undecided when both hold or neither does, and for structures that do not surround their axis (columns, walls), which have no outward.
/// Describes [Harmon23]'s modes, who judge them by eye; the numbers are ours.
Failure find_failure(const FailureData& data);

/// The same for a run or a stored run; nothing when it did not collapse, did so before it was shaken, or when the results do
/// not say when blocks fell. Of a later stage
/// of a sequence: from the start of the first stage on, since what the stages before have bulged or lost belongs to the failure.
template <class Run>
std::optional<Failure> find_failure(const Run& run) {
    if (!run.collapse_time || run.collapsed_before() || run.falls.at_collapse.size() != run.blocks.mass.size()) return std::nullopt;
    return find_failure(FailureData{run.blocks, run.standing_position(), run.falls, *run.collapse_time});
}

}  // namespace musim::lsdem
