#pragma once

#include <cmath>

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
    Vector3 p = orientation.conjugate() * momentum_world;
    double w = orientation.w(), x = orientation.x(), y = orientation.y(), z = orientation.z();

    // tangent of half the angle that axis i turns in `h`
    const auto half_tangent = [&](int i, double h) {
        const double half_angle = 0.5 * h * p[i] * inverse_inertia[i];
        return half_angle * (1.0 + half_angle * half_angle / 3.0);
    };
    // the momentum, seen from the body, turns the other way
    const auto turn_momentum = [&](int j, int k, double t) {
        const double scale = 1.0 / (1.0 + t * t), c = (1.0 - t * t) * scale, s = 2.0 * t * scale;
        const double pj = p[j], pk = p[k];
        p[j] = c * pj + s * pk;
        p[k] = c * pk - s * pj;
    };
    const auto about_x = [&](double h) {
        const double t = half_tangent(0, h), w0 = w, y0 = y;
        turn_momentum(1, 2, t);
        w -= t * x, x += t * w0, y += t * z, z -= t * y0;
    };
    const auto about_y = [&](double h) {
        const double t = half_tangent(1, h), w0 = w, x0 = x;
        turn_momentum(2, 0, t);
        w -= t * y, y += t * w0, x -= t * z, z += t * x0;
    };
    const auto about_z = [&](double h) {
        const double t = half_tangent(2, h), w0 = w, x0 = x;
        turn_momentum(0, 1, t);
        w -= t * z, z += t * w0, x += t * y, y -= t * x0;
    };
    about_x(0.5 * dt);
    about_y(0.5 * dt);
    about_z(dt);
    about_y(0.5 * dt);
    about_x(0.5 * dt);
    const double scale = 1.0 / std::sqrt(w * w + x * x + y * y + z * z);
    return {w * scale, x * scale, y * scale, z * scale};
}

}  // namespace musim::lsdem
