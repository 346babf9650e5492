#pragma once

#include "lsdem/contact/box_meeting.hpp"
#include "lsdem/detail/lanes.hpp"

/// Overlaps of boxes that meet face to face, four pairs side by side: the function of OverlapPieces and sum_load, to rounding.
namespace musim::lsdem::detail {

struct Lanes3 {
    Lanes x{}, y{}, z{};
};

/// For a stiffness per area of one; vectors in world axes, about the point half way between the middles of the boxes.
struct LaneOverlap {
    Lanes3 force;     ///< on the second body [m³]
    Lanes3 moment;    ///< of it [m⁴]
    Lanes deepest{};  ///< largest depth of a point of one body in the other [m]
    // main cells, half of each body's
    Lanes area{};                    ///< [m²]
    Lanes area_depth{};              ///< ∫ depth [m³]
    Lanes3 area_place;               ///< ∫ place [m³]
    Lanes3 area_square, area_cross;  ///< ∫ of (xx, yy, zz) and (yz, zx, xy) about the cell's own middle [m⁴]
    LaneMask irregular{};            ///< nothing of the above holds: take the exact function
};

/// Four pairs; the lanes do not depend on each other. Compiled for AVX2 and for plain x86-64, same bits.
void compute_overlaps(const BoxMeeting* pairs, LaneOverlap& result);

}  // namespace musim::lsdem::detail
