#include "lsdem/study/simulate.hpp"

#include <chrono>
#include <cmath>
#include <cstddef>
#include <limits>
#include <stdexcept>

#include "lsdem/block_height.hpp"
#include "lsdem/time_step.hpp"

namespace musim::lsdem::study {
namespace {

BlockTable make_block_table(const Specimen& specimen) {
    BlockTable table;
    for (const Block& block : specimen.model.blocks) {
        table.size.emplace_back(2.0 * half_extents(specimen.model, block));
        table.mass.push_back(block.mass);
    }
    table.layer = specimen.layer;
    table.layer.resize(table.mass.size(), 0);
    return table;
}

/// Rotation vector from orientation `from` to `to`, world frame [rad].
Vector3 rotation_vector(const Quaternion& from, const Quaternion& to) {
    const Eigen::AngleAxisd rotation(to * from.conjugate());
    return rotation.angle() * rotation.axis();
}

void reserve(History& history, const TimePlan& plan, std::size_t spine) {
    const std::size_t samples = plan.samples + 1;
    history.time.reserve(samples);
    history.base.reserve(samples);
    history.energy.reserve(samples);
    for (auto* series : {&history.spine_position, &history.spine_velocity, &history.spine_rotation}) series->reserve(samples * spine);
}

void add_sample(RunResult& run, const Simulation& simulation) {
    History& history = run.history;
    history.time.push_back(simulation.time());
    history.base.push_back(simulation.base());
    history.energy.push_back(simulation.energy());
    for (const std::size_t block : run.spine.block) {
        history.spine_position.push_back(simulation.position(block));
        history.spine_velocity.push_back(simulation.velocity(block));
        history.spine_rotation.push_back(rotation_vector(run.initial.orientation[block], simulation.orientation(block)));
    }
    if (!run.collapse_time && simulation.fallen_fraction() >= kCollapsedFraction) run.collapse_time = simulation.time();
}

void add_frame(RunResult& run, const Simulation& simulation) {
    const Kinematics now = simulation.kinematics();
    run.frames.time.push_back(now.time);
    for (std::size_t b = 0; b < now.position.size(); ++b) {
        const Quaternion& q = now.orientation[b];
        run.frames.position.emplace_back(now.position[b].cast<float>());
        run.frames.quaternion.emplace_back(Eigen::Vector4d(q.w(), q.x(), q.y(), q.z()).cast<float>());
        run.frames.velocity.emplace_back(now.velocity[b].cast<float>());
    }
}

/// Upward reaction of the ground over the weight of the blocks it may carry.
std::optional<double> base_reaction_over_weight(const Simulation& simulation) {
    const Model& model = simulation.model();
    double mass = 0.0;
    for (const Block& block : model.blocks) mass += block.fixed ? 0.0 : block.mass;
    const double gravity = model.gravity.norm();
    if (!model.ground.present || !(mass * gravity > 0.0)) return std::nullopt;
    return -simulation.base_reaction().dot(model.gravity) / (gravity * gravity * mass);
}

/// Nothing for a model that has no critical step, such as one without moving blocks.
std::optional<double> find_critical_time_step(const Model& model) {
    try {
        return compute_critical_time_step(model);
    } catch (const std::invalid_argument&) {
        return std::nullopt;
    }
}

void finish(RunResult& run, const Simulation& simulation) {
    run.final = simulation.kinematics();
    run.statistics = simulation.statistics();
    run.steps = run.statistics.steps;
    run.state_hash = simulation.state_hash();
    run.energy_closure = compute_energy_closure(run.history.energy);
    run.base_reaction_over_weight = base_reaction_over_weight(simulation);
    run.divergence = simulation.divergence();
    if (run.divergence) {
        run.status = RunStatus::diverged;
    } else if (run.collapse_time) {
        run.status = RunStatus::collapsed;
    }
}

}  // namespace

TimePlan TimePlan::scaled(double time_factor) const {
    TimePlan plan = *this;
    plan.time_step = time_step * time_factor;
    return plan;
}

RunResult simulate(const Specimen& specimen, const TimePlan& plan, const RunSettings& settings) {
    const auto start = std::chrono::steady_clock::now();
    Simulation simulation(specimen.model, plan.time_step, settings.threads);

    RunResult run;
    run.time_step = plan.time_step;
    run.critical_time_step = find_critical_time_step(specimen.model);
    run.spine = specimen.spine;
    run.blocks = make_block_table(specimen);
    run.initial = simulation.kinematics();
    reserve(run.history, plan, run.spine.size());
    add_sample(run, simulation);
    if (plan.samples_per_frame > 0) add_frame(run, simulation);

    for (std::uint64_t k = 1; k <= plan.samples; ++k) {
        simulation.advance(plan.steps_per_sample);
        if (simulation.divergence()) break;
        add_sample(run, simulation);
        if (plan.samples_per_frame > 0 && k % plan.samples_per_frame == 0) add_frame(run, simulation);
        if (settings.on_progress) settings.on_progress(static_cast<double>(k) / static_cast<double>(plan.samples));
    }

    finish(run, simulation);
    run.wall_time = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    return run;
}

Specimen make_shadow(Specimen specimen) {
    for (Block& block : specimen.model.blocks) {
        Eigen::Index largest = 0;
        block.position.cwiseAbs().maxCoeff(&largest);
        double& coordinate = block.position[largest];
        coordinate = std::nextafter(coordinate, std::numeric_limits<double>::infinity());
    }
    return specimen;
}

}  // namespace musim::lsdem::study
