#pragma once

#include <algorithm>
#include <cmath>

#include "tests/support/faces.hpp"
#include "tests/support/models.hpp"
#include "tests/support/rocking.hpp"

namespace musim::lsdem::tests {

/// A rigid block that rocks on an elastic edge, without slip and without ringing on it; everything to the first order in depth over size.
///
/// An edge that stands at θ in a face, d deep, stores K w G(θ) d³ (`edge_energy`), so it bears N = 3 K w G d² at −G' d/(3G) inside of it,
/// of small θ d/(3 tan θ). Below θ = 2N/(K w b²) all of the base touches and turns as Winkler's bed: N acts at K w b³ θ/(12 N) from the
/// middle. What sticks is the middle of the area of contact: half the strip of the base, at d/2, half that of the face, at 0, so that the
/// edge, d deep, goes forward by 3/4 d for a turn of one.
class ElasticRocking {
  public:
    explicit ElasticRocking(const Stone& stone)
        : stone_(stone), block_(stone), per_length_(stone.normal_stiffness / stone.face_area() * stone.size.y()) {}

    const RockingBlock& rigid() const { return block_; }

    /// Depth of the edge that bears `load` times the weight [m].
    double depth(double theta, double load = 1.0) const {
        const double n = load * stone_.weight(), b = stone_.size.x();
        if (theta < lift_off(load)) return n / (per_length_ * b) + 0.5 * b * theta;
        return std::sqrt(n / (3.0 * per_length_ * edge_energy(theta)));
    }

    /// Time from rest at `start` [rad] in equilibrium to upright, over that of the rigid block, less one.
    double quarter_period_delay(double start) const {
        // Energy is kept: of turning, of the centre that sinks by d, and of the edge, N d/3, with the N of the rigid block. Midpoint rule
        // in v, θ = θ0 sin² v, smooth at both ends, where the rate begins with a root and the depth with another.
        constexpr int kParts = 2000;
        double elastic = 0.0, exact = 0.0;
        for (int i = 0; i < kParts; ++i) {
            const double v = 0.5 * kPi * (i + 0.5) / kParts, theta = start * std::sin(v) * std::sin(v);
            elastic += std::sin(2.0 * v) / std::sqrt(squared_rate(start, theta, 1.0));
            exact += std::sin(2.0 * v) / std::sqrt(squared_rate(start, theta, 0.0));
        }
        return elastic / exact - 1.0;
    }

    /// Load on the base of a block that rests at the tilt `theta` but for its fall, at the first instant, over its weight.
    double starting_load(double theta) const { return load(theta, theta); }
    double starting_friction(double theta) const { return 0.75 * std::sin(from_balance(theta)) * std::cos(from_balance(theta)); }

    /// Part of the effect of the edge that is left out because friction's spring gives: where N sinks by d it gives by u = H/(K_s S) =
    /// d (H/N) k_n/(2 k_s), since N = K_n S d/2, and holds H u/2 beside the 2/3 N d; H/N is largest upright [-].
    double friction_share() const {
        const double steepest = starting_friction(0.0) / starting_load(0.0);
        return 0.375 * steepest * steepest * stone_.normal_stiffness / stone_.shear_stiffness;
    }

    /// Tilt of a block that stood upright, under a base acceleration a(t) [m/s²] that makes it lean to positive θ, when `until`(θ, t) holds
    /// or it is upright again after `least` [s]; fourth-order Runge-Kutta. N is the weight: the vertical motion changes the depth by few
    /// percent.
    template <class Base, class Until>
    double shake(const Base& base, double step, double least, const Until& until) const {
        double t = 0.0, theta = 0.0, rate = 0.0;
        while (!until(theta, t)) {
            const double h = step;
            const double a1 = acceleration(base(t), theta, rate);
            const double a2 = acceleration(base(t + 0.5 * h), theta + 0.5 * h * rate, rate + 0.5 * h * a1);
            const double a3 = acceleration(base(t + 0.5 * h), theta + 0.5 * h * rate + 0.25 * h * h * a1, rate + 0.5 * h * a2);
            const double a4 = acceleration(base(t + h), theta + h * rate + 0.5 * h * h * a2, rate + h * a3);
            theta += h * rate + h * h / 6.0 * (a1 + a2 + a3);
            rate += h / 6.0 * (a1 + 2.0 * a2 + 2.0 * a3 + a4);
            t += h;
            if (theta >= 0.0) continue;
            if (t > least) return 0.0;
            theta = 0.0;
            rate = std::max(rate, 0.0);
        }
        return theta;
    }

