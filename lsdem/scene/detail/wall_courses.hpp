#pragma once

#include <vector>

#include "lsdem/scene/scene.hpp"
#include "lsdem/types.hpp"
#include "scaling/json_reader.hpp"

namespace musim::lsdem::detail {

/// A box of a wall, in its place.
struct WallBox {
    Vector3 size = Vector3::Zero();      ///< across, along and up [m]
    Vector3 position = Vector3::Zero();  ///< of its middle [m]
    int course = 1;                      ///< from 1 at the base
    bool along_x = true;                 ///< else along y, in a return
    bool is_lintel = false;
    bool is_line = false;  ///< the one at the right end of the wall in its course, of the first leaf
};

/// Boxes of a wall, course by course from the base; in a course those of the first leaf from left to right, of the second, of the left and
/// of the right return.
///
/// Along a run all is counted in cells of the pitch p, so that a half block fills one and a whole one two, and a joint is g = 2p − w wide.
/// A course is whole blocks of an odd, or shifted by a cell and closed by half blocks of an even one, cut where an opening, a lintel or the
/// other wall of a corner begins. Of a piece that is shorter than a quarter block the neighbour takes the length; one of no length is left
/// out. At a corner the wall runs through in odd courses and its return in even ones.
///
/// Throws SceneError, with the place of the wall in its scene, for openings that do not fit.
std::vector<WallBox> lay_wall(const Wall& wall, const scaling::JsonPlace& place);

}  // namespace musim::lsdem::detail
