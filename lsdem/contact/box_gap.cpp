#include "lsdem/contact/box_gap.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace musim::lsdem::detail {

double find_gap_of_faces(const Vector3& half_a, const Vector3& half_b, const Matrix3& q, const Vector3& position) {
    double widest = -std::numeric_limits<double>::infinity();
    for (Eigen::Index i = 0; i < 3; ++i) {
        double of_a = 0.0, of_b = 0.0, offset = 0.0;
        for (Eigen::Index j = 0; j < 3; ++j) {
            of_a += std::abs(q(i, j)) * half_a[j];
            of_b += std::abs(q(j, i)) * half_b[j];
            offset += q(j, i) * position[j];
        }
        widest = std::max({widest, std::abs(position[i]) - (half_b[i] + of_a), std::abs(offset) - (half_a[i] + of_b)});
    }
    return widest;
}

namespace {

/// Across an edge of one and an edge of the other, times the sine of the angle between them [m]. Edges nearly parallel to each other are
/// left to the faces.
double find_gap_of_edges(const Vector3& half_a, const Vector3& half_b, const Matrix3& q, const Vector3& position) {
    constexpr double kParallel = 1e-6;
    double widest = 0.0;
    for (Eigen::Index b = 0; b < 3; ++b) {
        const Eigen::Index b1 = (b + 1) % 3, b2 = (b + 2) % 3;
        for (Eigen::Index a = 0; a < 3; ++a) {
            const Eigen::Index a1 = (a + 1) % 3, a2 = (a + 2) % 3;
            if (1.0 - q(b, a) * q(b, a) < kParallel) continue;
            const double of_b = half_b[b1] * std::abs(q(b2, a)) + half_b[b2] * std::abs(q(b1, a));
            const double of_a = half_a[a1] * std::abs(q(b, a2)) + half_a[a2] * std::abs(q(b, a1));
            const double offset = std::abs(position[b2] * q(b1, a) - position[b1] * q(b2, a));
            widest = std::max(widest, offset - (of_b + of_a));
        }
    }
    return widest;
}

}  // namespace

double find_gap(const Vector3& half_a, const Vector3& half_b, const Matrix3& rotation, const Vector3& position) {
    const double of_faces = find_gap_of_faces(half_a, half_b, rotation, position);
    return of_faces > 0.0 ? of_faces : find_gap_of_edges(half_a, half_b, rotation, position);
}

}  // namespace musim::lsdem::detail
