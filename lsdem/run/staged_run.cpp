#include "lsdem/run/staged_run.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "lsdem/rotation.hpp"
#include "lsdem/run/scale_specimen.hpp"

namespace musim::lsdem {
namespace {

Quaternion to_quaternion(const Vector3& rotation_vector) {
    const double angle = rotation_vector.norm();
    if (!(angle > 0.0)) return Quaternion::Identity();
    return Quaternion(Eigen::AngleAxisd(angle, rotation_vector / angle));
}

template <class Value>
void append(std::vector<Value>& to, const std::vector<Value>& from, std::size_t first) {
    to.insert(to.end(), from.begin() + static_cast<std::ptrdiff_t>(first), from.end());
}

/// Work and losses since the start of the first stage; height and elastic energy are those of now.
Energy add_before(Energy now, const Energy& before, double gravitational) {
    now.gravitational += gravitational;
    now.friction_loss += before.friction_loss;
    now.damping_loss += before.damping_loss;
    now.base_work += before.base_work;
    now.load_work += before.load_work;
    now.preparation_loss += before.preparation_loss;
    return now;
}

/// Where a stage begins on the clock and in the place of the first.
struct Offset {
    double time = 0.0;
    Vector3 base = Vector3::Zero();
};

void join_history(History& whole, const RunResult& first, const RunResult& stage, const Offset& offset) {
    const History& part = stage.history;
    const std::size_t spine = stage.spine.size();
    const Energy before = whole.energy.back();
    for (std::size_t k = 1; k < part.samples(); ++k) {
        whole.time.push_back(offset.time + part.time[k]);
        whole.base.push_back(part.base[k]);
        whole.base.back().displacement += offset.base;
        whole.energy.push_back(add_before(part.energy[k], before, before.gravitational));
        for (std::size_t s = 0; s < spine; ++s) {
            const std::size_t block = stage.spine.block[s];
            const Quaternion now = to_quaternion(part.spine_rotation[k * spine + s]) * stage.initial.orientation[block];
            whole.spine_rotation.push_back(rotation_vector(first.initial.orientation[block], now));
        }
    }
    append(whole.spine_position, part.spine_position, spine);
    append(whole.spine_velocity, part.spine_velocity, spine);
}

void join_frames(Frames& whole, const Frames& part, std::size_t blocks, double time) {
    for (std::size_t k = 1; k < part.time.size(); ++k) whole.time.push_back(time + part.time[k]);
    if (part.time.empty()) return;
    append(whole.position, part.position, blocks);
    append(whole.quaternion, part.quaternion, blocks);
    append(whole.velocity, part.velocity, blocks);
    append(whole.contact_force, part.contact_force, blocks);
}

/// Adds a later stage to the run of those before it.
void join(RunResult& whole, RunResult stage) {
    const Offset offset{stage.origin->time, stage.origin->base};
    join_history(whole.history, whole, stage, offset);
    join_frames(whole.frames, stage.frames, whole.blocks.mass.size(), offset.time);
    whole.status = stage.status;
    whole.divergence = stage.divergence;
    if (whole.divergence) whole.divergence->time += offset.time;
    whole.falls = std::move(stage.falls);
    for (double& time : whole.falls.time) time += offset.time;
    if (stage.collapse_time) whole.collapse_time = offset.time + *stage.collapse_time;
    whole.steps += stage.steps;
    const double overlap = std::max(whole.statistics.max_overlap_over_height, stage.statistics.max_overlap_over_height);
    whole.statistics = stage.statistics;
    whole.statistics.max_overlap_over_height = overlap;
    whole.final = std::move(stage.final);
    for (std::size_t b = 0; b < whole.losses->block.size(); ++b) whole.losses->block[b] += stage.losses->block[b];
    whole.losses->ground += stage.losses->ground;
    for (int axis = 0; axis < 3; ++axis) {
        const auto a = static_cast<std::size_t>(axis);
        if (stage.peak_base_acceleration[axis] > whole.peak_base_acceleration[axis]) whole.base_changes[a] = stage.base_changes[a];
    }
    whole.peak_base_acceleration = whole.peak_base_acceleration.cwiseMax(stage.peak_base_acceleration);
    whole.state_hash = stage.state_hash;
    whole.energy_closure = std::max(whole.energy_closure, stage.energy_closure);
    whole.base_reaction_over_weight = stage.base_reaction_over_weight;
    whole.wall_time += stage.wall_time;
}

}  // namespace

StagedMotion StagedMotion::scaled(const scaling::Similitude& similitude) const {
    StagedMotion image = *this;
    for (SequenceStage& stage : image.stages) {
        stage.motion = scale_motion(stage.motion, similitude);
        stage.plan = stage.plan.scaled(similitude.time());
    }
    image.settling.damping_rate *= similitude.frequency();
    return image;
}

StagedMotion StagedMotion::with_finer_step(std::uint64_t times) const {
    StagedMotion finer = *this;
    for (SequenceStage& stage : finer.stages) stage.plan = stage.plan.with_finer_step(times);
    return finer;
}

std::uint64_t StagedMotion::samples() const {
    std::uint64_t sum = 0;
    for (const SequenceStage& stage : stages) sum += stage.plan.samples;
    return sum;
}

RunStart pass_on(const Simulation& simulation, const TimePlan& plan, std::size_t stage, const RunResult& run,
                 const std::optional<RestPhaseEnd>& rest_phase) {
    RunStart next;
    next.origin =
        run.origin ? *run.origin : StageOrigin{.stage = 0, .position = run.initial.position, .orientation = run.initial.orientation};
    next.origin->stage = stage + 1;
    next.origin->time += plan.duration();
    next.origin->base += rest_phase ? rest_phase->moved : simulation.base().displacement;
    next.falls = run.falls;
    // on the clock of the next stage: before its start, at the latest in the rest phase
    for (double& time : next.falls.time) time = std::isnan(time) ? time : std::min(time - plan.duration(), 0.0);
    if (rest_phase) {
        next.rest = rest_phase->rest;
        next.wall_time = rest_phase->wall_time;
    }
    return next;
}

RunResult run_stages(Simulation& simulation, const Specimen& specimen, const StagedMotion& motion, RunStart begin,
                     const RunSettings& settings) {
    const std::vector<SequenceStage>& stages = motion.stages;
    const auto all = static_cast<double>(motion.samples());
    double done = 0.0;
    std::optional<RunResult> whole;
    for (std::size_t k = 0; k < stages.size(); ++k) {
        const TimePlan& plan = stages[k].plan;
        const auto own = static_cast<double>(plan.samples);
        RunSettings of_stage{.threads = settings.threads};
        if (settings.observer.on_progress)
            of_stage.observer.on_progress = [&](double part) { settings.observer.on_progress((done + own * part) / all); };
        if (k > 0) simulation.begin_motion(stages[k].motion);
        RunResult run = simulate(simulation, specimen, plan, std::move(begin), of_stage);
        done += own;
        const bool goes_on = run.status == RunStatus::completed && k + 1 < stages.size();
        std::optional<RestPhaseEnd> rest_phase;
        if (goes_on && stages[k + 1].settle) rest_phase = come_to_rest(simulation, stages[k], motion.settling, run, {});
        const bool stands = goes_on && run.status == RunStatus::completed;
        begin = stands ? pass_on(simulation, plan, k, run, rest_phase) : RunStart{};
        if (whole) {
            join(*whole, std::move(run));
        } else {
            whole = std::move(run);
        }
        if (!stands) break;
    }
    // the readings of stages are no single clock, as their samples are
    if (stages.size() > 1) {
        whole->sensors.clear();
        whole->sensor_memory.clear();
    }
    return std::move(*whole);
}

}  // namespace musim::lsdem
