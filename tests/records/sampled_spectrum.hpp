#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <utility>
#include <vector>

#include "records/measures/oscillator.hpp"
#include "records/measures/response_spectrum.hpp"
#include "records/measures/rotated_peaks.hpp"

/// Spectra whose peaks are taken at the samples alone, as many programs do: what their tables are compared with.
namespace musim::tests {

/// All responses of one oscillator of 5 % damping.
inline records::ResponseSpectrum sampled_spectrum(const records::TimeSeries& motion, double period) {
    constexpr double kDamping = 0.05;
    const scaling::Time dt = motion.dt();
    const double theta = records::detail::find_theta(period * scaling::si::seconds, dt);
    const records::detail::OscillatorStep step = records::detail::make_oscillator_step(theta, kDamping);
    records::ResponseSpectrum spectrum{.damping = kDamping, .period = {period}, .displacement = {0}, .velocity = {0}, .acceleration = {0}};
    double u = 0.0, v = 0.0;
    for (std::size_t i = 1; i < motion.size(); ++i) {
        const double a0 = motion.samples()[i - 1], a1 = motion.samples()[i];
        const double next = step.u_u * u + step.u_v * v + step.u_0 * a0 + step.u_1 * a1;
        v = step.v_u * u + step.v_v * v + step.v_0 * a0 + step.v_1 * a1;
        u = next;
        const auto keep = [](double& most, double value) { most = std::max(most, std::abs(value)); };
        keep(spectrum.displacement[0], u * dt.value() * dt.value());
        keep(spectrum.velocity[0], v * dt.value());
        keep(spectrum.acceleration[0], 2.0 * kDamping * theta * v + theta * theta * u);
    }
    return spectrum;
}

/// RotD of PSA [m/s²].
inline records::RotatedPeaks sampled_rotated(const records::TimeSeries& first, const records::TimeSeries& second, double period) {
    const scaling::Time time = period * scaling::si::seconds;
    const records::TimeSeries x = records::compute_oscillator_response(first, time), y = records::compute_oscillator_response(second, time);
    records::RotatedPeaks peaks = records::find_rotated_peaks(x.samples(), y.samples());
    const double omega = 2.0 * std::numbers::pi / period;
    for (double* value : {&peaks.least, &peaks.median, &peaks.largest}) *value *= omega * omega;
    return peaks;
}

/// The same motion, linear between its samples, looked at ten times a period at least, as PEER, CSMIP and the SCEC Broadband Platform do.
/// Periods in tables are 1/f rounded, 1/28 s among them.
inline records::TimeSeries look_ten_times(const records::TimeSeries& series, double period) {
    const int parts = std::max(1, static_cast<int>(std::ceil(10.0 * series.dt().value() / period * (1.0 - 1e-4))));
    std::vector<double> samples;
    for (std::size_t i = 0; i + 1 < series.size(); ++i) {
        const double step = series.samples()[i + 1] - series.samples()[i];
        for (int part = 0; part < parts; ++part) samples.push_back(series.samples()[i] + step * part / parts);
    }
    samples.push_back(series.samples().back());
    return {series.quantity(), series.start(), series.dt() / static_cast<double>(parts), std::move(samples)};
}

}  // namespace musim::tests
