#pragma once

#include <optional>
#include <span>
#include <vector>

#include "records/time_series.hpp"

namespace musim::records {

/// Largest responses of damped oscillators to one motion of their base, one entry per period.
///
///   ü + 2ζω u̇ + ω² u = −a(t),   ω = 2π/T,   u relative to the base
struct ResponseSpectrum {
    double damping = 0.05;                            ///< ζ, fraction of critical [-]
    std::vector<double> period;                       ///< T [s]
    std::vector<double> displacement;                 ///< SD = max|u| [m]
    std::vector<double> velocity;                     ///< SV = max|u̇| [m/s]
    std::vector<double> acceleration;                 ///< SA = max|ü + a|, of the mass in space [m/s²]
    std::vector<double> pseudo_velocity() const;      ///< PSV = ω·SD [m/s]; zero at T = 0
    std::vector<double> pseudo_acceleration() const;  ///< PSA = ω²·SD [m/s²]; at T = 0 SA, the peak of the motion
};

/// Spectrum of an acceleration that is linear between its samples: the response is exact at the samples [NigamJennings69], and its peaks
/// between them are found to 1e-4 for T ≥ dt/10 (below, to 3 %), from rest at the first sample to the last. T = 0 stands for a rigid
/// oscillator. Any damping ratio ζ from 0 to kLargestDamping, above critical too. What is computed depends on T/dt and ζ only: a record
/// scaled in time and amplitude has the scaled spectrum. Throws ProcessingError for another quantity and for a period or damping ratio out
/// of range, scaling::Interrupted.
ResponseSpectrum compute_response_spectrum(const TimeSeries& acceleration, std::span<const scaling::Time> periods, double damping = 0.05);

/// u(t) of one oscillator, at the samples only; as above, but T must be positive.
TimeSeries compute_oscillator_response(const TimeSeries& acceleration, scaling::Time period, double damping = 0.05);

/// Throws ProcessingError for a period that is negative or not finite.
void require_periods(std::span<const scaling::Time> periods);

/// Largest damping ratio: up to it all coefficients keep five digits, and no structure has more.
inline constexpr double kLargestDamping = 100.0;

/// Throws ProcessingError for a damping ratio that is negative, above kLargestDamping or no number.
void require_damping(double damping);

/// `count` ≥ 2 periods from `first` to `last`, in even steps of their logarithm. Throws ProcessingError unless 0 < first < last.
std::vector<scaling::Time> make_periods(scaling::Time first, scaling::Time last, std::size_t count);

/// Response spectrum of an acceleration at the periods that the record itself resolves: 200 of them, in even steps of their logarithm,
/// from 4 dt to
///
///   corrected records (no integration corner)   its duration D; zeros as long as the record follow it, so that free vibration counts
///   uncorrected ones                            min(D/4, 1/corner), the record as it is: beyond the corner there is its noise
///
/// Empty for records too short for that. A record scaled by powers of two has the scaled spectrum to the last bit. Throws as
/// compute_response_spectrum(), and ProcessingError for a corner that is not positive.
ResponseSpectrum compute_own_spectrum(const TimeSeries& acceleration, std::optional<scaling::Frequency> integration_corner,
                                      double damping = 0.05);

}  // namespace musim::records
