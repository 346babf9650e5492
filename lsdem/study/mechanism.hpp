#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "lsdem/results/history.hpp"
#include "lsdem/statics/rigid_joints.hpp"
#include "lsdem/types.hpp"

/// The way in which a structure begins to move: which joints open, which slide, which parts move as one body.
namespace musim::lsdem {

/// Gap up to which faces are joints of a mechanism, over the smaller height of the two blocks [-]: blocks that were laid on others of
/// unequal height leave some 1/500. A choice.
inline constexpr double kMechanismGap = 0x1p-8;

/// A joint opens or slides when it does so by more than this part of what the joint that moves most does [-]: the springs of the others
/// give way by less. A choice.
inline constexpr double kMovingPart = 0.125;

/// Place of a body: a block, or the ground.
struct BodyPlace {
    Vector3 position = Vector3::Zero();
    Quaternion orientation = Quaternion::Identity();

    Vector3 operator*(const Vector3& in_body) const { return orientation * in_body + position; }
};

/// Event in a joint.
enum class JointEvent {
    sticks,
    opens,   ///< about an edge that stays closed
    slides,  ///< and may open as well
    parts,   ///< opens everywhere
};

/// Motion of a joint between two states.
struct JointMotion {
    std::size_t block = 0;
    std::optional<std::size_t> other;  ///< nothing: the ground
    JointEvent event = JointEvent::sticks;
    double opening = 0.0;            ///< the largest of its corners, along the normal of the other body [m]
    double least_opening = 0.0;      ///< the smallest [m]; below zero: its springs give way
    double slip = 0.0;               ///< across that normal, the largest of the corners that open least [m]
    std::vector<Vector3> of_block;   ///< its corners on the block, in the second state [m]
    std::vector<Vector3> of_other;   ///< the same on the other body
    Vector3 edge = Vector3::Zero();  ///< middle of the corners that open least, on the other body [m]
};

/// A structure that moves.
struct Mechanism {
    std::vector<JointMotion> joints;
    /// For every block, the number of the body it moves with: 0 with the ground, others from 1 in the order of their first blocks.
    std::vector<std::size_t> body;
    std::size_t bodies = 0;  ///< that move against the ground
};

/// Motions of joints from the first state to the second, all places seen from the ground. `drawn`: where blocks were when `joints` were
/// found. The upper of two blocks is the one that moves on the other. Two blocks that meet in several faces have a motion for each.
std::vector<JointMotion> find_joint_motions(const std::vector<RigidJoint>& joints, const std::vector<BodyPlace>& drawn,
                                            const std::vector<BodyPlace>& first, const std::vector<BodyPlace>& second);

/// The largest opening or slip of a joint over the smallest edge of its blocks [-]. `edge`: of every block [m].
double find_largest_motion(const std::vector<JointMotion>& joints, const std::vector<double>& edge);

/// Names what happens in each joint (kMovingPart) and joins blocks whose joints stick. `held`: of every block, 1: held to the ground.
Mechanism find_mechanism(std::vector<JointMotion> joints, const std::vector<int>& held);

/// "opens", "slides", "parts", "sticks".
std::string to_string(JointEvent event);

/// The mechanism in one sentence: "blocks 0 to 9, as one body, overturn about the
/// downhill edge on the ground". `axes`: the directions
/// downhill and upward, seen from the ground, by which edges are called.
std::string describe(const Mechanism& mechanism, const BlockTable& blocks, const std::array<Vector3, 2>& axes);

}  // namespace musim::lsdem
