#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include "lsdem/results/history.hpp"
#include "scaling/laws/similitude.hpp"

namespace musim::lsdem {

/// A run that no simulation made: `samples` samples of two spine blocks that swing with different amplitudes, prototype scale.
inline RunResult make_made_run(std::size_t samples) {
    RunResult run;
    run.time_step = 0.001;
    run.blocks = {.size = {{1.0, 2.0, 3.0}, {1.5, 2.0, 3.0}}, .mass = {10.0, 20.0}, .layer = {1, 2}};
    constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
    run.falls = {.time = {kNone, 0.5}, .displacement = {Vector3::Constant(kNone), {0.5, 0.0, -1.0}}, .at_collapse = {}, .airborne = {0, 0}};
    run.losses = Losses{.block = {{0.3, 0.2}, {0.0, 0.0}}, .ground = {0.4, 0.1}};
    run.spine = {.block = {0, 1}, .level = {1, 2}};
    run.state_hash = "0123456789abcdef";
    for (std::size_t k = 0; k < samples; ++k) {
        const double t = 0.01 * static_cast<double>(k);
        run.history.time.push_back(t);
        run.history.base.push_back({.displacement = {t, 0, 0}, .velocity = {1, 0, 0}, .acceleration = {0, 0, 0}});
        run.history.energy.push_back({.kinetic = t * t, .gravitational = 1.0, .base_work = t * t});
        for (const double amplitude : {0.3, 0.7}) {
            run.history.spine_position.emplace_back(amplitude * t, 0.1, 1.0);
            run.history.spine_velocity.emplace_back(amplitude * std::cos(9.0 * t), amplitude * std::sin(7.0 * t), 0.0);
            run.history.spine_rotation.emplace_back(0.0, 0.01 * t, 0.0);
        }
    }
    for (Kinematics* state : {&run.initial, &run.final}) {
        state->position = {{0, 0, 1.5}, {0, 0, 4.5}};
        state->orientation = {Quaternion(0.8, 0.6, 0.0, 0.0), Quaternion::Identity()};
        state->velocity = {{0.1, 0, 0}, {0.2, 0, 0}};
        state->angular_velocity = {{0, 0.1, 0}, {0, 0.2, 0}};
    }
    run.final.time = run.history.time.back();
    run.steps = samples;
    return run;
}

/// Run that a perfectly similar model would have recorded.
inline RunResult scale_run(RunResult run, const scaling::Similitude& s) {
    for (double& t : run.history.time) t *= s.time();
    for (BaseState& base : run.history.base) {
        base.displacement *= s.length();
        base.velocity *= s.velocity();
        base.acceleration *= s.acceleration();
    }
    for (Energy& e : run.history.energy) {
        for (double* part : {&e.kinetic, &e.gravitational, &e.elastic_normal, &e.elastic_shear, &e.friction_loss, &e.damping_loss,
                             &e.preparation_loss, &e.base_work}) {
            *part *= s.energy();
        }
    }
    const auto scale = [&](PairWork& work) { work.friction *= s.energy(), work.damping *= s.energy(); };
    std::for_each(run.losses->block.begin(), run.losses->block.end(), scale);
    scale(run.losses->ground);
    for (Vector3& x : run.history.spine_position) x *= s.length();
    for (Vector3& v : run.history.spine_velocity) v *= s.velocity();
    for (Vector3& x : run.final.position) x *= s.length();
    for (Vector3& v : run.final.velocity) v *= s.velocity();
    for (Vector3& w : run.final.angular_velocity) w *= s.frequency();
    return run;
}

}  // namespace musim::lsdem
