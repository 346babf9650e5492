#include "records/synthesis/sine_sweep.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "records/formats/detail/made_record.hpp"
#include "records/processing/processing.hpp"

namespace musim::records {
namespace {

constexpr const char* kSineSweep = "sine sweep";

/// Cycles from the start to the share τ of the duration, in units of the cycles that a whole duration at f₀ would have.
double count_cycles(SweepKind kind, double ratio, double tau) {
    if (kind == SweepKind::linear) return tau + 0.5 * (ratio - 1.0) * tau * tau;
    return std::expm1(std::log(ratio) * tau) / std::log(ratio);
}

void check(const SineSweepSettings& settings) {
    detail::require_positive(kSineSweep, {{"amplitude", settings.amplitude.value()},
                                          {"first frequency", settings.first.value()},
                                          {"last frequency", settings.last.value()},
                                          {"time step", settings.dt.value()},
                                          {"duration", settings.duration.value()}});
    if (settings.first == settings.last) {
        throw ProcessingError(fmt::format("{}: both frequencies are {} Hz (must differ); change one", kSineSweep, settings.first.value()));
    }
    detail::require_sampled(kSineSweep, std::max(settings.first, settings.last).value(), settings.dt.value());
}

}  // namespace

GroundMotion make_sine_sweep_record(const SineSweepSettings& settings) {
    check(settings);
    const double steps = std::round(settings.duration.value() / settings.dt.value());
    constexpr double kFewestSteps = 64.0;  // eight periods of the fastest sine
    detail::require_steps(kSineSweep, steps, kFewestSteps);
    const double ratio = settings.last.value() / settings.first.value();
    const double cycles = settings.first.value() * settings.dt.value() * steps;
    std::vector<double> samples(static_cast<std::size_t>(steps) + 1);
    for (std::size_t i = 0; i < samples.size(); ++i) {
        const double phase = 2.0 * std::numbers::pi * cycles * count_cycles(settings.kind, ratio, static_cast<double>(i) / steps);
        samples[i] = settings.amplitude.value() * std::sin(phase);
    }
    const TimeSeries sweep(SampleQuantity::acceleration, {}, settings.dt, std::move(samples));
    const TimeSeries rested = bring_to_rest(taper(sweep, settings.taper));
    return detail::make_record(
        fmt::format("{}, {:.6g} to {:.6g} Hz", kSineSweep, settings.first.value(), settings.last.value()),
        fmt::format("{} {}, {:.9g} to {:.9g} Hz in {:.9g} s, amplitude {:.9g} m/s^2, taper {:.9g} of each end; brought to rest",
                    settings.kind == SweepKind::linear ? "linear" : "logarithmic", kSineSweep, settings.first.value(),
                    settings.last.value(), steps * settings.dt.value(), settings.amplitude.value(), settings.taper),
        settings.dt, {rested.samples().begin(), rested.samples().end()});
}

}  // namespace musim::records
