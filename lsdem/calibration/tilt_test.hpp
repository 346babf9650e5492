#pragma once

#include <string>

#include "lsdem/calibration/block_sample.hpp"

/// Friction from an incline that is tilted until the block on it moves [Harmon23, 4.3].
namespace musim::lsdem {

/// Support that the block stands on.
enum class TiltSupport { ground, block };

/// Pose of the block: on its largest face, so that it cannot topple before it slips, or upright.
enum class TiltPose { lying, upright };

/// Which way is downhill: along the side w, or across it: along H of a lying block, along b of an upright one.
enum class TiltSide { wide, other };

/// First event of the block.
enum class TiltEvent { slips, topples };

std::string to_string(TiltSupport support);
std::string to_string(TiltPose pose);
std::string to_string(TiltEvent event);

struct TiltCase {
    TiltSupport support = TiltSupport::ground;
    TiltPose pose = TiltPose::lying;
    TiltSide side = TiltSide::wide;
};

/// Where the block begins to move.
struct TiltResult {
    TiltEvent event = TiltEvent::slips;
    double low = 0.0;            ///< steepest angle at which it rested [rad]
    double high = 0.0;           ///< flattest angle at which it moved [rad]
    double expected_slip = 0.0;  ///< atan μ [rad]
    double expected_fall = 0.0;  ///< atan(edge of the base along the slope/height), of a rigid block [rad]
    /// The same on the springs of its base: tan = (b − a)/H, a³ = 6 H N/(K_n w) the length on which it bears at last, for a ≪ b [rad].
    double expected_fall_on_springs = 0.0;

    double angle() const { return 0.5 * (low + high); }  ///< [rad]
    double friction() const;                             ///< tan(angle), what a laboratory would report when the block slipped [-]
};

/// Halves the interval from 0 to 90° until it is narrower than `resolution` [rad]. Every angle is a run of its own: gravity turned by the
/// angle, the block placed in contact, carried from t = 0, contacts and, in the first quarter, velocities damped strongly so that letting
/// go stands for tilting slowly.
///
/// *Slip*: the block gains speed; in the last quarter of the run its lower edge moves farther than in the one before by more than a stuck
/// block can swing on its shear springs, μN/k_s, of the least base on which it can stand. The run is long enough for a block that is
/// `resolution` above its angle to gain twice that. (The distance alone would not do: the start pushes a block just below its angle into a
/// slide that takes long to stop.) *Toppling*: its centre of mass is past its lower edge. That happens on the springs of the base, which
/// give way under the edge: earlier than of a rigid block, see TiltResult::expected_fall_on_springs.
/// Throws std::invalid_argument for a resolution outside (0, 0.1] rad and a sample that make_model refuses.
TiltResult run_tilt_test(const BlockSample& sample, const TiltCase& test, double resolution);

}  // namespace musim::lsdem
