#include "lsdem/response/structural_speed.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstddef>
#include <limits>
#include <numbers>
#include <span>
#include <stdexcept>
#include <unsupported/Eigen/FFT>

#include "lsdem/response/line_fit.hpp"

namespace musim::lsdem {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

using Spectrum = std::vector<std::complex<double>>;

void require_consistent(const Receivers& receivers) {
    if (!(receivers.dt > 0.0)) throw std::invalid_argument("structural speed: the sampling interval must be positive");
    if (receivers.height.size() != receivers.velocity.size())
        throw std::invalid_argument("structural speed: as many heights as histories are needed");
    for (std::size_t i = 0; i < receivers.height.size(); ++i) {
        if (i > 0 && !(receivers.height[i] > receivers.height[i - 1]))
            throw std::invalid_argument("structural speed: heights must increase");
        if (receivers.velocity[i].size() != receivers.velocity.front().size())
            throw std::invalid_argument("structural speed: all histories must be equally long");
    }
}

double find_peak(std::span<const double> values) {
    double peak = 0.0;
    for (const double v : values) peak = std::max(peak, std::abs(v));
    return peak;
}

/// Offset of the top of a parabola through three values from the middle one, in samples.
double find_vertex(double left, double middle, double right) {
    const double curvature = left - 2.0 * middle + right;
    return curvature < 0.0 ? 0.5 * (left - right) / curvature : 0.0;
}

/// Place of the greatest value, in samples, between them by a parabola.
double find_maximum(std::span<const double> values) {
    const auto at = static_cast<std::size_t>(std::max_element(values.begin(), values.end()) - values.begin());
    const auto place = static_cast<double>(at);
    return at > 0 && at + 1 < values.size() ? place + find_vertex(values[at - 1], values[at], values[at + 1]) : place;
}

double find_first_arrival(std::span<const double> velocity, double level) {
    for (std::size_t k = 0; k < velocity.size(); ++k) {
        const double now = std::abs(velocity[k]);
        if (now < level) continue;
        if (k == 0) return 0.0;
        const double before = std::abs(velocity[k - 1]);
        return static_cast<double>(k) - (now - level) / (now - before);
    }
    return kNone;
}

/// Part of a history that is faded out before a transform [-]: an end in full motion would look like a pulse that all levels feel at once.
constexpr double kFade = 0.1;

void fade_out(std::vector<double>& history) {
    const double length = kFade * static_cast<double>(history.size());
    for (std::size_t k = 0; k < history.size(); ++k) {
        const double left = static_cast<double>(history.size() - k) / length;
        if (left < 1.0) history[k] *= 0.5 * (1.0 - std::cos(std::numbers::pi * left));
    }
}

/// Transforms of all histories, followed by as many zeros, so that lags of either sign do not wrap around.
std::vector<Spectrum> transform(const Receivers& receivers) {
    const std::size_t samples = receivers.velocity.front().size();
    std::size_t length = 1;
    while (length < 2 * samples) length *= 2;
    Eigen::FFT<double> fft;
    std::vector<Spectrum> spectra;
    for (const std::vector<double>& history : receivers.velocity) {
        std::vector<double> padded = history;
        fade_out(padded);
        padded.resize(length, 0.0);
        spectra.emplace_back();
        fft.fwd(spectra.back(), padded);
    }
    return spectra;
}

/// The lag [samples] at which the inverse transform of a spectrum is greatest, up to half the length of either sign.
double find_greatest_lag(const Spectrum& spectrum) {
    Eigen::FFT<double> fft;
    std::vector<double> values;
    fft.inv(values, spectrum);
    // the second half holds negative lags
    const std::size_t half = values.size() / 2;
    std::rotate(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(half), values.end());
    return find_maximum(values) - static_cast<double>(values.size() - half);
}

/// Lag of every receiver after the lowest one by the greatest value of  V_z·V_0*·weight  in the time domain.
std::vector<double> find_spectral_lags(const std::vector<Spectrum>& spectra, const std::vector<double>& weight) {
    std::vector<double> lags;
    for (const Spectrum& spectrum : spectra) {
        Spectrum product(spectrum.size());
        for (std::size_t k = 0; k < product.size(); ++k) product[k] = spectrum[k] * std::conj(spectra.front()[k]) * weight[k];
        lags.push_back(find_greatest_lag(product));
    }
    return lags;
}

/// Fits the lags [samples]; receivers without one are left out.
SpeedEstimate fit_lags(const std::string& method, const Receivers& receivers, const std::vector<double>& lags) {
    SpeedEstimate estimate;
    estimate.method = method;
    for (std::size_t i = 0; i < lags.size(); ++i) {
        if (!std::isfinite(lags[i])) continue;
        estimate.height.push_back(receivers.height[i] - receivers.height.front());
        estimate.lag.push_back((lags[i] - lags.front()) * receivers.dt);
    }
    if (estimate.lag.size() < 3) {
        estimate.why = "fewer than three levels show an arrival";
        return estimate;
    }
    const LineFit fit = fit_line(estimate.height, estimate.lag);
    estimate.slowness = fit.slope;
    estimate.slowness_error = fit.slope_error;
    if (fit.slope > fit.slope_error) {
        estimate.speed = 1.0 / fit.slope;
        estimate.speed_error = fit.slope_error / (fit.slope * fit.slope);
    } else {
        estimate.why = "the lag does not grow with height by more than its scatter";
    }
    return estimate;
}

}  // namespace

