#pragma once

#include <optional>
#include <string>
#include <vector>

/// Speed at which motion travels up a structure, from velocity histories at several heights.
namespace musim::lsdem {

/// Velocities at several heights, sampled at the same even times.
struct Receivers {
    double dt = 0.0;                            ///< sampling interval [s]
    std::vector<double> height;                 ///< increasing [m]
    std::vector<std::vector<double>> velocity;  ///< one history per height [m/s]
};

struct SpeedSettings {
    /// Velocity that counts as arrival, over the reference of `reference_peak` [-]. A tenth: above what ripples ahead of a front.
    double threshold = 0.1;
    /// Peak velocity that the threshold refers to [m/s]: that of the base; nothing for the greatest of all receivers.
    std::optional<double> reference_peak;
    /// Water level of the deconvolution, over the mean power of the lowest receiver [-]: frequencies with less are left out.
    double water_level = 0.01;
};

/// One estimate.
struct SpeedEstimate {
    std::string method;              ///< first_arrival, cross_correlation, peak or deconvolution
    std::vector<double> height;      ///< of the receivers used, above the lowest of all [m]
    std::vector<double> lag;         ///< there, after the lowest one [s]
    std::optional<double> speed;     ///< 1/slope of lag over height [m/s]; nothing when there is none, see `why`
    std::optional<double> slowness;  ///< the slope [s/m]
    double slowness_error = 0.0;     ///< its standard error [s/m]
    double speed_error = 0.0;        ///< speed²·slowness_error [m/s]
    std::string why;                 ///< why there is no speed; empty when there is one
};

/// Four estimates of the speed of travel, each the least-squares line of lag over height with the standard error of its slope:
/// - first_arrival: first time |v| reaches the threshold, linear between samples; receivers that never reach it are left out
/// - cross_correlation: lag of the greatest Σ v_0(t)·v_z(t + τ), v_0 the lowest receiver
/// - peak: time of the greatest |v|
/// - deconvolution: time of the greatest value of the inverse transform of V_z·V_0*/(|V_0|² + water level) [SniederSafak06]
/// Lags between samples by a parabola through the greatest value and its neighbors. For the two that transform, the last tenth of the
/// histories is faded out; they want a window that holds a whole pulse.
///
/// There is no speed without motion, with fewer than three receivers, or when the slope is not positive by more than its error: motion
/// then arrives everywhere at once as far as the samples show. Throws std::invalid_argument for histories of different lengths, heights
/// that do not increase, or a dt that is not positive.
std::vector<SpeedEstimate> estimate_speeds(const Receivers& receivers, const SpeedSettings& settings = {});

}  // namespace musim::lsdem
