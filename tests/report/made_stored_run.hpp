#pragma once

#include <cmath>
#include <cstddef>

#include "lsdem/report/report_content.hpp"
#include "lsdem/rotation.hpp"

namespace musim::lsdem {

/// Three blocks on each other that wander and turn over `frames` frames, as no simulation made them.
inline ReportedRun make_stored_run(std::size_t frames) {
    constexpr std::size_t kBlocks = 3;
    ReportedRun reported{
        .label = "made", .folder = "made", .run = {}, .response = {}, .summary = {}, .scene_name = "made", .material = "wood"};
    lsdem::StoredRun& run = reported.run;
    for (std::size_t b = 0; b < kBlocks; ++b) {
        const auto height = static_cast<double>(b);
        run.blocks.size.emplace_back(1.0, 2.0, 1.0);
        run.blocks.mass.push_back(1.0);
        run.blocks.layer.push_back(static_cast<int>(b) + 1);
        run.initial.position.emplace_back(0.0, 0.0, height + 0.5);
        run.initial.orientation.emplace_back(Eigen::AngleAxisd(0.1 * height, Vector3::UnitZ()));
        run.spine.block.push_back(b);
        run.spine.level.push_back(static_cast<int>(b) + 1);
    }
    run.final = run.initial;
    const auto move = [&](std::size_t b, double t) {
        return Vector3((0.1 + 0.2 * static_cast<double>(b)) * std::sin(3.0 * t), -0.05 * t, 0.01 * std::cos(t) - 0.01);
    };
    const auto turn = [&](std::size_t b, double t) { return Vector3(0.0, 0.3 * t * static_cast<double>(b), -0.1 * t); };
    const auto height_of = [](std::size_t b) { return static_cast<double>(b); };
    reported.response.emplace();
    reported.response->scales.gravity = 9.8;
    for (std::size_t k = 0; k < frames; ++k) {
        const double t = 0.02 * static_cast<double>(k);
        run.history.time.push_back(t);
        run.history.base.push_back({.displacement = {t, 0.0, 0.0}, .velocity = {1.0, 0.0, 0.0}, .acceleration = {0.0, 0.0, 0.0}});
        run.history.energy.push_back({.kinetic = t, .gravitational = 5.0 - t, .friction_loss = 0.5 * t, .base_work = 0.5 * t});
        run.frames.time.push_back(t);
        for (std::size_t b = 0; b < kBlocks; ++b) {
            const Vector3 angle = turn(b, t);
            const Quaternion q =
                (angle.norm() > 0.0 ? Quaternion(Eigen::AngleAxisd(angle.norm(), angle.normalized())) : Quaternion::Identity()) *
                run.initial.orientation[b];
            const Vector3 velocity((0.3 + 0.6 * static_cast<double>(b)) * std::cos(3.0 * t), -0.05, -0.01 * std::sin(t));
            run.frames.position.emplace_back((run.initial.position[b] + move(b, t)).cast<float>());
            run.frames.quaternion.emplace_back(Eigen::Vector4d(q.w(), q.x(), q.y(), q.z()).cast<float>());
            run.frames.velocity.emplace_back(velocity.cast<float>());
            run.frames.contact_force.push_back(static_cast<float>(10.0 * (3.0 - height_of(b)) * (1.0 + 0.5 * std::sin(5.0 * t))));
            run.history.spine_position.push_back(run.initial.position[b] + move(b, t));
            run.history.spine_velocity.push_back(velocity);
            run.history.spine_rotation.push_back(angle);
            run.final.position[b] = run.initial.position[b] + move(b, t);
            run.final.orientation[b] = q;
        }
    }
    return reported;
}

}  // namespace musim::lsdem
