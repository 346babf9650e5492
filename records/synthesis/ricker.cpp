#include "records/synthesis/ricker.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "records/formats/detail/made_record.hpp"

namespace musim::records {
namespace {

constexpr const char* kRickerPulse = "Ricker pulse";

double bell(const RickerWavelet& wavelet, scaling::Time tau) {
    const double phase = std::numbers::pi * wavelet.frequency.value() * tau.value();
    return std::exp(-phase * phase);
}

}  // namespace

scaling::Acceleration RickerWavelet::acceleration(scaling::Time tau) const {
    const double phase = std::numbers::pi * frequency.value() * tau.value();
    return amplitude * ((1.0 - 2.0 * phase * phase) * bell(*this, tau));
}

scaling::Velocity RickerWavelet::velocity(scaling::Time tau) const { return amplitude * tau * bell(*this, tau); }

GroundMotion make_ricker_record(const RickerWavelet& wavelet, scaling::Time dt) {
    const double frequency = wavelet.frequency.value();
    detail::require_positive(kRickerPulse, {{"PGA", wavelet.amplitude.value()}, {"peak frequency", frequency}, {"time step", dt.value()}});
    detail::require_sampled(kRickerPulse, frequency, dt.value());

    constexpr double kReach = 2.0;  // periods to each side
    const double half = std::ceil(kReach / (frequency * dt.value()));
    detail::require_steps(kRickerPulse, 2.0 * half, 4.0);
    std::vector<double> samples(2 * static_cast<std::size_t>(half) + 1);
    for (std::size_t i = 0; i < samples.size(); ++i) samples[i] = wavelet.acceleration((static_cast<double>(i) - half) * dt).value();
    return detail::make_record(fmt::format("{}, {:.6g} Hz", kRickerPulse, frequency),
                               fmt::format("{}, peak frequency {:.9g} Hz, PGA {:.9g} m/s^2, peak at {:.9g} s", kRickerPulse, frequency,
                                           wavelet.amplitude.value(), half * dt.value()),
                               dt, std::move(samples));
}

}  // namespace musim::records
