#include "lsdem/finite_turn.hpp"

#include <cmath>

namespace musim::lsdem {
namespace {

/// Σ (−s)^k/(2k + first)! and its derivative with respect to s: 0 gives cos √s, 1 (sin √s)/√s, 2 and 3 what angular velocities need.
struct Series {
    double value = 0.0, slope = 0.0;

    Series(double s, int first) {
        constexpr int kTerms = 28;  // of s = (2π)², the last one is 1e-28
        double factorial = 1.0;
        for (int i = 2; i <= first; ++i) factorial *= i;
        double term = 1.0 / factorial;  // without its power of s
        double power = 1.0, power_before = 0.0;
        for (int k = 0; k < kTerms; ++k) {
            value += term * power;
            slope += k * term * power_before;
            power_before = power, power *= s;
            const int next = 2 * k + first;
            term /= -static_cast<double>((next + 1) * (next + 2));
        }
    }
};

}  // namespace

Quaternion turn_by(const Vector3& rotation_vector) {
    Vector3 half = 0.5 * rotation_vector;
    int halvings = 0;
    for (; half.squaredNorm() > 1.0; ++halvings) half *= 0.5;
    const double squared = half.squaredNorm();
    double w = Series(squared, 0).value;
    Vector3 v = Series(squared, 1).value * half;
    for (; halvings > 0; --halvings) {
        const double w_before = w;
        w = w * w - v.squaredNorm();
        v *= 2.0 * w_before;
    }
    const double scale = 1.0 / std::sqrt(w * w + v.squaredNorm());
    return {scale * w, scale * v.x(), scale * v.y(), scale * v.z()};
}

TurnRates find_turn_rates(const Vector3& angle, const Vector3& rate, const Vector3& acceleration) {
    const double squared = angle.squaredNorm(), growth = 2.0 * angle.dot(rate);
    const Series a(squared, 2), b(squared, 3);
    const Vector3 across = angle.cross(rate), twice = angle.cross(across);
    const auto turned = [&](const Vector3& of) {
        const Vector3 once = angle.cross(of);
        return Vector3(of + a.value * once + b.value * angle.cross(once));
    };
    return {turned(rate), turned(acceleration) + growth * (a.slope * across + b.slope * twice) + b.value * rate.cross(across)};
}

}  // namespace musim::lsdem
