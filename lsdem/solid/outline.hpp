#pragma once

#include "lsdem/solid/solid.hpp"

namespace musim::lsdem {

/// Form of a body in its frame: a box about the origin, or the solid in that box. Asks the functions of one or of the other.
struct Outline {
    Vector3 half = Vector3::Zero();  ///< half extents of the box [m]
    const Solid* solid = nullptr;    ///< nothing: the box is the body
};

/// Reach from the origin along a direction of unit length, in its frame [m].
double find_reach(const Outline& outline, const Vector3& direction);

/// Width of the widest gap that a plane along a face of one, or along an edge of each, leaves between two bodies [m]: they are no nearer to
/// each other. Negative: the shortest way to part them. `place`: of b in the frame of a.
double find_gap(const Outline& a, const Outline& b, const Placing& place);

/// Distance of a point from a body, in its frame; negative inside [m].
double find_gap(const Outline& outline, const Vector3& x);

/// A width by which two bodies are apart at least [m]; zero or less where they may overlap. Fast: the boxes are asked before the solids,
/// faces before edges, and nothing more once the gap is wider than `enough`.
double find_clearance(const Outline& a, const Outline& b, const Placing& place, double enough);

}  // namespace musim::lsdem
