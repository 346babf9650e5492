#pragma once

#include "lsdem/contact/overlap.hpp"
#include "lsdem/types.hpp"

/// Where friction and dashpots of two bodies act: the area over which their faces face each other, see docs/theory/overlap_contact.md.
namespace musim::lsdem {

/// Area, half of each body's, with its moments.
struct ContactArea {
    double area = 0.0;                 ///< S [m²]
    Vector3 arm = Vector3::Zero();     ///< of its middle from a given point [m]
    Matrix3 second = Matrix3::Zero();  ///< of (x − middle)(x − middle)ᵀ [m⁴]
};

/// `about`: a point near to all of it, from which `arm` counts.
ContactArea find_contact_area(const OverlapPieces& pieces, const Vector3& about);

/// A pressure that is affine where one body's face lies: at + slope·(x − about) [Pa].
struct AffinePressure {
    double at = 0.0;
    Vector3 slope = Vector3::Zero();
    Vector3 about = Vector3::Zero();
};

/// Integral of a pressure over an area, and of its product with place [N, N·m].
struct PressureMoments {
    double sum = 0.0;
    Vector3 at = Vector3::Zero();
    bool operator==(const PressureMoments&) const = default;
};

/// Pull of dashpots of the pressure `dashpot` beyond what springs of `stiffness` per area push, ∫ max(0, −(K d + dashpot)) dS, with
/// places from `dashpot.about`. With the opposite of the dashpots and C/Δt for K: what they would push before their points touched.
PressureMoments find_pull(const OverlapPieces& pieces, const AffinePressure& dashpot, double stiffness);

/// r̄, the mean distance of the pressure from `about`, across the normal [m]. Faces have the part in it that they would have if they faced
/// one across the normal: one that lies along the normal has none, as depths over its image would change without bound.
double find_reach(const OverlapPieces& pieces, const Vector3& normal, const Vector3& about);

/// No more than `find_reach` about any point: a load L [m³] of depths up to `deepest` [m] is nowhere closer to a point than in a disc, 2/3
/// √(L/(π d)), of the body for which that is less; 0 of no load [m].
double find_least_reach(const OverlapPieces& pieces, const Vector3& normal, double deepest);

}  // namespace musim::lsdem
