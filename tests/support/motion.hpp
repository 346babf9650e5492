#pragma once

#include <doctest/doctest.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "lsdem/model.hpp"
#include "lsdem/motion/simulation.hpp"
#include "tests/support/models.hpp"

namespace musim::lsdem::tests {

/// Base velocity sampled from a function of time, `samples` intervals over `duration` [s].
template <class Velocity>
BaseComponent sample_velocity(double duration, std::size_t samples, const Velocity& velocity) {
    BaseComponent component;
    component.dt = duration / static_cast<double>(samples);
    for (std::size_t k = 0; k <= samples; ++k) component.velocity.push_back(velocity(static_cast<double>(k) * component.dt));
    return component;
}

/// Constant acceleration [m/s²] for a duration [s], constant velocity afterwards.
inline BaseComponent constant_acceleration(double acceleration, double duration) { return {0.0, duration, {0.0, acceleration * duration}}; }

/// A step of the base velocity at t = 0 [m/s].
inline BaseComponent velocity_step(double velocity) { return {0.0, 0.0, {velocity}}; }

/// Half a sine of acceleration, A·sin(πt/T), then constant velocity. 2000 samples: the area under the chords is short by 2e-7.
inline BaseComponent half_sine(double amplitude, double duration) {
    const double omega = kPi / duration;
    return sample_velocity(duration, 2000, [=](double t) { return amplitude / omega * (1.0 - std::cos(omega * t)); });
}

/// A whole sine of acceleration, A·sin(2πt/T), then rest.
inline BaseComponent full_sine(double amplitude, double duration) {
    const double omega = 2.0 * kPi / duration;
    return sample_velocity(duration, 4000, [=](double t) { return amplitude / omega * (1.0 - std::cos(omega * t)); });
}

/// Advances by `steps`; a run that has diverged, whose time stands still, fails the test case.
inline void advance(Simulation& simulation, std::uint64_t steps = 1) {
    simulation.advance(steps);
    REQUIRE_FALSE(simulation.divergence().has_value());
}

inline void advance_to(Simulation& simulation, double time) {
    const double left = (time - simulation.time()) / simulation.time_step();
    if (left > 0.0) simulation.advance(static_cast<std::uint64_t>(std::llround(left)));
}

/// First time at which `value(simulation)` changes sign, linear between steps; not a number when it does not before `until` [s].
template <class Value>
double find_crossing(Simulation& simulation, double until, const Value& value) {
    double before = value(simulation);
    while (simulation.time() < until) {
        advance(simulation);
        const double now = value(simulation);
        if ((before > 0.0) != (now > 0.0)) return simulation.time() - simulation.time_step() * now / (now - before);
        before = now;
    }
    return std::numeric_limits<double>::quiet_NaN();
}

/// Rotation about the world y axis of a block that turns about it alone [rad].
inline double tilt_about_y(const Simulation& simulation, std::size_t block = 0) {
    const Quaternion q = simulation.orientation(block);
    return 2.0 * std::atan2(q.y(), q.w());
}

}  // namespace musim::lsdem::tests
