#pragma once

#include <optional>
#include <vector>

#include "records/measures/response_spectrum.hpp"
#include "records/time_series.hpp"

/// Measures of an acceleration record beyond its peaks. All throw ProcessingError for other quantities.
namespace musim::records {

/// Cumulative absolute velocity ∫|a| dt, by the trapezoid rule.
scaling::Velocity compute_cumulative_absolute_velocity(const TimeSeries& acceleration);

/// Root mean square √(∫a² dt / duration), by the trapezoid rule; of one sample, its absolute value.
scaling::Acceleration compute_rms_acceleration(const TimeSeries& acceleration);

/// From the first to the last sample with |a| ≥ threshold; nothing when there is none. Throws ProcessingError unless threshold > 0.
std::optional<scaling::Time> compute_bracketed_duration(const TimeSeries& acceleration, scaling::Acceleration threshold);

/// Spectrum intensity ∫ PSV(T) dT [m] from `first` to `last` by trapezoids of 240 even steps: 0.1 to 2.5 s in [Housner52], for a model
/// these are to be scaled like any time. Throws ProcessingError unless 0 < first < last, both finite.
scaling::Length compute_spectrum_intensity(const TimeSeries& acceleration, scaling::Time first, scaling::Time last, double damping = 0.05);

/// Amplitudes |∫ a e^{−2πift} dt| at f = 0, step, 2·step, ... up to the Nyquist frequency.
struct FourierAmplitudes {
    scaling::Frequency step;
    std::vector<double> amplitude;  ///< [m/s]
};

/// By a discrete transform of the samples as they are, without taper: step = 1/(n·dt). Σ over all frequencies, negative ones too, of
/// amplitude²·step is Σ a² dt (Parseval).
FourierAmplitudes compute_fourier_amplitudes(const TimeSeries& acceleration);

/// Mean period Σ A²/f / Σ A² over the Fourier amplitudes with f from `low` to `high` [Rathje98]; they take 0.25 to 20 Hz, for a model these
/// are to be scaled like any frequency. Nothing when no amplitude above zero lies there. Throws ProcessingError unless 0 < low < high.
std::optional<scaling::Time> compute_mean_period(const FourierAmplitudes& spectrum, scaling::Frequency low, scaling::Frequency high);

/// Period of the largest PSA among those of the spectrum, above zero; nothing for an empty spectrum or one without motion.
std::optional<scaling::Time> find_predominant_period(const ResponseSpectrum& spectrum);

/// Period of the largest PSV among those of the spectrum: near a pulse's own period, where a record has a pulse.
std::optional<scaling::Time> find_pulse_period(const ResponseSpectrum& spectrum);

}  // namespace musim::records
