#pragma once

#include "lsdem/detail/wide.hpp"

namespace musim::lsdem::detail {

/// Unit quaternion (w, x, y, z): body to world; one block, or several side by side.
template <class Real>
struct Orientation {
    Real w, x, y, z;

    /// The turn that leads from `before` to this.
    MUSIM_WIDE Orientation after(const Orientation& before) const {
        const Orientation& b = before;
        return {(w * b.w + x * b.x) + (y * b.y + z * b.z), (b.w * x - w * b.x) + (z * b.y - y * b.z),
                (b.w * y - w * b.y) + (x * b.z - z * b.x), (b.w * z - w * b.z) + (y * b.x - x * b.y)};
    }
};

/// Rows of the rotation matrix of a unit quaternion.
template <class Real>
struct RotationRows {
    Triple<Real> x, y, z;

    MUSIM_WIDE explicit RotationRows(const Orientation<Real>& q) {
        const Real tx = q.x + q.x, ty = q.y + q.y, tz = q.z + q.z;
        const Real twx = tx * q.w, twy = ty * q.w, twz = tz * q.w, txx = tx * q.x, txy = ty * q.x, txz = tz * q.x, tyy = ty * q.y,
                   tyz = tz * q.y, tzz = tz * q.z;
        x = {1.0 - (tyy + tzz), txy - twz, txz + twy};
        y = {txy + twz, 1.0 - (txx + tzz), tyz - twx};
        z = {txz - twy, tyz + twx, 1.0 - (txx + tyy)};
    }

    /// World vector seen from the body.
    MUSIM_WIDE Triple<Real> to_body(const Triple<Real>& v) const {
        return {(x.x * v.x + y.x * v.y) + z.x * v.z, (x.y * v.x + y.y * v.y) + z.y * v.z, (x.z * v.x + y.z * v.y) + z.z * v.z};
    }
};

/// Turns a free rigid body for a time `dt`, see rotate_freely in lsdem/rotation.hpp. `p`: angular momentum seen from the body.
template <class Real>
MUSIM_WIDE Orientation<Real> turn_freely(Orientation<Real> q, Triple<Real> p, const Triple<Real>& inverse_inertia, double dt) {
    // tangent of half the angle that the body turns in `h` about one axis
    const auto half_tangent = [](const Real& momentum, const Real& inverse, double h) MUSIM_WIDE_LAMBDA {
        const Real half_angle = (0.5 * h) * (momentum * inverse);
        return half_angle * (1.0 + half_angle * half_angle * (1.0 / 3.0));
    };
    // the momentum, seen from the body, turns the other way
    const auto turn_momentum = [](Real& a, Real& b, const Real& t) MUSIM_WIDE_LAMBDA {
        const Real squared = t * t, scale = 1.0 / (1.0 + squared), c = (1.0 - squared) * scale, s = (t + t) * scale, a0 = a;
        a = c * a0 + s * b;
        b = c * b - s * a0;
    };
    const auto about_x = [&](double h) MUSIM_WIDE_LAMBDA {
        const Real t = half_tangent(p.x, inverse_inertia.x, h), w0 = q.w, y0 = q.y;
        turn_momentum(p.y, p.z, t);
        q.w -= t * q.x, q.x += t * w0, q.y += t * q.z, q.z -= t * y0;
    };
    const auto about_y = [&](double h) MUSIM_WIDE_LAMBDA {
        const Real t = half_tangent(p.y, inverse_inertia.y, h), w0 = q.w, x0 = q.x;
        turn_momentum(p.z, p.x, t);
        q.w -= t * q.y, q.y += t * w0, q.x -= t * q.z, q.z += t * x0;
    };
    const auto about_z = [&](double h) MUSIM_WIDE_LAMBDA {
        const Real t = half_tangent(p.z, inverse_inertia.z, h), w0 = q.w, x0 = q.x;
        turn_momentum(p.x, p.y, t);
        q.w -= t * q.z, q.z += t * w0, q.x += t * q.y, q.y -= t * x0;
    };
    about_x(0.5 * dt);
    about_y(0.5 * dt);
    about_z(dt);
    about_y(0.5 * dt);
    about_x(0.5 * dt);
    const Real scale = 1.0 / square_root<Real>((q.w * q.w + q.x * q.x) + (q.y * q.y + q.z * q.z));
    return {q.w * scale, q.x * scale, q.y * scale, q.z * scale};
}

}  // namespace musim::lsdem::detail
