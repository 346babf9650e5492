#include "records/measures/measures.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <complex>

#include "records/processing/cumulative.hpp"
#include "records/processing/transform.hpp"

namespace musim::records {
namespace {

std::optional<scaling::Time> find_largest(const ResponseSpectrum& spectrum, const std::vector<double>& values) {
    std::optional<std::size_t> largest;
    for (std::size_t i = 0; i < values.size(); ++i)
        if (spectrum.period[i] > 0.0 && values[i] > (largest ? values[*largest] : 0.0)) largest = i;
    if (!largest) return std::nullopt;
    return scaling::Time::from_value(spectrum.period[*largest]);
}

}  // namespace

scaling::Velocity compute_cumulative_absolute_velocity(const TimeSeries& acceleration) {
    require_quantity(acceleration, SampleQuantity::acceleration, "the cumulative absolute velocity");
    std::vector<double> size(acceleration.samples().begin(), acceleration.samples().end());
    for (double& value : size) value = std::abs(value);
    return scaling::Velocity::from_value(detail::cumulative_trapezoid(size, acceleration.dt().value()).back());
}

scaling::Acceleration compute_rms_acceleration(const TimeSeries& acceleration) {
    require_quantity(acceleration, SampleQuantity::acceleration, "the RMS acceleration");
    if (acceleration.size() == 1) return scaling::Acceleration::from_value(std::abs(acceleration.samples()[0]));
    const double integral = detail::cumulative_square(acceleration).back();
    return scaling::Acceleration::from_value(std::sqrt(integral / acceleration.duration().value()));
}

std::optional<scaling::Time> compute_bracketed_duration(const TimeSeries& acceleration, scaling::Acceleration threshold) {
    require_quantity(acceleration, SampleQuantity::acceleration, "the bracketed duration");
    if (!(threshold.value() > 0.0))
        throw ProcessingError(fmt::format("threshold is {} m/s^2 (must be above 0); change it", threshold.value()));
    const std::span<const double> a = acceleration.samples();
    const auto strong = [&](double sample) { return std::abs(sample) >= threshold.value(); };
    const auto first = std::find_if(a.begin(), a.end(), strong);
    if (first == a.end()) return std::nullopt;
    const auto last = std::find_if(a.rbegin(), a.rend(), strong);
    return static_cast<double>((a.rend() - last) - 1 - (first - a.begin())) * acceleration.dt();
}

scaling::Length compute_spectrum_intensity(const TimeSeries& acceleration, scaling::Time first, scaling::Time last, double damping) {
    constexpr std::size_t kSteps = 240;
    if (!(first.value() > 0.0 && last > first && std::isfinite(last.value()))) {
        throw ProcessingError(fmt::format("the spectrum intensity cannot be taken from {} to {} s (0 < first < last); change them",
                                          first.value(), last.value()));
    }
    const scaling::Time step = (last - first) / static_cast<double>(kSteps);
    std::vector<scaling::Time> periods;
    for (std::size_t i = 0; i <= kSteps; ++i) periods.push_back(first + static_cast<double>(i) * step);
    const std::vector<double> psv = compute_response_spectrum(acceleration, periods, damping).pseudo_velocity();
    return scaling::Length::from_value(detail::cumulative_trapezoid(psv, step.value()).back());
}

FourierAmplitudes compute_fourier_amplitudes(const TimeSeries& acceleration) {
    require_acceleration(acceleration, "the Fourier amplitudes");
    const detail::Transform transform(acceleration.samples());
    FourierAmplitudes spectrum;
    const double dt = acceleration.dt().value();
    spectrum.step = 1.0 / (static_cast<double>(acceleration.size()) * acceleration.dt());
    for (const std::complex<double>& value : transform.spectrum()) spectrum.amplitude.push_back(dt * std::abs(value));
    return spectrum;
}

std::optional<scaling::Time> compute_mean_period(const FourierAmplitudes& spectrum, scaling::Frequency low, scaling::Frequency high) {
    if (!(low.value() > 0.0 && high > low)) {
        throw ProcessingError(
            fmt::format("the mean period cannot be taken from {} to {} Hz (0 < low < high); change them", low.value(), high.value()));
    }
    double sum = 0.0, weighted = 0.0;
    for (std::size_t i = 1; i < spectrum.amplitude.size(); ++i) {
        const double f = static_cast<double>(i) * spectrum.step.value(), square = spectrum.amplitude[i] * spectrum.amplitude[i];
        if (f < low.value() || f > high.value()) continue;
        sum += square;
        weighted += square / f;
    }
    if (!(sum > 0.0)) return std::nullopt;
    return scaling::Time::from_value(weighted / sum);
}

std::optional<scaling::Time> find_predominant_period(const ResponseSpectrum& spectrum) {
    return find_largest(spectrum, spectrum.pseudo_acceleration());
}

std::optional<scaling::Time> find_pulse_period(const ResponseSpectrum& spectrum) {
    return find_largest(spectrum, spectrum.pseudo_velocity());
}

}  // namespace musim::records