std::vector<SpeedEstimate> estimate_speeds(const Receivers& receivers, const SpeedSettings& settings) {
    require_consistent(receivers);
    std::vector<SpeedEstimate> none;
    for (const char* method : {"first_arrival", "cross_correlation", "peak", "deconvolution"}) {
        none.emplace_back();
        none.back().method = method;
    }
    const auto give_up = [&](const std::string& why) {
        for (SpeedEstimate& estimate : none) estimate.why = why;
        return none;
    };
    if (receivers.height.size() < 3) return give_up("fewer than three levels are kept");
    double greatest = 0.0;
    std::vector<double> peaks;
    for (const std::vector<double>& history : receivers.velocity) {
        peaks.push_back(find_peak(history));
        greatest = std::max(greatest, peaks.back());
    }
    if (!(greatest > 0.0) || !std::isfinite(greatest)) return give_up("nothing moves");
    if (!(peaks.front() > 0.0)) return give_up("the lowest level does not move");

    std::vector<SpeedEstimate> estimates;
    // by threshold and by peak; a receiver that does not move has neither
    const double level = settings.threshold * settings.reference_peak.value_or(greatest);
    std::vector<double> arrivals, peak_places;
    for (std::size_t i = 0; i < peaks.size(); ++i) {
        const std::vector<double>& v = receivers.velocity[i];
        arrivals.push_back(find_first_arrival(v, level));
        std::vector<double> magnitude(v.size());
        std::transform(v.begin(), v.end(), magnitude.begin(), [](double x) { return std::abs(x); });
        peak_places.push_back(peaks[i] > 0.0 ? find_maximum(magnitude) : kNone);
    }
    if (std::isfinite(arrivals.front())) {
        estimates.push_back(fit_lags("first_arrival", receivers, arrivals));
    } else {
        none[0].why = "the lowest level does not reach the threshold";
        estimates.push_back(none[0]);
    }

    // by correlation and by deconvolution with the lowest receiver
    const std::vector<Spectrum> spectra = transform(receivers);
    const std::size_t length = spectra.front().size();
    std::vector<double> ones(length, 1.0), inverse(length);
    double mean_power = 0.0;
    for (const auto& value : spectra.front()) mean_power += std::norm(value) / static_cast<double>(length);
    for (std::size_t k = 0; k < length; ++k) inverse[k] = 1.0 / (std::norm(spectra.front()[k]) + settings.water_level * mean_power);
    const auto spectral = [&](const std::vector<double>& weight) {
        std::vector<double> lags = find_spectral_lags(spectra, weight);
        for (std::size_t i = 0; i < lags.size(); ++i)
            if (!(peaks[i] > 0.0)) lags[i] = kNone;
        return lags;
    };
    estimates.push_back(fit_lags("cross_correlation", receivers, spectral(ones)));
    estimates.push_back(fit_lags("peak", receivers, peak_places));
    estimates.push_back(fit_lags("deconvolution", receivers, spectral(inverse)));
    return estimates;
}

}  // namespace musim::lsdem
