#include "lsdem/run/motion_summary.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "lsdem/base_motion.hpp"
#include "records/measures/measures.hpp"
#include "records/measures/response_spectrum.hpp"
#include "scaling/angle.hpp"
#include "scaling/detail/overloaded.hpp"
#include "scaling/quantity_text.hpp"

namespace musim::lsdem {
namespace {

constexpr std::array kAxes{'x', 'y', 'z'};

/// Periods at which PSA is computed, the shortest in samples [-].
constexpr std::size_t kPeriods = 61;
constexpr double kShortestPeriod = 4.0;

/// "along x", "about y".
std::string name_motion_axis(std::size_t axis) { return fmt::format("{} {}", axis < 3 ? "along" : "about", "xyz"[axis % 3]); }

std::string describe_record(const RecordMotion& record) {
    std::string text = "record " + record.file.filename().string();
    for (std::size_t axis = 0; axis < kMotionAxes.size(); ++axis) {
        if (record.components[axis]) text += fmt::format(", component {} {}", *record.components[axis], name_motion_axis(axis));
    }
    if (record.window) {
        text += fmt::format(", {} to {}", scaling::format_quantity((*record.window)[0]), scaling::format_quantity((*record.window)[1]));
    }
    if (record.highpass_corner) text += ", high-pass " + scaling::format_quantity(*record.highpass_corner);
    return text;
}

std::string describe_source(const SceneMotion& motion) {
    using scaling::detail::Overloaded;
    const auto name_signal = Overloaded{[](const StepSignal&) { return "step"; },           [](const SineSignal&) { return "sine"; },
                                        [](const HalfSineSignal&) { return "half sine"; },  [](const RickerSignal&) { return "Ricker"; },
                                        [](const SyntheticSignal&) { return "synthetic"; }, [](const RockingSignal&) { return "rocking"; }};
    return std::visit(Overloaded{[](std::monostate) { return std::string("none, the base rests"); },
                                 [](const RecordMotion& record) { return describe_record(record); },
                                 [&](const SignalMotion& signal) {
                                     return fmt::format("{} signal {}", std::visit(name_signal, signal.signal),
                                                        name_motion_axis(signal.axis));
                                 },
                                 [](const TiltMotion& tilt) {
                                     return fmt::format("tilt {} at {} up to {:.6g} deg", name_motion_axis(3 + tilt.about),
                                                        scaling::format_quantity(tilt.rate), tilt.until.value() / scaling::kDegree);
                                 }},
                      motion.source);
}

/// Predominant period of a velocity that is linear between samples, whose acceleration is constant there, up to `end` [s]; nothing of a
/// motion that is too short.
std::optional<double> find_predominant_period(const BaseComponent& component, double end) {
    std::vector<double> acceleration;
    for (std::size_t k = 1; k < component.velocity.size(); ++k) {
        if (component.start + static_cast<double>(k) * component.dt > end) break;
        acceleration.push_back((component.velocity[k] - component.velocity[k - 1]) / component.dt);
    }
    const double first = kShortestPeriod * component.dt, last = 0.5 * static_cast<double>(acceleration.size()) * component.dt;
    if (!(first < last)) return std::nullopt;
    const auto seconds = [](double value) { return scaling::Time::from_value(value); };
    const records::TimeSeries series(records::SampleQuantity::acceleration, seconds(0.0), seconds(component.dt), acceleration);
    const std::vector<scaling::Time> periods = records::make_periods(seconds(first), seconds(last), kPeriods);
    const std::optional<scaling::Time> period = records::find_predominant_period(records::compute_response_spectrum(series, periods));
    return period ? std::optional(period->value()) : std::nullopt;
}

AxisMotion measure_axis(const BaseMotion& base, const BaseComponent& component, std::size_t axis, double end) {
    const auto a = static_cast<int>(axis);
    AxisMotion measured{
        .axis = kAxes[axis], .pga = base.peak_acceleration(end)[a], .predominant_period = find_predominant_period(component, end)};
    for (std::size_t k = 0; k < component.velocity.size(); ++k) {
        const double time = component.start + static_cast<double>(k) * component.dt;
        if (time > end) break;
        measured.pgv = std::max(measured.pgv, std::abs(component.velocity[k]));
        measured.pgd = std::max(measured.pgd, std::abs(base.displacement(time)[a]));
    }
    // between samples, or after the last one, where it moves on
    measured.pgd = std::max(measured.pgd, std::abs(base.displacement(end)[a]));
    return measured;
}

AxisTurn measure_turn(const BaseMotion& base, const BaseComponent& component, std::size_t axis, double end) {
    AxisTurn measured{.axis = kAxes[axis]};
    const auto a = static_cast<int>(axis);
    for (std::size_t k = 0; k < component.velocity.size(); ++k) {
        const double time = component.start + static_cast<double>(k) * component.dt;
        if (time > end) break;
        measured.angle = std::max(measured.angle, std::abs(base.angle(time)[a]));
        measured.rate = std::max(measured.rate, std::abs(component.velocity[k]));
        if (k == 0) continue;
        measured.acceleration = std::max(measured.acceleration, std::abs(component.velocity[k] - component.velocity[k - 1]) / component.dt);
    }
    measured.angle = std::max(measured.angle, std::abs(base.angle(end)[a]));
    return measured;
}

}  // namespace

MotionSummary summarize_motion(const Scene& scene, const std::string& name, const BaseComponents& base, const TimePlan& plan) {
    MotionSummary summary{.name = name, .source = describe_source(scene.base_motion), .base = base, .plan = plan};
    const BaseMotion motion(base);
    const BaseChanges changes = find_base_changes(base, plan.duration());
    for (std::size_t axis = 0; axis < base.shift.size(); ++axis) {
        if (base.shift[axis].velocity.empty()) continue;
        summary.axes.push_back(measure_axis(motion, base.shift[axis], axis, plan.duration()));
        summary.axes.back().change = changes[axis];
    }
    for (std::size_t axis = 0; axis < base.turn.size(); ++axis) {
        if (!base.turn[axis].velocity.empty()) summary.turns.push_back(measure_turn(motion, base.turn[axis], axis, plan.duration()));
    }
    const auto* record = std::get_if<RecordMotion>(&scene.base_motion.source);
    if (record != nullptr && record->scale) summary.similitude = make_similitude(*record->scale);
    return summary;
}

}  // namespace musim::lsdem
