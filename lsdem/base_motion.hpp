#pragma once

#include <array>
#include <vector>

#include "lsdem/finite_turn.hpp"
#include "lsdem/model.hpp"
#include "lsdem/types.hpp"

namespace musim::lsdem {

/// Evaluates the prescribed motion of the base. Velocity is linear between samples, displacement its exact integral, zero before the start;
/// likewise the rotation vector and its rate.
class BaseMotion {
  public:
    /// Throws std::invalid_argument when a component has two or more samples and no positive dt, or a value that is not finite.
    explicit BaseMotion(const BaseComponents& motion);

    // of the pivot
    Vector3 displacement(double time) const;  ///< [m]
    Vector3 velocity(double time) const;      ///< [m/s]
    Vector3 acceleration(double time) const;  ///< right-hand limit [m/s²]

    Vector3 angle(double time) const;         ///< rotation vector [rad]
    Quaternion turn(double time) const;       ///< from before the motion
    TurnRates turn_rates(double time) const;  ///< right-hand limits
    const Vector3& pivot() const { return pivot_; }
    bool turns() const { return turns_; }
    /// Largest absolute acceleration of each component from t = 0 to `end` [m/s²]: that of the straight lines between velocity samples,
    /// exactly. A jump of the velocity has none.
    Vector3 peak_acceleration(double end) const;
    /// The time up to which the base neither shifts nor turns, from `time` on [s]: `time` itself while it moves, infinite when it moves no
    /// more.
    double still_until(double time) const;

  private:
    struct Axis {
        BaseComponent samples;
        std::vector<double> displacement;  ///< at the samples [m]
    };
    using Axes = std::array<Axis, 3>;
    static Axes make_axes(const std::array<BaseComponent, 3>& components);

    Axes shift_, turn_;
    Vector3 pivot_;
    bool turns_;
};

}  // namespace musim::lsdem
