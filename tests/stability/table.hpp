#pragma once

#include <limits>
#include <string>

#include "tests/stability/observe.hpp"

namespace musim::lsdem::tests {

/// Demands that a stressed run must keep to; what a case does not ask for is not limited.
struct Demands {
    static constexpr double kAny = std::numeric_limits<double>::infinity();
    double closure = kAny;  ///< most that the energy balance may be open
    double gain = kAny;     ///< most that the mechanical energy may rise by itself
    double drift = kAny;    ///< most that a block may move in the last quarter, in smallest edges
    double kinetic = kAny;  ///< most kinetic energy at the end, of the energy in play
    double overlap = kAny;  ///< deepest overlap, in smallest edges
};

/// Depth that may go unreported where blocks are probed by nodes [smallest edges]: what a corner sinks in between two nodes of a coarse
/// face before a cell notices.
inline constexpr double kUnreportedBetweenNodes = 0.05;

/// Where boxes meet by their overlap the depth of its deepest point below the nearest face is reported, and the shortest way to part the
/// boxes is measured. They are the same where a corner or a face sinks in. Two edges that cross at the depth δ, whose common normal stands
/// at β in one of the corners they make, reach δ/(sin β + cos β) below its faces: the way is √2 times the depth at most. No point is deeper
/// than half of the smallest edge, however far boxes have gone through each other.
inline constexpr double kWayOverDepth = 1.41422;
inline constexpr double kDeepest = 0.5;  ///< [smallest edges]

/// Checks that the run did not diverge, that it keeps to the demands and that no overlap went unreported; notes the row.
void check_sound(const std::string& name, const Observation& seen, const Demands& demands);

/// Checks that the run was stopped, with a block and a time that make sense; notes the row.
void check_detected(const std::string& name, const Model& model, const Observation& seen);

/// Either of the two: above the limit a run may happen to be stable, but it must not go wrong silently.
void check_sound_or_detected(const std::string& name, const Model& model, const Observation& seen, const Demands& demands);

}  // namespace musim::lsdem::tests
