#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "lsdem/bodies.hpp"
#include "lsdem/contacts.hpp"
#include "lsdem/model.hpp"

namespace musim::lsdem {

/// Where one block of a pair is: the follower, or the ground as a frame.
struct PairPoses {
    Matrix3 leader, follower;  ///< body to world
    Vector3 offset;            ///< leader's centre less the follower's, world frame [m]
};

/// Poses of a pair at step n, or at step n − 1.
PairPoses find_pair_poses(const Bodies& bodies, const BasePose& base, std::uint32_t leader, std::uint32_t follower, bool previous);

/// The kind of patch that two boxes form, or a box and the ground, less its lattice and law; nothing when their faces are not nearly
/// parallel, or when it is not certain for as long as every point moves by less than `skin` [m] which faces meet.
std::optional<PatchKind> find_patch_kind(const Model& model, const Bodies& bodies, const BasePose& base, std::uint32_t leader,
                                         std::uint32_t follower, double skin);

/// A pair that is a patch, before it has its place.
struct PatchPlan {
    std::uint32_t pair = 0;  ///< into ContactList::pairs
    PatchKind kind;
    double damping = 1.0;          ///< see PatchHeights
    int count_p = 0, count_q = 0;  ///< nodes along the leader's two axes in the face; 0: as many as the size of a new patch asks for
};

/// Puts the planned patches into groups of four of one kind, in the order of the list. A patch that was there before in `previous` keeps
/// its history: `old_pair` holds, for every pair of the list, its index there, or kNoPatch.
void place_patches(const std::vector<PatchPlan>& plans, const Bodies& bodies, const BasePose& base, const ContactList& previous,
                   const std::vector<std::uint32_t>& old_pair, ContactList& list);

}  // namespace musim::lsdem
