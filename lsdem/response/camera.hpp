#pragma once

#include <vector>

#include "lsdem/response/camera_view.hpp"

/// How blocks look to a camera far in front of a structure, for what pictures are made of.
namespace musim::lsdem::detail {

/// Directions of an image: to the right, and from the structure to the camera.
struct CameraAxes {
    Vector3 right, toward;
};

CameraAxes find_axes(CameraSide side);

/// A block as the camera sees it: places in the image plane and depth toward the camera.
struct Seen {
    Vector3 center, half;
    Matrix3 turn;  ///< body to image axes (right, z, toward)
};

Seen look_at(const StoredRun& run, std::size_t frame, std::size_t block, const CameraAxes& axes);

/// Outline of a block in the image plane: the convex hull of its corners, counterclockwise [monotone chain].
std::vector<Eigen::Vector2d> find_outline(const Seen& seen);

}  // namespace musim::lsdem::detail
