#include "lsdem/run/simulate.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <limits>
#include <sstream>
#include <stdexcept>
#include <utility>

#include "lsdem/block_height.hpp"
#include "lsdem/fallen.hpp"
#include "lsdem/results/base_frame.hpp"
#include "lsdem/rotation.hpp"
#include "lsdem/run/advance_in_pieces.hpp"
#include "lsdem/run/drawn_places.hpp"
#include "lsdem/run/sensor_reader.hpp"
#include "lsdem/run/work_done.hpp"
#include "lsdem/time_step.hpp"
#include "scaling/interruption.hpp"

namespace musim::lsdem {
namespace {

using Clock = std::chrono::steady_clock;

void reserve(History& history, const TimePlan& plan, std::size_t spine, std::size_t loads) {
    const std::size_t samples = plan.samples + 1;
    history.time.reserve(samples);
    history.base.reserve(samples);
    history.energy.reserve(samples);
    history.load.reserve(samples * loads);
    for (auto* series : {&history.spine_position, &history.spine_velocity, &history.spine_rotation}) series->reserve(samples * spine);
}

/// Falls of all blocks, none fallen yet.
Falls make_falls(const Specimen& specimen, const Kinematics& start) {
    constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
    const std::size_t blocks = specimen.model.blocks.size();
    return {.time = std::vector<double>(blocks, kNone),
            .displacement = std::vector<Vector3>(blocks, Vector3::Constant(kNone)),
            .at_collapse = {},
            .airborne = find_airborne(specimen, start)};
}

/// Dates the falls of a structure that collapsed while it was prepared, and the collapse, at the start; displacements are from the drawn
/// places.
void note_falls_before(const Specimen& specimen, const Rest& rest, RunResult& run) {
    for (const MovedBlock& moved : rest.fallen) {
        run.falls.time[moved.block] = 0.0;
        run.falls.displacement[moved.block] = moved.now - moved.drawn;
    }
    run.collapse_time = 0.0;
    for (std::size_t b = 0; b < specimen.drawn.size(); ++b) {
        run.falls.at_collapse.emplace_back(run.initial.position[b] - specimen.drawn[b].position);
    }
}

/// Has a block fallen since falls are counted? `base`: since the start of the run.
bool has_fallen_now(const RunResult& run, const Simulation& simulation, std::size_t b, const BaseState& base) {
    const Quaternion& start = run.origin ? run.origin->orientation[b] : run.initial.orientation[b];
    const double risen = base.displacement.z() + (run.origin ? run.origin->base.z() : 0.0);
    const double sunk = (run.standing_position()[b].z() - turn_back(base, simulation.position(b)).z()) + risen;
    const double height = run.blocks.find_reach(b, start).extent().z();
    return has_fallen(height, start.toRotationMatrix(), turn_back(base, simulation.orientation(b)).toRotationMatrix(), sunk);
}

void add_sample(RunResult& run, const Simulation& simulation) {
    History& history = run.history;
    const BaseState base = simulation.base();
    history.time.push_back(simulation.time());
    history.base.push_back(base);
    history.energy.push_back(simulation.energy());
    for (const std::size_t block : run.spine.block) {
        history.spine_position.push_back(simulation.position(block));
        history.spine_velocity.push_back(simulation.velocity(block));
        history.spine_rotation.push_back(rotation_vector(run.initial.orientation[block], turn_back(base, simulation.orientation(block))));
    }
    for (const LoadState& load : simulation.loads()) history.load.push_back(load);
    note_falls(run, simulation, simulation.time(), base);
}

void add_frame(RunResult& run, const Simulation& simulation) {
    const Kinematics now = simulation.kinematics();
    std::vector<double> force(now.position.size(), 0.0);
    for (const ContactForce& contact : simulation.contact_forces()) {
        force[contact.leader] += contact.force.norm();
        if (contact.follower) force[*contact.follower] += contact.force.norm();
    }
    run.frames.time.push_back(now.time);
    for (std::size_t b = 0; b < now.position.size(); ++b) {
        const Quaternion& q = now.orientation[b];
        run.frames.position.emplace_back(now.position[b].cast<float>());
        run.frames.quaternion.emplace_back(Eigen::Vector4d(q.w(), q.x(), q.y(), q.z()).cast<float>());
        run.frames.velocity.emplace_back(now.velocity[b].cast<float>());
        run.frames.contact_force.push_back(static_cast<float>(force[b]));
    }
}

/// Upward reaction of ground and fixed blocks over the weight of the blocks that they may carry.
std::optional<double> base_reaction_over_weight(const Simulation& simulation) {
    const Model& model = simulation.model();
    const CarriedWeight weight(model);
    const bool carries =
        model.ground.present || std::any_of(model.blocks.begin(), model.blocks.end(), [](const Block& b) { return b.fixed; });
    if (!carries || !weight.exists()) return std::nullopt;
    return weight.find_borne(simulation);
}

void finish(RunResult& run, const Simulation& simulation) {
    run.final = simulation.kinematics();
    run.statistics = simulation.statistics();
    run.steps = run.statistics.steps;
    run.peak_base_acceleration = simulation.peak_base_acceleration();
    run.base_changes = find_base_changes(simulation.model().ground.motion, simulation.time());
    run.losses = simulation.losses();
    run.state_hash = simulation.state_hash();
    run.energy_closure = compute_energy_closure(run.history.energy);
    run.base_reaction_over_weight = base_reaction_over_weight(simulation);
    update_status(run, simulation);
}

/// Parts of the result that follow from specimen and plan.
void describe(RunResult& run, const Specimen& specimen, const TimePlan& plan) {
    run.time_step = plan.time_step;
    run.critical_time_step = find_critical_time_step(specimen.model);
    run.spine = specimen.spine;
    run.blocks = make_block_table(specimen);
    run.loads = specimen.load;
    run.beginning = specimen.beginning;
}

/// From sample `done`, or some steps after it, to the end of the plan. `start`: when this part of the run began.
void carry_on(RunResult& run, Simulation& simulation, const TimePlan& plan, SensorReader& sensors, std::uint64_t done,
              Clock::time_point start, const RunSettings& settings) {
    const double wall_time_before = run.wall_time;
    std::optional<CheckpointWriter> checkpoints;
    if (settings.checkpoint) checkpoints.emplace(*settings.checkpoint);
    const auto report = [&](std::uint64_t steps) {
        if (settings.observer.on_progress) settings.observer.on_progress(static_cast<double>(steps) / static_cast<double>(plan.steps()));
    };
    std::uint64_t steps = simulation.statistics().steps, taken_by_one = steps;
    const auto advance = [&](std::uint64_t count) {
        if (!sensors.has_sensors()) return simulation.advance(count);
        for (std::uint64_t k = 0; k < count; ++k) {
            simulation.advance(1);
            if (simulation.divergence()) return;
            sensors.read(++taken_by_one);
        }
    };
    for (std::uint64_t k = done + 1; k <= plan.samples; ++k) {
        const auto between = [&](std::uint64_t taken) {
            run.wall_time = wall_time_before + std::chrono::duration<double>(Clock::now() - start).count();
            if (checkpoints) checkpoints->between_samples(k - 1, plan, run, simulation);
            report(steps + taken);
        };
        detail::advance_in_pieces(simulation, k * plan.steps_per_sample - steps, advance, between);
        if (simulation.divergence()) break;
        steps = k * plan.steps_per_sample;
        add_sample(run, simulation);
        if (plan.samples_per_frame > 0 && k % plan.samples_per_frame == 0) add_frame(run, simulation);
        run.wall_time = wall_time_before + std::chrono::duration<double>(Clock::now() - start).count();
        if (checkpoints) checkpoints->after_sample(k, plan, run, simulation);
        if (settings.observer.on_sample) settings.observer.on_sample(run, plan);
        report(steps);
        if (settings.until_collapse && run.collapse_time) break;
        // a run that has come to its end has results
        if (k < plan.samples) scaling::stop_if_interrupted();
    }
    finish(run, simulation);
    run.wall_time = wall_time_before + std::chrono::duration<double>(Clock::now() - start).count();
}

/// Are the histories read from a checkpoint as long as its plan and progress say?
bool fits(const TimePlan& plan, std::uint64_t done, const RunResult& run) {
    const History& history = run.history;
    const std::size_t samples = static_cast<std::size_t>(done) + 1, of_spine = samples * run.spine.size();
    const std::size_t blocks = run.blocks.mass.size();
    const std::size_t frames = plan.samples_per_frame > 0 ? done / plan.samples_per_frame + 1 : 0;
    const auto all_of_size = [](std::size_t size, const auto&... vectors) { return ((vectors.size() == size) && ...); };
    return done <= plan.samples && all_of_size(samples, history.time, history.base, history.energy) &&
           all_of_size(samples * run.loads.size(), history.load) &&
           all_of_size(of_spine, history.spine_position, history.spine_velocity, history.spine_rotation) &&
           all_of_size(frames, run.frames.time) &&
           all_of_size(frames * blocks, run.frames.position, run.frames.quaternion, run.frames.velocity, run.frames.contact_force) &&
           all_of_size(blocks, run.falls.time, run.falls.displacement, run.falls.airborne) &&
           all_of_size(run.collapse_time ? blocks : 0, run.falls.at_collapse) &&
           (!run.origin || all_of_size(blocks, run.origin->position, run.origin->orientation)) &&
           all_of_size(blocks, run.initial.position, run.initial.orientation, run.initial.velocity, run.initial.angular_velocity);
}

}  // namespace

BlockTable make_block_table(const Specimen& specimen) {
    const Model& model = specimen.model;
    BlockTable table;
    for (const Block& block : model.blocks) {
        table.size.emplace_back(2.0 * half_extents(model, block));
        table.mass.push_back(block.mass);
    }
    table.layer = specimen.level.empty() ? specimen.layer : specimen.level;
    table.layer.resize(table.mass.size(), 0);
    table.name = specimen.name;
    table.shapes = list_block_shapes(model, {});
    return table;
}

void note_falls(RunResult& run, const Simulation& simulation, double time, const BaseState& base) {
    const Vector3 moved_base = run.origin ? Vector3(run.origin->base + base.displacement) : base.displacement;
    const auto displacement = [&](std::size_t b) {
        return Vector3((turn_back(base, simulation.position(b)) - run.standing_position()[b]) - moved_base);
    };
    const std::size_t blocks = run.falls.time.size();
    std::size_t fallen = 0, standing = 0;
    for (std::size_t b = 0; b < blocks; ++b) {
        if (run.falls.is_airborne(b)) continue;
        ++standing;
        if (!has_fallen_now(run, simulation, b, base)) continue;
        ++fallen;
        if (!std::isnan(run.falls.time[b])) continue;
        run.falls.time[b] = time;
        run.falls.displacement[b] = displacement(b);
    }
    const bool collapsed = standing > 0 && static_cast<double>(fallen) / static_cast<double>(standing) >= kCollapsedFraction;
    if (run.collapse_time || !collapsed) return;
    run.collapse_time = time;
    for (std::size_t b = 0; b < blocks; ++b) run.falls.at_collapse.push_back(displacement(b));
}

void update_status(RunResult& run, const Simulation& simulation) {
    run.divergence = simulation.divergence();
    if (run.divergence) {
        run.status = RunStatus::diverged;
    } else if (run.collapse_time) {
        run.status = RunStatus::collapsed;
    }
}

std::optional<Rest> settle_specimen(Simulation& simulation, const Specimen& specimen, const TimePlan& plan, const RunSettings& settings,
                                    const Checkpoint* from) {
    if (!specimen.settling) return std::nullopt;
    Rest rest;
    note_fallen(specimen, simulation.kinematics(), rest);
    SettlingSimulation settling = from != nullptr && from->settling
                                      ? SettlingSimulation(restore(specimen, *from, settings.threads))
                                      : SettlingSimulation(std::move(simulation), specimen.settling->damping_rate);
    const auto blocks = static_cast<double>(specimen.model.blocks.size());
    const RunObserver observer{.on_progress = settings.observer.on_preparation,
                               .on_preparation_spare = settings.observer.on_preparation_spare};
    detail::WorkDone work(observer, {.preparations = settings.preparations_to_follow,
                                     .block_steps = settings.runs_to_follow * static_cast<double>(plan.steps()) * blocks});
    CheckpointWriter checkpoints(settings.checkpoint.value_or(CheckpointSettings{}));
    SettlingWatch watch;
    watch.on_progress = [&](double part, std::uint64_t steps) {
        const double taken = blocks * static_cast<double>(steps);
        const double left = part > 0.0 ? taken * (1.0 - part) / part : std::numeric_limits<double>::infinity();
        work.report(specimen.preparation_work + taken, {left, left});
    };
    if (rest.collapsed) {
        // what has collapsed is looked at for as long as it takes to see whether it lies at rest
        watch.give_up = [looks = 0]() mutable { return ++looks > kChecksInARow; };
    } else if (settings.checkpoint) {
        watch.on_state = [&](const SettlingState& state) {
            checkpoints.after_look([&](const CheckpointSettings& to) { write_checkpoint(to, state, settling.state()); });
        };
    }
    rest = settle(settling, *specimen.settling, watch, from != nullptr && from->settling ? *from->settling : SettlingState{});
    note_fallen(specimen, settling.state().kinematics(), rest);
    simulation = std::move(settling).finish();
    return rest;
}

RunResult simulate(Simulation& simulation, const Specimen& specimen, const TimePlan& plan, RunStart begin, const RunSettings& settings) {
    const Clock::time_point start = Clock::now();
    RunResult run;
    describe(run, specimen, plan);
    run.rest = begin.rest;
    run.origin = std::move(begin.origin);
    run.wall_time = begin.wall_time;
    run.initial = simulation.kinematics();
    run.start_reaction_over_weight = base_reaction_over_weight(simulation);
    run.falls = begin.falls.time.empty() ? make_falls(specimen, run.initial) : std::move(begin.falls);
    reserve(run.history, plan, run.spine.size(), run.loads.size());
    add_sample(run, simulation);
    if (plan.samples_per_frame > 0) add_frame(run, simulation);
    SensorReader sensors = SensorReader::begin(simulation, specimen, plan, run);
    if (run.rest && run.rest->collapsed && !run.origin) {
        note_falls_before(specimen, *run.rest, run);
        finish(run, simulation);
        run.wall_time += std::chrono::duration<double>(Clock::now() - start).count();
    } else {
        carry_on(run, simulation, plan, sensors, 0, start, settings);
    }
    return run;
}

RunResult simulate(const Specimen& specimen, const TimePlan& plan, const RunSettings& settings, const Checkpoint* from) {
    const Clock::time_point start = Clock::now();
    Simulation simulation(specimen.model, plan.time_step, settings.threads);
    RunStart begin;
    begin.rest = settle_specimen(simulation, specimen, plan, settings, from);
    begin.wall_time = std::chrono::duration<double>(Clock::now() - start).count();
    return simulate(simulation, specimen, plan, std::move(begin), settings);
}

Simulation restore(const Specimen& specimen, const Checkpoint& checkpoint, int threads) {
    std::istringstream state(checkpoint.state);
    return Simulation::restore(specimen.model, state, threads);
}

void require_plan(const Checkpoint& checkpoint, const TimePlan& plan) {
    if (!(checkpoint.plan == plan)) throw std::runtime_error("checkpoint: its steps and samples are not those of its scene");
}

RunResult resume(Simulation& simulation, const Specimen& specimen, Checkpoint checkpoint, const RunSettings& settings) {
    const Clock::time_point start = Clock::now();
    RunResult run = std::move(checkpoint.run);
    describe(run, specimen, checkpoint.plan);
    const bool same_step = checkpoint.plan.time_step == simulation.time_step() && checkpoint.plan.steps_per_sample > 0 &&
                           simulation.statistics().steps / checkpoint.plan.steps_per_sample == checkpoint.samples_done;
    if (!same_step || !fits(checkpoint.plan, checkpoint.samples_done, run)) {
        throw std::runtime_error("checkpoint: its histories do not fit its state");
    }
    reserve(run.history, checkpoint.plan, run.spine.size(), run.loads.size());
    SensorReader sensors = SensorReader::resume(simulation, specimen, checkpoint.plan, run);
    carry_on(run, simulation, checkpoint.plan, sensors, checkpoint.samples_done, start, settings);
    return run;
}

RunResult recall_finished(const Specimen& specimen, Checkpoint checkpoint) {
    RunResult run = std::move(checkpoint.run);
    describe(run, specimen, checkpoint.plan);
    if (!fits(checkpoint.plan, checkpoint.samples_done, run)) throw std::runtime_error("checkpoint: its histories do not fit its plan");
    return run;
}

RunResult resume(const Specimen& specimen, Checkpoint checkpoint, const RunSettings& settings) {
    Simulation simulation = restore(specimen, checkpoint, settings.threads);
    return resume(simulation, specimen, std::move(checkpoint), settings);
}

Specimen make_moved_copy(Specimen specimen) {
    for (Block& block : specimen.model.blocks) {
        Eigen::Index largest = 0;
        block.position.cwiseAbs().maxCoeff(&largest);
        double& coordinate = block.position[largest];
        coordinate = std::nextafter(coordinate, std::numeric_limits<double>::infinity());
    }
    return specimen;
}

}  // namespace musim::lsdem
