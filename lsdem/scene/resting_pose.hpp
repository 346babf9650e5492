#pragma once

#include <memory>
#include <span>
#include <vector>

#include "lsdem/block_reach.hpp"
#include "lsdem/types.hpp"

namespace musim::lsdem {

/// A box: edge lengths in the body frame [m], middle and axes in the world frame. Of a block that is a solid the box about its body frame
/// that holds it.
struct BoxPose {
    Vector3 size = Vector3::Zero();
    Vector3 position = Vector3::Zero();
    Quaternion orientation = Quaternion::Identity();
    std::shared_ptr<const Solid> solid = {};  ///< in the body frame; nothing: it is a box

    /// Reach from its position along the world's axes.
    BlockReach reach() const { return find_block_reach(solid.get(), 0.5 * size, orientation.toRotationMatrix()); }
};

/// Points of the top faces of `below` that a box let down upright over `box` meets, in the frame of its footprint: u, v from the middle of
/// its lower face along its body x and y axes, w upward from the world's zero [m]. A top face is cut along the footprint; its corners and
/// the corners of the cut are the only places where flat faces can meet first. With nothing under it one point, at the height of the
/// highest corner of `below`, or of the ground. `box` must stand upright, turned about the vertical only.
std::vector<Vector3> find_support_points(const BoxPose& box, std::span<const BoxPose> below);

/// The plane w = height + slope_u·u + slope_v·v on which a lower face rests [m, -, -].
struct RestingPlane {
    double height = 0.0;
    double slope_u = 0.0, slope_v = 0.0;
};

/// The plane that a rigid box of height `height` [m] rests on: the face of the upper convex hull of `points` that lies under its centre of
/// mass. That leans out by (height/2)·sin(tilt), so the face is looked for again under its new place until it stays. When the centre of
/// mass is beside all points, the plane found before, the level one through the highest point at first: the box would topple, which is
/// for dynamics to say. `extent`: size of the footprint [m], the measure of what is too small to distinguish faces.
RestingPlane find_resting_plane(std::span<const Vector3> points, double height, double extent);

/// `box` turned about the middle of its lower face, which stays at its place in plan, by the fraction `part` of the tilt of `plane`, and
/// just above all of `points`. part = 0: upright on the highest point; part = 1: at rest on the plane.
BoxPose tilt_onto(const BoxPose& box, const RestingPlane& plane, std::span<const Vector3> points, double part);

/// Puts the boxes of one layer, which come upright at their places in plan, to rest on those `below`, which stand already, whatever their
/// tilt; with nothing below on the plane z = 0. A box with nothing under it hangs at the top of what is below.
///
/// Boxes are tilted one after the other as far as their neighbors leave room (found by bisection to 1/1000 of the tilt), then once more,
/// because a neighbor may have made room; no two come closer than `clearance` [m], or than they are when upright.
void put_to_rest(std::span<const BoxPose> below, std::span<BoxPose> boxes, double clearance = 0.0);

}  // namespace musim::lsdem