  private:
    double from_balance(double theta) const { return block_.slenderness() - theta; }
    double lift_off(double load) const { return 2.0 * load * stone_.weight() / (per_length_ * stone_.size.x() * stone_.size.x()); }

    /// Distance from the edge at which its force acts [m].
    double inset(double theta) const {
        const double b = stone_.size.x();
        if (theta < lift_off(1.0)) return 0.5 * b - per_length_ * b * b * b * theta / (12.0 * stone_.weight());
        return -edge_energy_slope(theta) / (3.0 * edge_energy(theta)) * depth(theta);
    }
    /// Slope of the depth under the weight: ∂(N d/3 − N d)/∂θ = −N·inset.
    double sinking(double theta) const { return theta < lift_off(1.0) ? 0.5 * stone_.size.x() : 1.5 * inset(theta); }

    /// Force on the edge of the rigid block over its weight, 1 + z̈/g, when it began to fall at `start`.
    double load(double start, double theta) const {
        const double a = from_balance(theta);
        return 1.0 - 0.75 * (std::sin(a) * std::sin(a) + 2.0 * std::cos(a) * (std::cos(from_balance(start)) - std::cos(a)));
    }

    /// θ̇² of a fall from `start`, with `part` of the depth.
    double squared_rate(double start, double theta, double part) const {
        const double r = block_.radius(), a = from_balance(theta), small = 1e-4 * theta;
        const auto depth_at = [&](double at) { return part * depth(at, load(start, at)); };
        const auto potential = [&](double at) {
            return kGravity * (r * std::cos(from_balance(at)) + depth_at(at) * (load(start, at) / 3.0 - 1.0));
        };
        const double up = r * std::sin(a) - (depth_at(theta + small) - depth_at(theta - small)) / (2.0 * small);
        const double along = r * std::cos(a) - 0.75 * depth_at(theta);
        return 2.0 * (potential(start) - potential(theta)) / (r * r / 3.0 + up * up + along * along);
    }

    double acceleration(double base, double theta, double rate) const {
        const double at = std::max(theta, 1e-12), r = block_.radius(), a = from_balance(theta);
        const double up = r * std::sin(a) - sinking(at), along = r * std::cos(a) - 0.75 * depth(at);
        const double curved = r * (along * std::sin(a) - up * std::cos(a));
        return (-kGravity * (r * std::sin(a) - inset(at)) + base * along - curved * rate * rate) / (r * r / 3.0 + up * up + along * along);
    }

    Stone stone_;
    RockingBlock block_;
    double per_length_;  ///< K w [Pa]
};

/// A block at rest at `angle` [rad] on an edge that already bears it: as deep as at rest, and with the friction that keeps it from
/// slipping as it begins to fall. Put on its edge without either, it rings on it, and loses its friction in every bounce.
inline Model make_borne_tilted_block(const Stone& stone, double angle) {
    const ElasticRocking rocking(stone);
    Model model = make_tilted_block(stone, angle);
    model.blocks[0].position.z() -= rocking.depth(angle, rocking.starting_load(angle));
    model.preload.push_back({0, std::nullopt, -rocking.starting_friction(angle) * stone.weight() * Vector3::UnitX(), 0.0});
    return model;
}

}  // namespace musim::lsdem::tests
