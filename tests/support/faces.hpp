#pragma once

#include <cmath>

#include "lsdem/types.hpp"

/// Closed forms of faces and edges that meet by their overlap (docs/theory/overlap_contact.md).
namespace musim::lsdem::tests {

/// Mean distance of the points of a rectangle a x b from its middle, the lever arm of friction under an even pressure [m].
inline double mean_distance(double a, double b) {
    const double d = std::hypot(a, b);
    return (d + a * a / (2.0 * b) * std::log((b + d) / a) + b * b / (2.0 * a) * std::log((a + d) / b)) / 6.0;
}

/// Force of two flat faces that overlap by `d` over a rectangle, over K and d [m²]. Points nearer to a side of a body than to its face,
/// on the rims of the rectangle that are sides of one (`rims` = 1) or both bodies (2), are less deep in it: each body misses
/// ∫∫(z − s) ds dz = d³/6 along the rim, of its length P, and counts what misses twice at a corner, d⁴/12. E = K/2 [S d² − P d³/6 + d⁴/3].
inline double flat_stiffness(const Vector3& size, double d, int rims) {
    const double around = 2.0 * (size.x() + size.y());
    return size.x() * size.y() - rims * (around * d / 4.0 - 2.0 / 3.0 * d * d);
}

/// Overlap of such faces that bear `force` over K [m³], to rounding.
inline double flat_overlap(const Vector3& size, double force, int rims) {
    double d = force / (size.x() * size.y());
    for (int i = 0; i < 4; ++i) d = force / flat_stiffness(size, d, rims);
    return d;
}

/// Energy of an edge of unit length that stands in a face at the angle `t`, over K times the cube of its depth: G = c/(6 tan t) with the
/// share c = (1 + 1/(sin t + cos t))/(2 cos² t) of Winkler's load [-].
inline double edge_energy(double t) {
    const double s = std::sin(t), c = std::cos(t);
    return (1.0 + 1.0 / (s + c)) / (12.0 * s * c);
}

/// Slope of `edge_energy` in t [-].
inline double edge_energy_slope(double t) {
    const double s = std::sin(t), c = std::cos(t), sum = s + c;
    return -((c - s) / (sum * sum) + (1.0 + 1.0 / sum) * (c * c - s * s) / (s * c)) / (12.0 * s * c);
}

}  // namespace musim::lsdem::tests
