#include "lsdem/solid/box_gap.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace musim::lsdem {

double find_gap_of_faces(const Vector3& half_a, const Vector3& half_b, const Placing& place) {
    const auto& [q, position] = place;
    double widest = -std::numeric_limits<double>::infinity();
    for (Eigen::Index i = 0; i < 3; ++i) {
        double of_a = 0.0, of_b = 0.0, offset = 0.0;
        for (Eigen::Index j = 0; j < 3; ++j) {
            of_b += std::abs(q(i, j)) * half_b[j];
            of_a += std::abs(q(j, i)) * half_a[j];
            offset += q(j, i) * position[j];
        }
        widest = std::max({widest, std::abs(position[i]) - (half_a[i] + of_b), std::abs(offset) - (half_b[i] + of_a)});
    }
    return widest;
}

double find_gap_of_edges(const Vector3& half_a, const Vector3& half_b, const Placing& place) {
    // sine of the angle below which edges separate nothing that faces do not, but for this part of their lengths
    constexpr double kParallel = 1e-6;
    const auto& [q, position] = place;
    double widest = -std::numeric_limits<double>::infinity();
    for (Eigen::Index a = 0; a < 3; ++a) {
        const Eigen::Index a1 = (a + 1) % 3, a2 = (a + 2) % 3;
        for (Eigen::Index b = 0; b < 3; ++b) {
            const Eigen::Index b1 = (b + 1) % 3, b2 = (b + 2) % 3;
            const double sine = std::sqrt(q(a1, b) * q(a1, b) + q(a2, b) * q(a2, b));
            if (sine < kParallel) continue;
            const double of_a = half_a[a1] * std::abs(q(a2, b)) + half_a[a2] * std::abs(q(a1, b));
            const double of_b = half_b[b1] * std::abs(q(a, b2)) + half_b[b2] * std::abs(q(a, b1));
            const double offset = std::abs(position[a2] * q(a1, b) - position[a1] * q(a2, b));
            widest = std::max(widest, (offset - (of_a + of_b)) / sine);
        }
    }
    return widest;
}

double find_gap(const Vector3& half_a, const Vector3& half_b, const Placing& place) {
    return std::max(find_gap_of_faces(half_a, half_b, place), find_gap_of_edges(half_a, half_b, place));
}

}  // namespace musim::lsdem
