#include "lsdem/scene/base_components.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "lsdem/scene/scene_error.hpp"
#include "lsdem/scene/scene_key.hpp"
#include "records/formats/read_record.hpp"
#include "records/processing/base_motion.hpp"
#include "records/processing/surface_rotation.hpp"
#include "records/synthesis/ricker.hpp"
#include "records/synthesis/synthetic.hpp"

namespace musim::lsdem {

namespace {

using std::numbers::pi;

/// Samples per period of a formula: the piecewise linear velocity is then off by (2π/200)²/8, 1.2e-4 of its amplitude.
constexpr double kSamplesPerPeriod = 200.0;

/// A Ricker wavelet is cut this many periods before and after its peak, where its velocity has fallen to 1e-9 of its largest.
constexpr double kRickerReach = 1.5;

/// Samples of a velocity [m/s] over `length` [s], about `dt` [s] apart so that the last one falls on the end.
template <class Velocity>
BaseComponent sample(double length, double dt, const Velocity& velocity) {
    const double intervals = std::max(1.0, std::round(length / dt));
    BaseComponent component{.start = 0.0, .dt = length / intervals, .velocity = {}};
    const auto count = static_cast<std::size_t>(intervals) + 1;
    component.velocity.reserve(count);
    for (std::size_t k = 0; k < count; ++k) component.velocity.push_back(velocity(static_cast<double>(k) * component.dt));
    return component;
}

double sample_step(const SignalMotion& motion, double period) { return motion.dt ? motion.dt->value() : period / kSamplesPerPeriod; }

BaseComponent make_component(const StepSignal& signal, const SignalMotion& /*motion*/) {
    return {.start = 0.0, .dt = 0.0, .velocity = {signal.velocity.value()}};
}

double peak_of(const StepSignal& /*signal*/) { return 0.0; }
double peak_of(const SyntheticSignal& signal) { return signal.pga.value(); }
double peak_of(const RockingSignal& /*signal*/) { return 0.0; }
template <class Wave>
double peak_of(const Wave& signal) {
    return std::abs(signal.amplitude.value());
}

/// The velocity of an acceleration of amplitude `amplitude` that follows a sine of circular frequency `omega` from rest.
BaseComponent make_sine(scaling::Acceleration amplitude, double omega, double length, double dt) {
    return sample(length, dt, [peak = amplitude.value() / omega, omega](double t) { return peak * (1.0 - std::cos(omega * t)); });
}

BaseComponent make_component(const SineSignal& signal, const SignalMotion& motion) {
    const double period = 1.0 / signal.frequency.value();
    return make_sine(signal.amplitude, 2.0 * pi * signal.frequency.value(), signal.cycles * period, sample_step(motion, period));
}

BaseComponent make_component(const HalfSineSignal& signal, const SignalMotion& motion) {
    const double duration = signal.duration.value();
    return make_sine(signal.amplitude, pi / duration, duration, sample_step(motion, 2.0 * duration));
}

BaseComponent make_component(const RickerSignal& signal, const SignalMotion& motion) {
    const double period = 1.0 / signal.frequency.value();
    const records::RickerWavelet wavelet{.amplitude = signal.amplitude, .frequency = signal.frequency};
    BaseComponent component = sample(2.0 * kRickerReach * period, sample_step(motion, period), [&](double t) {
        return wavelet.velocity((t - kRickerReach * period) * scaling::si::seconds).value();
    });
    component.velocity.front() = component.velocity.back() = 0.0;
    return component;
}

BaseComponent to_component(const records::TimeSeries& velocity, scaling::Time origin) {
    const auto samples = velocity.samples();
    return {.start = (velocity.start() - origin).value(), .dt = velocity.dt().value(), .velocity = {samples.begin(), samples.end()}};
}

MotionSource find_source(const records::RecordedMotion& record) {
    const auto copy = [](std::span<const double> samples) { return std::vector<double>(samples.begin(), samples.end()); };
    return {.velocity = copy(record.velocity.samples()),
            .acceleration = record.acceleration ? copy(record.acceleration->samples()) : std::vector<double>(),
            .peak_acceleration = 0.0};
}

BaseComponent make_component(const SyntheticSignal& signal, const SignalMotion& /*motion*/) {
    const records::GroundMotion motion = records::make_synthetic_record(
        {.pga = signal.pga, .pgv = signal.pgv, .dt = signal.dt, .duration = signal.duration, .seed = signal.seed});
    const records::BaseMotion base = records::make_base_motion(motion.components.front().series);
    return to_component(base.velocity, base.velocity.start());
}

/// Rate of the angle of a rocking base [rad/s].
BaseComponent make_component(const RockingSignal& signal, const SignalMotion& motion) {
    const double period = 1.0 / signal.frequency.value(), omega = 2.0 * pi / period, length = signal.cycles * period;
    return sample(length, sample_step(motion, period), [&](double t) {
        const double from_end = length - t, aside = std::min(t, from_end);
        const bool is_inside = aside >= period;
        const double part = is_inside ? 1.0 : 0.5 * (1.0 - std::cos(0.5 * omega * aside));
        const double slope = is_inside ? 0.0 : (t < from_end ? 0.25 : -0.25) * omega * std::sin(0.5 * omega * aside);
        return signal.angle.value() * (slope * std::sin(omega * t) + part * omega * std::cos(omega * t));
    });
}

/// Intervals of a tilt, in the first and the last of which its rate grows and falls.
constexpr std::size_t kTiltIntervals = 64;

BaseComponents make_motion(std::monostate /*still*/, const std::string& /*place*/) { return {}; }

BaseComponents make_motion(const TiltMotion& motion, const std::string& /*place*/) {
    BaseComponents made;
    BaseComponent& turn = made.turn.at(motion.about);
    turn.dt = motion.duration().value() / static_cast<double>(kTiltIntervals);
    turn.velocity.assign(kTiltIntervals + 1, motion.rate.value());
    turn.velocity.front() = turn.velocity.back() = 0.0;
    return made;
}

/// The component along or about one of kMotionAxes.
BaseComponent& component_of(BaseComponents& motion, std::size_t axis) {
    return axis < 3 ? motion.shift.at(axis) : motion.turn.at(axis - 3);
}

BaseComponents make_motion(const SignalMotion& motion, const std::string& /*place*/) {
    BaseComponents made;
    BaseComponent& component = component_of(made, motion.axis);
    component = std::visit([&](const auto& signal) { return make_component(signal, motion); }, motion.signal);
    component.start += motion.start.value();
    component.source.peak_acceleration = std::visit([](const auto& signal) { return peak_of(signal); }, motion.signal);
    return made;
}

/// Where the record's clock reads zero in the simulation.
scaling::Time find_time_origin(const RecordMotion& motion, const records::GroundMotion& record) {
    if (motion.window) return (*motion.window)[0];
    std::optional<scaling::Time> earliest;
    for (const auto& name : motion.components) {
        if (!name) continue;
        const scaling::Time start = record.find_component(*name).series.start();
        earliest = earliest ? std::min(*earliest, start) : start;
    }
    return earliest.value_or(scaling::Time{});
}

/// Reads the record of a scene, whose keys are the remedies of what is wrong with it.
records::GroundMotion read_scene_record(const RecordMotion& motion) {
    try {
        return records::read_record(motion.file, {.dt = motion.dt,
                                                  .unit = motion.unit,
                                                  .quantity = motion.quantity,
                                                  .sensitivity = motion.sensitivity,
                                                  .station_xml = motion.station_xml,
                                                  .columns = motion.columns,
                                                  .skipped_lines = motion.skip});
    } catch (const records::ReadError& error) {
        throw records::ReadError(error.worded(scene_key));
    }
}

/// The record with a component that suits its axis: what is named for a turn is a rotation, or becomes one by an apparent velocity.
records::GroundMotion find_for_axis(const records::GroundMotion& record, const RecordMotion& motion, std::size_t axis,
                                    const std::string& place) {
    const records::Component& component = record.find_component(*motion.components[axis]);
    const bool rotates = records::is_rotation(component), turns = axis >= 3;
    if (rotates == turns) return record;
    const auto fail = [&](std::string_view why) {
        throw SceneError(fmt::format("{}/components/{}: component {} is {}", place, kMotionAxes.at(axis), component.name, why));
    };
    if (rotates) fail("a rotation (the base moves along this axis); name it for rx, ry or rz");
    if (!motion.apparent_velocity) {
        fail("a translation (the base turns about this axis); name a rotation, or give the \"apparent_velocity\" of the waves");
    }
    if (axis == 3) fail("a translation (waves along x turn the ground about y and z only); name it for ry or rz");
    records::GroundMotion turned = record;
    for (records::Component& each : turned.components) {
        if (each.name != component.name) continue;
        each.series = axis == 4 ? records::find_rocking(each.series, *motion.apparent_velocity)
                                : records::find_torsion(each.series, *motion.apparent_velocity);
    }
    return turned;
}

BaseComponents make_motion(const RecordMotion& motion, const std::string& place) {
    const records::GroundMotion record = read_scene_record(motion);
    const scaling::Time origin = find_time_origin(motion, record);
    records::BaseMotionSettings settings;
    settings.high_pass = motion.highpass_corner;
    settings.at_rest = motion.at_rest;
    if (motion.window) settings.window = records::TimeWindow{(*motion.window)[0], (*motion.window)[1]};

    BaseComponents made;
    for (std::size_t axis = 0; axis < kMotionAxes.size(); ++axis) {
        if (!motion.components[axis]) continue;
        const records::BaseMotion base =
            records::make_base_motion(find_for_axis(record, motion, axis, place), *motion.components[axis], settings);
        component_of(made, axis) = to_component(base.velocity, origin);
        component_of(made, axis).source = find_source(base.record);
    }
    return made;
}

void scale(BaseComponents& motion, const MotionFactors& factors) {
    for (std::size_t axis = 0; axis < motion.shift.size(); ++axis) {
        BaseComponent& component = motion.shift[axis];
        component.start *= factors.time;
        component.dt *= factors.time;
        const double velocity = axis == 2 ? factors.velocity_vertical : factors.velocity;
        for (double& v : component.velocity) v *= velocity;
        for (double& v : component.source.velocity) v *= velocity;
        for (double& a : component.source.acceleration) a *= velocity / factors.time;
        component.source.peak_acceleration *= velocity / factors.time;
    }
    for (BaseComponent& component : motion.turn) {
        component.start *= factors.time;
        component.dt *= factors.time;
        for (double& rate : component.velocity) rate /= factors.time;
        for (double& rate : component.source.velocity) rate /= factors.time;
        for (double& a : component.source.acceleration) a /= factors.time * factors.time;
    }
}

}  // namespace

scaling::Time TiltMotion::duration() const {
    constexpr auto kWhole = static_cast<double>(kTiltIntervals);
    return until / rate * (kWhole / (kWhole - 1.0));
}

BaseComponents make_base_components(const SceneMotion& motion, const std::string& place) {
    try {
        BaseComponents made = std::visit([&](const auto& source) { return make_motion(source, place); }, motion.source);
        if (const auto* record = std::get_if<RecordMotion>(&motion.source); record != nullptr && record->scale) {
            const scaling::Similitude similitude = make_similitude(*record->scale);
            scale(made, {similitude.time(), similitude.velocity(), similitude.velocity_vertical()});
        }
        scale(made, motion.factors);
        if (motion.pivot) made.pivot = {(*motion.pivot)[0].value(), (*motion.pivot)[1].value(), (*motion.pivot)[2].value()};
        return made;
    } catch (const records::ProcessingError& error) {
        throw error.seen_from<SceneError>(place);
    }
}

}  // namespace musim::lsdem
