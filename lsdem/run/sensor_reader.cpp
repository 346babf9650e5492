#include "lsdem/run/sensor_reader.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "lsdem/block_height.hpp"
#include "lsdem/rotation.hpp"
#include "records/processing/butterworth.hpp"

namespace musim::lsdem {
namespace {

using records::detail::apply_biquad;
using records::detail::Biquad;
using records::detail::BiquadMemory;

std::string name_body(const RunResult& run, const std::optional<std::size_t>& body) {
    return body ? run.blocks.label(*body) : std::string(kGroundName);
}

/// A history without readings.
SensorHistory make_history(const PlacedSensor& sensor, const ReadingPlan& readings, const RunResult& run) {
    SensorHistory history;
    history.name = sensor.name;
    history.kind = sensor.kind;
    history.axes = sensor.axes;
    history.bodies = {name_body(run, sensor.body)};
    if (sensor.kind == SensorKind::joint) history.bodies.push_back(name_body(run, sensor.other));
    history.relative = sensor.relative;
    history.gravity = sensor.gravity;
    history.interval = readings.steps * run.time_step;
    if (readings.corner_steps > 0.0) {
        history.corner = readings.corner_steps / run.time_step;
        history.order = readings.order;
        history.delay = records::find_low_pass_delay(readings.corner_steps, readings.order) * run.time_step;
    }
    return history;
}

/// Direction across a normal: the world's x for an upright one, in its plane; y where the normal lies along x, z along y. The limits are
/// no angles at which joints are drawn.
Vector3 find_across(const Vector3& normal) {
    constexpr double kMainly = 0.55;
    const Vector3 axis = std::abs(normal.z()) > kMainly   ? Vector3::UnitX()
                         : std::abs(normal.x()) > kMainly ? Vector3::UnitY()
                                                          : Vector3::UnitZ();
    return (axis - axis.dot(normal) * normal).normalized();
}

/// Memory of filters whose input has been constant for ever.
std::vector<double> settle(const std::vector<Biquad>& sections, const std::vector<double>& channels) {
    std::vector<double> memory;
    for (const double value : channels) {
        for (const Biquad& section : sections) {
            const BiquadMemory settled = BiquadMemory::settled(section, value, value);
            memory.insert(memory.end(), {settled.first, settled.second});
        }
    }
    return memory;
}

/// One step of all filters of a sensor.
void filter(const std::vector<Biquad>& sections, std::vector<double>& channels, std::vector<double>& memory) {
    std::size_t at = 0;
    for (double& value : channels) {
        for (const Biquad& section : sections) {
            BiquadMemory now{memory[at], memory[at + 1]};
            value = apply_biquad(section, value, now);
            memory[at] = now.first;
            memory[at + 1] = now.second;
            at += 2;
        }
    }
}

}  // namespace

SensorReader::PointMotion SensorReader::BodyState::follow(const Vector3& place) const {
    const Vector3 arm = orientation * place;
    return {position + arm, velocity + spin.cross(arm), acceleration + spin_rate.cross(arm) + spin.cross(spin.cross(arm))};
}

SensorReader::SensorReader(const Simulation& simulation, const Specimen& specimen, const TimePlan& plan, RunResult& run)
    : simulation_(&simulation), specimen_(&specimen), plan_(&plan), run_(&run) {
    for (const ReadingPlan& readings : plan.readings) {
        filters_.push_back(readings.corner_steps > 0.0 ? records::make_low_pass(readings.corner_steps, readings.order)
                                                       : std::vector<Biquad>{});
    }
}

SensorReader SensorReader::begin(const Simulation& simulation, const Specimen& specimen, const TimePlan& plan, RunResult& run) {
    if (plan.readings.size() != specimen.sensors.size()) throw std::invalid_argument("sensors: the plan has no readings for each");
    SensorReader reader(simulation, specimen, plan, run);
    for (std::size_t k = 0; k < specimen.sensors.size(); ++k) {
        SensorHistory& history = run.sensors.emplace_back(make_history(specimen.sensors[k], plan.readings[k], run));
        history.values.reserve((plan.readings[k].count + 1) * history.channels());
        SensorMemory& memory = run.sensor_memory.emplace_back();
        if (history.kind == SensorKind::joint) reader.set_up_joint(specimen.sensors[k], memory);
    }
    reader.look();
    for (std::size_t k = 0; k < specimen.sensors.size(); ++k) {
        SensorMemory& memory = run.sensor_memory[k];
        memory.last = reader.read_now(k);
        memory.filter = settle(reader.filters_[k], memory.last);
        run.sensors[k].values = memory.last;
    }
    return reader;
}

SensorReader SensorReader::resume(const Simulation& simulation, const Specimen& specimen, const TimePlan& plan, RunResult& run) {
    SensorReader reader(simulation, specimen, plan, run);
    const std::uint64_t steps = simulation.statistics().steps;
    bool fits = plan.readings.size() == specimen.sensors.size() && run.sensors.size() == specimen.sensors.size() &&
                run.sensor_memory.size() == specimen.sensors.size();
    for (std::size_t k = 0; fits && k < run.sensors.size(); ++k) {
        SensorHistory& history = run.sensors[k];
        const SensorMemory& memory = run.sensor_memory[k];
        const std::size_t channels = memory.last.size();
        const auto due = static_cast<std::size_t>(static_cast<double>(steps) / plan.readings[k].steps) + 1;
        fits = history.kind == specimen.sensors[k].kind && (channels == history.channels() || channels == 0) &&
               memory.filter.size() == 2 * channels * reader.filters_[k].size() && history.values.size() % history.channels() == 0 &&
               history.readings() <= due && history.values.empty() == (channels == 0);
        if (fits) history.values.reserve((plan.readings[k].count + 1) * history.channels());
    }
    if (!fits) throw std::runtime_error("checkpoint: its sensors are not those of its scene");
    return reader;
}

void SensorReader::look() {
    const auto is_joint = [](const PlacedSensor& sensor) { return sensor.kind == SensorKind::joint; };
    if (std::any_of(specimen_->sensors.begin(), specimen_->sensors.end(), is_joint)) forces_ = simulation_->contact_forces();
}

void SensorReader::read(std::uint64_t step) {
    look();
    const auto now = static_cast<double>(step);
    for (std::size_t k = 0; k < specimen_->sensors.size(); ++k) {
        SensorMemory& memory = run_->sensor_memory[k];
        SensorHistory& history = run_->sensors[k];
        const ReadingPlan& readings = plan_->readings[k];
        std::vector<double> channels = read_now(k);
        if (channels.empty()) continue;
        filter(filters_[k], channels, memory.filter);
        // a reading falls between the last step and this one, or on this one; none is as long as a step, so that there is one at most
        const double due = static_cast<double>(history.readings()) * readings.steps;
        if (due <= now && history.readings() <= readings.count) {
            const double part = due - (now - 1.0);
            for (std::size_t c = 0; c < channels.size(); ++c) {
                history.values.push_back((1.0 - part) * memory.last[c] + part * channels[c]);
            }
        }
        memory.last = std::move(channels);
    }
}

SensorReader::BodyState SensorReader::find_base() const {
    const BaseState base = simulation_->base();
    const Vector3 origin = base.displacement + (base.pivot - base.turn * base.pivot);
    return {origin,    base.velocity_at(origin), base.acceleration_at(origin),
            base.turn, base.turn_rates.velocity, base.turn_rates.acceleration};
}

SensorReader::BodyState SensorReader::find_body(const std::optional<std::size_t>& body) const {
    if (!body) return find_base();
    const Model& model = simulation_->model();
    const Block& block = model.blocks[*body];
    BodyState state{simulation_->position(*body),    Vector3::Zero(), Vector3::Zero(),
                    simulation_->orientation(*body), Vector3::Zero(), Vector3::Zero()};
    if (block.with_base) {
        const BodyState base = find_base();
        const PointMotion motion = base.follow(base.orientation.conjugate() * (state.position - base.position));
        state.velocity = motion.velocity;
        state.acceleration = motion.acceleration;
        state.spin = base.spin;
        state.spin_rate = base.spin_rate;
    } else if (!block.fixed) {
        state.velocity = simulation_->velocity(*body);
        state.acceleration = simulation_->contact_force(*body) / block.mass + model.gravity;
        state.spin = simulation_->angular_velocity(*body);
        if (block.rotation_locked) return state;
        // Euler's equations about the principal axes
        const Vector3 inertia = block.mass * inertia_over_mass(model, block);
        const Vector3 spin = state.orientation.conjugate() * state.spin;
        const Vector3 torque = state.orientation.conjugate() * simulation_->contact_torque(*body);
        state.spin_rate = state.orientation * (torque - spin.cross(inertia.cwiseProduct(spin))).cwiseQuotient(inertia);
    }
    return state;
}

SensorReader::BodyState SensorReader::find_start(const std::optional<std::size_t>& body) const {
    BodyState start{Vector3::Zero(), Vector3::Zero(), Vector3::Zero(), Quaternion::Identity(), Vector3::Zero(), Vector3::Zero()};
    if (!body) return start;
    start.position = run_->initial.position[*body];
    start.orientation = run_->initial.orientation[*body];
    return start;
}

std::vector<double> SensorReader::read_now(std::size_t index) const {
    const PlacedSensor& sensor = specimen_->sensors[index];
    const SensorMemory& memory = run_->sensor_memory[index];
    if (sensor.kind == SensorKind::joint) return memory.normal.isZero(0.0) ? std::vector<double>{} : read_joint(sensor, memory);

    const BodyState body = find_body(sensor.body), start = find_start(sensor.body), base = find_base();
    const PointMotion point = body.follow(*sensor.place);
    const Vector3 from_base = point.position - base.position;
    const Vector3 against_base = point.velocity - base.velocity - base.spin.cross(from_base);
    Vector3 reading = Vector3::Zero();  // world axes
    switch (sensor.kind) {
        case SensorKind::acceleration:
            reading = point.acceleration;
            if (sensor.relative) {
                reading -= base.acceleration + base.spin_rate.cross(from_base) + base.spin.cross(base.spin.cross(from_base)) +
                           2.0 * base.spin.cross(against_base);
            }
            if (sensor.gravity) reading -= simulation_->model().gravity;
            break;
        case SensorKind::velocity:
            reading = sensor.relative ? against_base : point.velocity;
            break;
        case SensorKind::displacement: {
            const Vector3 began = start.follow(*sensor.place).position;
            reading = sensor.relative ? Vector3(from_base - base.orientation * began) : Vector3(point.position - began);
            break;
        }
        case SensorKind::rotation:
            reading = sensor.relative
                          ? Vector3(base.orientation * rotation_vector(start.orientation, base.orientation.conjugate() * body.orientation))
                          : rotation_vector(start.orientation, body.orientation);
            break;
        case SensorKind::angular_velocity:
            reading = sensor.relative ? Vector3(body.spin - base.spin) : body.spin;
            break;
        case SensorKind::joint:
            break;
    }
    if (sensor.axes == SensorAxes::base) reading = base.orientation.conjugate() * reading;
    if (sensor.axes == SensorAxes::block) reading = body.orientation.conjugate() * reading;
    reading = sensor.mount.conjugate() * reading;
    return {reading.x(), reading.y(), reading.z()};
}

void SensorReader::set_up_joint(const PlacedSensor& joint, SensorMemory& memory) const {
    const BodyState first = find_start(joint.body), second = find_start(joint.other);
    // the area in which the two meet
    double area = 0.0;
    Vector3 middle = Vector3::Zero(), normal = Vector3::Zero();
    for (const JointStiffness& at : simulation_->joint_stiffness()) {
        const bool ahead = joint.body == std::optional(at.leader) && joint.other == at.follower;
        const bool behind = joint.other == std::optional(at.leader) && joint.body == at.follower;
        if (!ahead && !behind) continue;
        area += at.area;
        middle += at.area * at.middle;
        normal += (behind ? at.area : -at.area) * at.normal;
    }
    if (joint.normal) normal = second.orientation * *joint.normal;
    const bool is_somewhere = joint.place || area > 0.0;
    if (!is_somewhere || normal.isZero(0.0)) return;
    normal.normalize();
    const Vector3 place = joint.place ? second.follow(*joint.place).position : Vector3(middle / area);
    memory.place = {Vector3(first.orientation.conjugate() * (place - first.position)),
                    Vector3(second.orientation.conjugate() * (place - second.position))};
    memory.normal = second.orientation.conjugate() * normal;
    memory.across = second.orientation.conjugate() * find_across(normal);
}

Vector3 SensorReader::find_force(const PlacedSensor& joint) const {
    Vector3 force = Vector3::Zero();
    for (const ContactForce& contact : forces_) {
        if (joint.body == std::optional(contact.leader) && joint.other == contact.follower) force += contact.force;
        if (joint.other == std::optional(contact.leader) && joint.body == contact.follower) force -= contact.force;
    }
    return force;
}

std::vector<double> SensorReader::read_joint(const PlacedSensor& joint, const SensorMemory& memory) const {
    const BodyState first = find_body(joint.body), second = find_body(joint.other);
    const Vector3 normal = second.orientation * memory.normal, across = second.orientation * memory.across, third = normal.cross(across);
    const Vector3 apart = first.follow(memory.place[0]).position - second.follow(memory.place[1]).position;
    const Vector3 force = find_force(joint);
    return {apart.dot(normal), apart.dot(across), apart.dot(third), force.dot(normal), force.dot(across), force.dot(third)};
}

}  // namespace musim::lsdem
