#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "lsdem/types.hpp"

/// Boxes and spheres in space, as seen from afar.
namespace musim::lsdem {

/// One of them.
struct DrawnBody {
    Vector3 center = Vector3::Zero();           ///< world frame, z up [m]
    Vector3 half = Vector3::Zero();             ///< half edges in the body frame [m]
    Matrix3 orientation = Matrix3::Identity();  ///< body to world
    bool is_round = false;                      ///< a sphere of radius half.x()
    int color = 0;                              ///< of the palette: materials
    bool is_marked = false;                     ///< drawn in the colour that stands out
};

/// From where bodies are looked at, without perspective: x runs to the right and toward the eye, y to the right and away, z upward.
struct BoxView {
    double turn = 0.62;  ///< of the eye about the vertical, from the side of −y toward +x [rad]
    double lift = 0.36;  ///< of the eye above the horizontal [rad]

    Vector3 right() const;   ///< to the right in the picture, world frame
    Vector3 up() const;      ///< upward in the picture
    Vector3 toward() const;  ///< toward the eye
};

/// The rectangle of a picture that something takes, in metres along right() and up().
struct ViewBounds {
    double left = 0.0, right = 0.0, bottom = 0.0, top = 0.0;

    double width() const { return right - left; }
    double height() const { return top - bottom; }
};

/// Bounds of all bodies.
ViewBounds find_bounds(const std::vector<DrawnBody>& bodies, const BoxView& view);

/// Where a view stands in a picture: one metre is `scale` px, the view's origin at (x, y) [px].
struct ViewPlace {
    double x = 0.0, y = 0.0, scale = 1.0;
};

/// A corner as "x,y" for the attribute `points`.
std::string write_point(const Vector3& world, const BoxView& view, const ViewPlace& place);

/// Colour of a body's side, for legends.
const char* find_swatch(const DrawnBody& body);

/// Draws the bodies, the nearer over the farther: of two, that one which lies beyond a plane of a face of the other that the eye sees.
/// Faces that are hidden behind others everywhere are left out, as far as a grid of points about a pixel apart shows. Bodies that overlap
/// may cover each other in parts wrongly.
void draw_bodies(std::string& svg, const std::vector<DrawnBody>& bodies, const BoxView& view, const ViewPlace& place);

}  // namespace musim::lsdem
