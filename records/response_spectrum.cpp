#include "records/response_spectrum.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "records/detail/oscillator.hpp"

namespace musim::records {
namespace {

/// So many oscillators go through the record side by side.
constexpr std::size_t kBatch = 8;

using Lane = std::array<double, kBatch>;

void check_period(scaling::Time period, bool rigid_too) {
    const bool good = std::isfinite(period.value()) && (period.value() > 0.0 || (rigid_too && period.value() == 0.0));
    if (!good)
        throw ProcessingError(fmt::format("period is {} s (must be {}); change it", period.value(), rigid_too ? "0 or more" : "above 0"));
}

double find_theta(scaling::Time period, scaling::Time dt) { return 2.0 * std::numbers::pi * (dt.value() / period.value()); }

double find_largest(std::span<const double> samples) {
    double most = 0.0;
    for (const double sample : samples) most = std::max(most, std::abs(sample));
    return most;
}

/// Largest |u|, |u̇| and |2ζθ u̇ + θ² u| of up to kBatch oscillators, in units of the step.
struct Largest {
    Lane u{}, v{}, a{};
};

Largest run_batch(std::span<const double> samples, const std::array<detail::OscillatorStep, kBatch>& steps, const Lane& drag,
                  const Lane& spring) {
    Lane uu, uv, u0, u1, vu, vv, v0, v1, u{}, v{};
    for (std::size_t k = 0; k < kBatch; ++k) {
        uu[k] = steps[k].u_u, uv[k] = steps[k].u_v, u0[k] = steps[k].u_0, u1[k] = steps[k].u_1;
        vu[k] = steps[k].v_u, vv[k] = steps[k].v_v, v0[k] = steps[k].v_0, v1[k] = steps[k].v_1;
    }
    Largest most;
    for (std::size_t i = 1; i < samples.size(); ++i) {
        const double before = samples[i - 1], now = samples[i];
        for (std::size_t k = 0; k < kBatch; ++k) {
            const double next_u = (uu[k] * u[k] + uv[k] * v[k]) + (u0[k] * before + u1[k] * now);
            const double next_v = (vu[k] * u[k] + vv[k] * v[k]) + (v0[k] * before + v1[k] * now);
            u[k] = next_u;
            v[k] = next_v;
            most.u[k] = std::max(most.u[k], std::abs(next_u));
            most.v[k] = std::max(most.v[k], std::abs(next_v));
            most.a[k] = std::max(most.a[k], std::abs(drag[k] * next_v + spring[k] * next_u));
        }
    }
    return most;
}

}  // namespace

void require_damping(double damping) {
    if (!(damping >= 0.0 && std::isfinite(damping)))
        throw ProcessingError(fmt::format("damping ratio is {} (must be a fraction of critical from 0 up); give 0.05 for 5 %", damping));
}

std::vector<double> ResponseSpectrum::pseudo_velocity() const {
    std::vector<double> values(period.size(), 0.0);
    for (std::size_t i = 0; i < period.size(); ++i)
        if (period[i] > 0.0) values[i] = 2.0 * std::numbers::pi / period[i] * displacement[i];
    return values;
}

std::vector<double> ResponseSpectrum::pseudo_acceleration() const {
    std::vector<double> values = acceleration;
    for (std::size_t i = 0; i < period.size(); ++i) {
        const double omega = 2.0 * std::numbers::pi / period[i];
        if (period[i] > 0.0) values[i] = omega * omega * displacement[i];
    }
    return values;
}

ResponseSpectrum compute_response_spectrum(const TimeSeries& acceleration, std::span<const scaling::Time> periods, double damping) {
    require_quantity(acceleration, SampleQuantity::acceleration, "the response spectrum");
    require_damping(damping);
    for (const scaling::Time& period : periods) check_period(period, true);
    ResponseSpectrum spectrum;
    spectrum.damping = damping;
    for (const scaling::Time& period : periods) spectrum.period.push_back(period.value());
    spectrum.displacement.assign(periods.size(), 0.0);
    spectrum.velocity.assign(periods.size(), 0.0);
    spectrum.acceleration.assign(periods.size(), find_largest(acceleration.samples()));

    std::vector<std::size_t> flexible;
    for (std::size_t i = 0; i < periods.size(); ++i)
        if (periods[i].value() > 0.0) flexible.push_back(i);
    const double dt = acceleration.dt().value();
    for (std::size_t first = 0; first < flexible.size(); first += kBatch) {
        const std::size_t count = std::min(kBatch, flexible.size() - first);
        std::array<detail::OscillatorStep, kBatch> steps;
        Lane drag{}, spring{};
        for (std::size_t k = 0; k < kBatch; ++k) {
            const double theta = find_theta(periods[flexible[first + std::min(k, count - 1)]], acceleration.dt());
            steps[k] = detail::make_oscillator_step(theta, damping);
            drag[k] = 2.0 * damping * theta;
            spring[k] = theta * theta;
        }
        const Largest most = run_batch(acceleration.samples(), steps, drag, spring);
        for (std::size_t k = 0; k < count; ++k) {
            const std::size_t i = flexible[first + k];
            spectrum.displacement[i] = most.u[k] * dt * dt;
            spectrum.velocity[i] = most.v[k] * dt;
            spectrum.acceleration[i] = most.a[k];
        }
    }
    return spectrum;
}

TimeSeries compute_oscillator_response(const TimeSeries& acceleration, scaling::Time period, double damping) {
    require_quantity(acceleration, SampleQuantity::acceleration, "the response of an oscillator");
    require_damping(damping);
    check_period(period, false);
    const double dt = acceleration.dt().value();
    const detail::OscillatorStep step = detail::make_oscillator_step(find_theta(period, acceleration.dt()), damping);
    const std::span<const double> a = acceleration.samples();
    std::vector<double> response(a.size(), 0.0);
    double u = 0.0, v = 0.0;
    for (std::size_t i = 1; i < a.size(); ++i) {
        const double next_u = (step.u_u * u + step.u_v * v) + (step.u_0 * a[i - 1] + step.u_1 * a[i]);
        v = (step.v_u * u + step.v_v * v) + (step.v_0 * a[i - 1] + step.v_1 * a[i]);
        u = next_u;
        response[i] = u * dt * dt;
    }
    return acceleration.with_samples(SampleQuantity::displacement, std::move(response));
}

std::vector<scaling::Time> make_periods(scaling::Time first, scaling::Time last, std::size_t count) {
    if (!(first.value() > 0.0 && last > first && std::isfinite(last.value()) && count >= 2))
        throw ProcessingError(fmt::format("{} periods from {} s to {} s are impossible (0 < first < last, at least 2); change them", count,
                                          first.value(), last.value()));
    std::vector<scaling::Time> periods;
    const double ratio = last.value() / first.value();
    for (std::size_t i = 0; i < count; ++i)
        periods.push_back(first * std::pow(ratio, static_cast<double>(i) / static_cast<double>(count - 1)));
    periods.back() = last;
    return periods;
}

}  // namespace musim::records
