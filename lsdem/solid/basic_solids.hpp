#pragma once

#include <span>

#include <Eigen/Core>

#include "lsdem/solid/solid.hpp"

namespace musim::lsdem {

/// Right prism, or frustum, of a convex outline in the plane z = 0, given counter-clockwise seen from +z [m], from z = -length/2 to
/// +length/2. `taper`: size of the end at +length/2 over that at -length/2, about the outline's origin [-]; above zero.
/// Throws std::invalid_argument of an outline that is not convex, has fewer than three corners or turns back, naming the corner.
Solid make_prism(std::span<const Eigen::Vector2d> outline, double length, double taper = 1.0);

/// Drum of `flats` flat sides about the z axis, from z = -height/2 to +height/2. Its corners lie on circles of the given radii, the first
/// flat's middle on +x. Its volume is sin(2π/n)·n/(2π) of the round drum's: 1.14 % less with 24 flats; it rests on a slope up to tan(π/n).
Solid make_drum(double radius, double height, int flats, double top_radius);

}  // namespace musim::lsdem
