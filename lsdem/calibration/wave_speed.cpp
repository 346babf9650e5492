#include "lsdem/calibration/wave_speed.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>
#include <stdexcept>

#include "lsdem/motion/simulation.hpp"
#include "lsdem/response/line_fit.hpp"
#include "lsdem/run/no_slip.hpp"
#include "lsdem/time_step.hpp"
#include "scaling/interruption.hpp"

namespace musim::lsdem {
namespace {

/// Velocity of the base [block heights per second] [Harmon23, 4.2].
constexpr double kBaseSpeed = 0.8;

/// Step of the test and of the ideal chain [1/ω0]: the front of leapfrog is early by (ω0·dt)²/24, 2e-5 and 4e-6 of its time.
constexpr double kStep = 0.02, kIdealStep = 0.01;

/// Simulated time after the wave has passed all layers [1/ω0]: the top reaches the displacement criterion, 5/ω0, well before.
constexpr double kAfter = 15.0;

/// The displacement that counts as arrival [V/ω0].
constexpr double kArrivalDisplacement = 5.0;

constexpr int kLeastLayers = 20;
constexpr double kFirstFraction = 5.0 / 38.0, kLastFraction = 30.0 / 38.0;
constexpr int kMostRuns = 20;
constexpr double kSpeedTolerance = 1e-6;

double stiffness_of(const BlockSample& sample, WaveKind kind) {
    return kind == WaveKind::normal ? sample.normal_stiffness : sample.shear_stiffness;
}

double frequency(const BlockSample& sample, WaveKind kind) { return std::sqrt(stiffness_of(sample, kind) / sample.mass()); }

void require_layers(int layers) {
    if (layers < kLeastLayers) {
        throw std::invalid_argument(fmt::format(
            "wave test: {} layers (the wave returning from the top would disturb the fit); take {} or more", layers, kLeastLayers));
    }
}

/// First time at which a history reaches a level, linear between samples.
double find_arrival(std::span<const double> time, std::span<const double> value, double level) {
    for (std::size_t k = 1; k < value.size(); ++k)
        if (value[k] >= level) return time[k] - (time[k] - time[k - 1]) * (value[k] - level) / (value[k] - value[k - 1]);
    return std::numeric_limits<double>::quiet_NaN();
}

/// Arrival at every layer; `omega` [1/s] is that of the chain.
std::vector<double> find_arrivals(const WaveHistory& history, ArrivalCriterion criterion, double omega) {
    std::vector<double> arrivals;
    for (std::size_t n = 0; n < history.displacement.size(); ++n) {
        arrivals.push_back(criterion == ArrivalCriterion::half_velocity
                               ? find_arrival(history.time, history.velocity[n], 0.5 * history.base_velocity)
                               : find_arrival(history.time, history.displacement[n], kArrivalDisplacement * history.base_velocity / omega));
    }
    return arrivals;
}

/// Fits the arrivals of a column of blocks `height` high.
WaveSpeed fit_speed(std::vector<double> arrival, double height) {
    const auto layers = static_cast<double>(arrival.size());
    WaveSpeed result;
    result.first_layer = static_cast<int>(std::lround(kFirstFraction * layers));
    result.last_layer = static_cast<int>(std::lround(kLastFraction * layers));
    std::vector<double> place, time;
    for (int n = result.first_layer; n <= result.last_layer; ++n) {
        place.push_back(height * n);
        time.push_back(arrival[static_cast<std::size_t>(n - 1)]);
    }
    const LineFit fit = fit_line(place, time);
    result.speed = 1.0 / fit.slope;
    result.standard_error = fit.slope_error / (fit.slope * fit.slope);
    result.arrival = std::move(arrival);
    return result;
}

/// The column at rest under its weight: every joint is compressed by what stands above it.
Model make_column(const BlockSample& sample, int layers) {
    Model model = make_model(sample);
    double top = 0.0;
    for (int i = 0; i < layers; ++i) {
        top -= (layers - i) * sample.mass() * sample.gravity / sample.normal_stiffness;
        Block block = make_block(sample, {0.0, 0.0, top + 0.5 * sample.size.z()});
        block.rotation_locked = true;
        model.blocks.push_back(block);
        top += sample.size.z();
    }
    return model;
}

/// The front in a chain of unit masses and springs, ω0 = V = 1.
WaveHistory run_ideal_chain(int layers) {
    const auto n = static_cast<std::size_t>(layers);
    WaveHistory history{.base_velocity = 1.0, .time = {}, .displacement = {}, .velocity = {}};
    history.displacement.resize(n);
    history.velocity.resize(n);
    std::vector<double> u(n + 2, 0.0), v(n + 2, 0.0), before(n + 2, 0.0);
    for (double t = 0.0; t < layers + kAfter; t += kIdealStep) {
        history.time.push_back(t);
        u[0] = t;
        u[n + 1] = u[n];  // the top is free
        before = v;
        for (std::size_t i = 1; i <= n; ++i) v[i] += kIdealStep * (u[i - 1] - 2.0 * u[i] + u[i + 1]);
        for (std::size_t i = 1; i <= n; ++i) {
            history.displacement[i - 1].push_back(u[i]);
            // at rest before the step: the first value of v is half a step ahead
            history.velocity[i - 1].push_back(0.5 * (before[i] + v[i]));
            u[i] += kIdealStep * v[i];
        }
    }
    return history;
}

}  // namespace

std::string to_string(ArrivalCriterion criterion) {
    return criterion == ArrivalCriterion::half_velocity ? "half_velocity" : "displacement";
}

double base_velocity(const BlockSample& sample) { return kBaseSpeed * sample.size.z(); }

double closed_form_speed(const BlockSample& sample, WaveKind kind) { return sample.size.z() * frequency(sample, kind); }

WaveHistory run_wave_test(const BlockSample& given, WaveKind kind, const WaveSettings& settings) {
    require_layers(settings.layers);
    BlockSample sample = given;
    sample.friction = sample.ground_friction = detail::kNoSlip;
    if (!settings.damped) sample.restitution = 1.0, sample.shear_damping_ratio = 0.0;
    Model model = make_column(sample, settings.layers);
    const int axis = kind == WaveKind::normal ? 2 : 0;
    WaveHistory history{.base_velocity = base_velocity(sample), .time = {}, .displacement = {}, .velocity = {}};
    model.ground.motion.shift[static_cast<std::size_t>(axis)] = {0.0, 0.0, {history.base_velocity}};

    const double omega = frequency(sample, kind);
    const double step = std::min(kStep / omega, 0.5 * compute_critical_time_step(model));
    const auto n = static_cast<std::size_t>(settings.layers);
    history.displacement.resize(n);
    history.velocity.resize(n);
    Simulation simulation(model, step);
    for (const double end = (settings.layers + kAfter) / omega; simulation.time() < end; simulation.advance()) {
        scaling::stop_if_interrupted();
        if (simulation.divergence()) throw std::runtime_error("wave test: the run diverged; are the stiffnesses consistent?");
        history.time.push_back(simulation.time());
        for (std::size_t i = 0; i < n; ++i) {
            history.displacement[i].push_back(simulation.position(i)[axis] - model.blocks[i].position[axis]);
            history.velocity[i].push_back(simulation.velocity(i)[axis]);
        }
    }
    return history;
}

WaveSpeed measure_wave_speed(const BlockSample& sample, WaveKind kind, const WaveSettings& settings) {
    const WaveHistory history = run_wave_test(sample, kind, settings);
    WaveSpeed result = fit_speed(find_arrivals(history, settings.criterion, frequency(sample, kind)), sample.size.z());
    result.front_factor = compute_front_factor(settings);
    return result;
}

double compute_front_factor(const WaveSettings& settings) {
    require_layers(settings.layers);
    return fit_speed(find_arrivals(run_ideal_chain(settings.layers), settings.criterion, 1.0), 1.0).speed;
}

StiffnessSearch find_stiffness(BlockSample sample, WaveKind kind, double target, const WaveSettings& settings, bool of_raw_speed) {
    if (!(target > 0.0) || !std::isfinite(target))
        throw std::invalid_argument(fmt::format("wave test: the target speed is {} m/s (must be positive); correct it", target));
    double& stiffness = kind == WaveKind::normal ? sample.normal_stiffness : sample.shear_stiffness;
    const double height = sample.size.z();
    StiffnessSearch search{.target = target,
                           .stiffness = 0.0,
                           .closed_form = sample.mass() * target * target / (height * height),
                           .measured = {},
                           .runs = 0,
                           .of_raw_speed = of_raw_speed};
    for (search.runs = 1; search.runs <= kMostRuns; ++search.runs) {
        search.measured = measure_wave_speed(sample, kind, settings);
        search.stiffness = stiffness;
        const double ratio = target / (of_raw_speed ? search.measured.speed : search.measured.effective());
        if (std::abs(ratio - 1.0) < kSpeedTolerance) return search;
        if (!std::isfinite(ratio)) break;
        stiffness *= ratio * ratio;
    }
    throw std::runtime_error(fmt::format("wave test: no stiffness gives {} m/s within {} runs; choose another target", target, kMostRuns));
}

}  // namespace musim::lsdem
