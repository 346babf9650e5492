#pragma once

#include "lsdem/types.hpp"

/// Stiffness that springs over the area of a contact have against small motions of its blocks, ∫ bᵀ D b dA: b moves the points at r by a
/// shift and a turn, D = across · 1 + (along − across) n nᵀ per area, n the normal.
namespace musim::lsdem {

/// v × as a matrix.
inline Matrix3 cross_matrix(const Vector3& v) {
    Matrix3 m;
    m << 0.0, -v.z(), v.y(), v.z(), 0.0, -v.x(), -v.y(), v.x(), 0.0;
    return m;
}

/// D [unit of `along` and `across`].
inline Matrix3 stiffness_per_area(const Vector3& normal, double along, double across) {
    return across * Matrix3::Identity() + (along - across) * normal * normal.transpose();
}

/// Stiffness against a turn about the middle of the area, `second` its moments about it [that times m⁴]: springs across for the turn in the
/// plane, along it for the others.
inline Matrix3 turning_stiffness(const Vector3& normal, const Matrix3& second, double along, double across) {
    const Matrix3 n = cross_matrix(normal);
    return across * (second.trace() * Matrix3::Identity() - second) + (along - across) * n * second * n.transpose();
}

}  // namespace musim::lsdem
