#pragma once

#include <array>
#include <span>
#include <vector>

#include "lsdem/types.hpp"

namespace musim::lsdem::scene {

/// A box: edge lengths in the body frame [m], middle and axes in the world frame.
struct BoxPose {
    Vector3 size = Vector3::Zero();
    Vector3 position = Vector3::Zero();
    Quaternion orientation = Quaternion::Identity();
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

/// What lies on a box: forces, as multiples of its weight, and where their resultant acts in plan, in the frame of its footprint.
struct Load {
    double over_weight = 0.0;
    double u = 0.0, v = 0.0;  ///< [m]
};

/// A plane, and the three points that carry it, with their parts of what they carry.
struct Support {
    RestingPlane plane;
    std::array<std::size_t, 3> point{};  ///< into the points that were given; meaningless when no face was found
    std::array<double, 3> part{};        ///< sum 1, or all zero when no face was found
};

/// The plane that a rigid box of height `height` [m] rests on: the face of the upper convex hull of `points` that lies under its centre of
/// mass and its load. The centre of mass leans out by (height/2)·sin(tilt), so the face is looked for again under its new place until it
/// stays. When the centre of mass is beside all points, the level plane through the highest one: the box would topple, which is for
/// dynamics to say. `extent`: size of the footprint [m], the measure of what is too small to tell faces apart.
Support find_resting_plane(std::span<const Vector3> points, double height, double extent, const Load& load = {});

/// `box` turned about the middle of its lower face, which stays at its place in plan, by the fraction `part` of the tilt of `plane`, and
/// just above all of `points`. part = 0: upright on the highest point; part = 1: at rest on the plane.
BoxPose tilt_onto(const BoxPose& box, const RestingPlane& plane, std::span<const Vector3> points, double part);

/// Puts every box of a structure to rest on those below it, layer by layer; the first layer stands on the plane z = 0, and a box with
/// nothing under it hangs at the top of the layer below.
///
/// Where a box rests depends on what lies on it, and that on how it rests: places are found from the ground up, then what each box bears
/// from the top down (a box on three points is statically determinate), and this again, kSweeps times. Where it has not settled by then,
/// dynamics will.
///
/// Boxes of one layer are tilted one after the other as far as their neighbors leave room (found by bisection to 1/1000 of the tilt), then
/// once more, because a neighbor may have made room; so no two overlap by more than touching. Each layer's boxes must come upright, with
/// their places in plan; their heights above the ground are found. `layer`: of every box, from 1, in ascending order.
void put_to_rest(std::span<BoxPose> boxes, std::span<const int> layer);

}  // namespace musim::lsdem::scene
