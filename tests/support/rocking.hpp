#pragma once

#include <cmath>

#include "lsdem/model.hpp"
#include "tests/support/models.hpp"

namespace musim::lsdem::tests {

/// A block that rocks about the edges of its base, turning about the y axis [Housner63].
struct RockingBlock {
    double width = 0.0, height = 0.0;  ///< [m]

    explicit RockingBlock(const Stone& stone) : width(stone.size.x()), height(stone.size.z()) {}

    double slenderness() const { return std::atan2(width, height); }                      ///< α [rad]
    double radius() const { return 0.5 * std::hypot(width, height); }                     ///< R [m]
    double frequency_parameter() const { return std::sqrt(0.75 * kGravity / radius()); }  ///< p [1/s]
};

/// Half-sine or whole-sine pulse of base acceleration.
enum class Pulse { half_sine, full_sine };

/// Does a rigid block that leans on one edge overturn (θ > α + 0.5) under a pulse of `strength` = a_p/(g tan α) and circular frequency
/// ω = `ratio`·p, before it returns to upright? Integrates θ̈ = −p²[sin(α − θ) − (a/g) cos(α − θ)] from uplift on, fourth-order Runge-Kutta.
inline bool overturns_without_impact(Pulse pulse, double alpha, double ratio, double strength) {
    // time in units of 1/p
    const double end = (pulse == Pulse::half_sine ? 1.0 : 2.0) * kPi / ratio, peak = strength * std::tan(alpha);
    const auto base = [&](double t) { return t < end ? peak * std::sin(ratio * t) : 0.0; };
    const auto acceleration = [&](double t, double theta) { return -std::sin(alpha - theta) + base(t) * std::cos(alpha - theta); };
    double t = std::asin(1.0 / strength) / ratio, theta = 0.0, rate = 0.0;
    for (double h = end / 4000.0; t < end + 30.0; t += h) {
        const double a1 = acceleration(t, theta);
        const double a2 = acceleration(t + 0.5 * h, theta + 0.5 * h * rate);
        const double a3 = acceleration(t + 0.5 * h, theta + 0.5 * h * rate + 0.25 * h * h * a1);
        const double a4 = acceleration(t + h, theta + h * rate + 0.5 * h * h * a2);
        theta += h * rate + h * h / 6.0 * (a1 + a2 + a3);
        rate += h / 6.0 * (a1 + 2.0 * a2 + 2.0 * a3 + a4);
        if (theta > alpha + 0.5) return true;
        if (theta < 0.0) return false;
    }
    return false;
}

/// Smallest value between `low` (does not hold) and `high` (holds) at which `holds`, by `halvings` of the interval.
template <class Predicate>
double bisect(double low, double high, int halvings, const Predicate& holds) {
    for (int i = 0; i < halvings; ++i) {
        const double middle = 0.5 * (low + high);
        (holds(middle) ? high : low) = middle;
    }
    return 0.5 * (low + high);
}

/// A block tilted by `angle` [rad] about the y axis, on the edge of its base it leans on; that edge at the origin.
inline Model make_tilted_block(const Stone& stone, double angle) {
    Model model = make_model(stone);
    const Quaternion orientation(Eigen::AngleAxisd(angle, Vector3::UnitY()));
    const Vector3 edge(std::copysign(0.5 * stone.size.x(), angle), 0.0, -0.5 * stone.size.z());
    model.blocks.push_back(make_block(stone, -(orientation * edge), orientation));
    return model;
}

}  // namespace musim::lsdem::tests
