#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "lsdem/report/report_content.hpp"

namespace musim::lsdem {

/// Largest distances of what a browser shows from what was stored, by the rounding of frames.
struct TowerRounding {
    double displacement = 0.0;  ///< of a centre along an axis, at most [m]
    double rotation = 0.0;      ///< of a component of the rotation vector, at most [rad]
    double velocity = 0.0;      ///< of a component, at most [m/s]
    double force = 0.0;         ///< of the contact forces over a block's weight, at most; 0 when they are not kept [-]
};

/// Blocks and frames of a run, small enough for a page.
///
/// Layout, little endian, base64: "start": 32-bit floats, for each block position x y z [m], quaternion w x y z (body to world), size x y z
/// [m]; "slip": one float per block, the largest slip below it at the end [m], "layer": one 16-bit integer. "frames": zlib; for each frame
/// in turn, 16-bit integers of displacement x y z since the start and of the rotation vector since the start, world axes, the turn of the
/// base taken back, each component of all blocks one after another, low bytes before high ones; then 8-bit integers of the velocity's
/// components. All integers are differences from the frame before, modulo their range. An integer over its greatest magnitude (32767, 127)
/// times "scales" is the value. "forces": zlib, empty when they are not kept; for each frame in turn, 8-bit differences from the frame
/// before of q, for each block: the contact forces on it over its weight are (q/255)² times scales.force, so that small ones are reported
/// more finely. "shapes": of blocks that are no boxes: "corners", 32-bit floats x y z in the frame of the block [m], "faces", the outer
/// ones by their corners, counter-clockwise from outside, a corner as its complement where the edge to the next one is no line, and
/// "radius" of a ball, 0 of others; "shape": one 32-bit integer per block, into "shapes", -1 of a box; empty where all are boxes. "base":
/// displacement of the base at each frame [m]; of a base that turns also "turn", quaternion w x y z at each frame, and "pivot" [m]: what is
/// said to be at p is at pivot + base + turn (p - pivot - base). A run without frames has two: its start and its end, without velocities.
struct TowerData {
    nlohmann::json json;
    TowerRounding rounding;
};

TowerData make_tower_data(const ReportedRun& run);

}  // namespace musim::lsdem
