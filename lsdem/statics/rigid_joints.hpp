#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "lsdem/model.hpp"

namespace musim::lsdem {

/// Where two blocks, or a block and the ground, meet as rigid bodies: a plane and the corners of the polygon over which they do. A block on
/// its edge has a line, on its corner a point, up to the gap that counts as contact.
struct RigidJoint {
    std::size_t block = 0;
    std::optional<std::size_t> other;  ///< nothing: the ground
    Vector3 normal = Vector3::Zero();  ///< of the plane, from the other body into the block, world frame [-]
    std::vector<Vector3> corners;      ///< of the polygon, world frame [m]
    double friction = 0.0;             ///< μ of the pair [-]
};

/// Joints of a structure, and whether some blocks meet edge along edge only: in a line that has no plane, which is left out.
struct RigidJoints {
    std::vector<RigidJoint> joints;
    bool leaves_out_edges = false;
};

/// Joints of all blocks but those between two fixed ones. Faces meet where one lies over the other no farther than `gap` times the smaller
/// height (along body z) of the two, of the ground that of the block; edges that cross, likewise. Where one reaches over the other by less
/// than that, there is no joint. Blocks must be bounded by planes (is_of_flat_sides).
RigidJoints find_rigid_joints(const Model& model, double gap);

/// Are all blocks bounded by planes?
bool is_of_flat_sides(const Model& model);

}  // namespace musim::lsdem
