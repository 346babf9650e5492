#pragma once

#include <cstddef>
#include <vector>

#include "lsdem/patches.hpp"
#include "lsdem/types.hpp"

/// Single patches between steps: where they begin, how large they are, what they hold.
namespace musim::lsdem::detail {

/// Where the leader's face is in the follower's frame, as patch_field::place_k ... along_qv hold it, into lane `lane` of `pose`.
void write_patch_pose(const PatchKind& kind, const PatchHeights& heights, const Matrix3& leader, const Matrix3& follower,
                      const Vector3& offset, std::size_t lane, double* pose);

/// The rectangle in which the faces cover each other [m].
struct PatchSize {
    double p = 0.0, q = 0.0;  ///< lengths along p and q; negative: they do not cover each other
    double depth = 0.0;       ///< largest depth of the leader's face there
};
PatchSize measure_patch(const PatchKind& kind, const PatchHeights& heights, const Matrix3& leader, const Matrix3& follower,
                        const Vector3& offset);

/// What the springs of a patch hold.
struct PatchLoad {
    double energy = 0.0;                                   ///< of the normal springs [J]
    double friction_u = 0.0, friction_v = 0.0;             ///< on the leader, along the follower's u and v [N]
    std::vector<double> traction_u = {}, traction_v = {};  ///< K_s ξ of every node [Pa]
};
PatchLoad find_load(const PatchList& patches, std::size_t group, std::size_t lane);

/// Makes a new patch store `load.energy`, or all it can store where its blocks are, by an overlap that carries no force, and bear friction:
/// the tractions when they are of as many nodes, else by a slip that all touching nodes share. It takes over from a contact that met in
/// another way, or in another simulation, and what that one bore must not drop.
void inherit_load(PatchList& patches, std::size_t group, std::size_t lane, const PatchLoad& load);

}  // namespace musim::lsdem::detail
