#pragma once

#include "lsdem/solid/solid.hpp"

namespace musim::lsdem {

/// Volume, centre of mass and inertia of a homogeneous solid, in the axes of its frame.
struct MassProperties {
    double volume = 0.0;                          ///< [m³]
    Vector3 centre = Vector3::Zero();             ///< of mass [m]
    Matrix3 inertia_over_mass = Matrix3::Zero();  ///< about the centre, per unit mass [m²]
};

/// Sums over the tetrahedra between the faces' triangles and a point of the solid, so that a far origin costs no digits [Tonon05].
MassProperties compute_mass_properties(const Solid& solid);

/// Principal axes of a symmetric tensor, right-handed, each the nearest to the frame's own that a Jacobi rotation leaves; products of
/// inertia below 1e-12 of the trace count as none, so that bodies whose own axes are principal keep them, whatever the rounding.
struct PrincipalAxes {
    Matrix3 axes = Matrix3::Identity();  ///< columns, in the frame of the tensor
    Vector3 moments = Vector3::Zero();
};
PrincipalAxes find_principal_axes(const Matrix3& tensor);

}  // namespace musim::lsdem
