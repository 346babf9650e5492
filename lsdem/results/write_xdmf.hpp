#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "lsdem/results/hdf5_file.hpp"
#include "lsdem/results/history.hpp"

namespace musim::lsdem::detail {

/// Surfaces of all blocks as polygons, whose corners result.xdmf computes from the poses of the blocks: a corner of the block at p, turned
/// by the quaternion (w, q), that lies at x in the body frame is at p + x + 2 (w q × x + q (q·x) − x (q·q)). Each list holds three numbers
/// a corner, one for each axis i of the world; j and k are the axes that follow i, in turn.
struct Surface {
    std::vector<std::size_t> topology;  ///< XDMF's "Mixed": for each face 3, number of corners, corners
    std::vector<std::size_t> block;     ///< of each face
    std::vector<std::size_t> position;  ///< place of p_i in the list of positions, and
    std::vector<std::size_t> quaternion, quaternion_i, quaternion_j, quaternion_k;  ///< of w, q_i, q_j, q_k in that of quaternions
    std::vector<double> body_i, body_j, body_k;                                     ///< x_i, x_j, x_k [m]
    std::vector<std::size_t> velocity;  ///< of each face, place of v_i in the list of velocities
};

/// Outer faces of all blocks.
Surface list_surface(const BlockTable& blocks);

/// Writes the group /surface.
void write_surface(Hdf5File& file, const Surface& surface);

/// result.xdmf of a run, which opens result.h5 in ParaView: its frames, or its first and last instant where it has none. Boxes are points
/// with their sizes, for glyphs; where there are other shapes, all blocks are polygons.
std::string make_xdmf(const RunResult& run);

}  // namespace musim::lsdem::detail
