#pragma once

#include "lsdem/detail/free_rotation.hpp"
#include "lsdem/types.hpp"

namespace musim::lsdem {

/// Turns a free rigid body for a time `dt` [s]: second order, time-symmetric and symplectic, for rotations of any size.
///
/// The kinetic energy Σ π_i²/(2 I_i) is split by principal axis; each part turns the body about that axis at the constant rate π_i/I_i:
/// x(dt/2) y(dt/2) z(dt) y(dt/2) x(dt/2)  [DullweberLeimkuhlerMcLachlan97]. The angle enters through tan(φ/2) ≈ φ/2 + φ³/24: any function
/// of π_i alone is the exact flow of some Hamiltonian of π_i, so the approximation costs nothing of the structure. The angular momentum in
/// the world frame is not touched and so conserved exactly.
///
/// `momentum_world`: angular momentum about the centre of mass [kg·m²/s]; `inverse_inertia`: 1/I of the principal axes [1/(kg·m²)].
inline Quaternion rotate_freely(const Quaternion& orientation, const Vector3& momentum_world, const Vector3& inverse_inertia, double dt) {
    const Vector3 p = orientation.conjugate() * momentum_world;
    const detail::Orientation<double> q =
        detail::turn_freely<double>({orientation.w(), orientation.x(), orientation.y(), orientation.z()}, {p.x(), p.y(), p.z()},
                                    {inverse_inertia.x(), inverse_inertia.y(), inverse_inertia.z()}, dt);
    return {q.w, q.x, q.y, q.z};
}

/// Rotation vector from orientation `from` to `to`, both body to world: world frame, its length the angle [rad].
inline Vector3 rotation_vector(const Quaternion& from, const Quaternion& to) {
    const Eigen::AngleAxisd rotation(to * from.conjugate());
    return rotation.angle() * rotation.axis();
}

}  // namespace musim::lsdem
