#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "lsdem/scene/resting_pose.hpp"
#include "lsdem/types.hpp"

namespace musim::lsdem {

/// Body that a block rests on where it is drawn.
struct Carrier {
    std::optional<std::size_t> block;   ///< nothing: the ground
    double gap = 0.0;                   ///< how far the block has to sink until the two meet [m]
    Vector3 meeting = Vector3::Zero();  ///< middle of the joint, on the block's lower side, world frame [m]
};

/// Part of the smaller of two blocks' smallest edges by which a block that is let down runs into what carries it, at least [-]. Blocks side
/// by side touch and carry nothing.
inline constexpr double kLeastBearing = 0.01;

/// Carriers of every block: the blocks with lower centres, and the ground (the plane z = 0, where there is one), which a block runs into
/// when it is let down by kFallenDrop of its height. So a block that has none can sink further than blocks sink that stand: it is in the
/// air. Any orientation; depends on ratios of lengths only.
std::vector<std::vector<Carrier>> find_carriers(const std::vector<BoxPose>& boxes, bool ground);

}  // namespace musim::lsdem
