#pragma once

#include <optional>
#include <vector>

#include "records/ground_motion.hpp"
#include "records/processing/uncorrected.hpp"
#include "records/time_series.hpp"

namespace musim::records {

/// Largest absolute value of a history with its sign, and its (first) time.
template <class Quantity>
struct Peak {
    Quantity value;
    scaling::Time time;
};

/// Peak of a series' samples. Throws ProcessingError when the series holds another quantity than the name says.
Peak<scaling::Acceleration> find_peak_acceleration(const TimeSeries& acceleration);
Peak<scaling::Velocity> find_peak_velocity(const TimeSeries& velocity);
Peak<scaling::Length> find_peak_displacement(const TimeSeries& displacement);

/// Arias intensity π/(2g) ∫ a² dt, by the trapezoid rule. Throws ProcessingError for other quantities.
scaling::Velocity compute_arias_intensity(const TimeSeries& acceleration, scaling::Acceleration gravity = scaling::kStandardGravity);

/// Significant duration between two shares of the Arias intensity, D5-95 unless others are given, linear between samples; zero for a record
/// without motion. Throws ProcessingError for other quantities and unless 0 <= from < to <= 1.
scaling::Time compute_significant_duration(const TimeSeries& acceleration, double from = 0.05, double to = 0.95);

/// Intensity measures of one component; those that its quantity does not give are left out.
struct Intensity {
    std::optional<Peak<scaling::Acceleration>> pga;
    std::optional<Peak<scaling::Velocity>> pgv;
    std::optional<Peak<scaling::Length>> pgd;
    std::optional<scaling::Velocity> arias;
    std::optional<scaling::Time> d5_95;
    std::optional<Peak<scaling::AngularAcceleration>> angular_acceleration;  ///< this and the next two of rotations alone
    std::optional<Peak<scaling::Frequency>> angular_velocity;
    std::optional<Peak<scaling::Ratio>> angle;  ///< from where the record begins [rad]
};

/// All measures of a series; of a rotation its three peaks. Velocity and displacement are trapezoid integrals from zero.
///
/// With an integration corner (uncorrected records) velocity and displacement come from the samples, their mean taken out since an offset
/// would ring, high-passed there, order 2, forward and backward (displacement without the velocity's mean); PGA, Arias intensity and
/// duration from the unfiltered samples above their initial level (level_uncorrected).
Intensity compute_intensity(const TimeSeries& series, std::optional<scaling::Frequency> integration_corner = std::nullopt);

/// The acceleration, velocity and displacement of one component, of a rotation the angular ones and the angle; what its quantity does not
/// give is left out.
struct MotionHistories {
    std::optional<TimeSeries> acceleration;
    std::optional<TimeSeries> velocity;
    TimeSeries displacement;
};

/// Histories by trapezoid integrals from zero. With an integration corner (uncorrected records) the acceleration is that above its initial
/// level (level_uncorrected), and the others come from the samples, their mean taken out, high-passed there, order 2, forward and backward;
/// the displacement from that velocity without its mean, which would be a drift.
/// Throws ProcessingError for a corner that the samples cannot have.
MotionHistories compute_histories(const TimeSeries& series, std::optional<scaling::Frequency> integration_corner = std::nullopt);

/// Build-up of the Arias intensity, ∫₀ᵗ a² dt / ∫₀^end a² dt at every sample, from 0 to 1 [Husid69]; all zero for a record without motion.
/// Depends on the ratios of the samples only. Throws ProcessingError for another quantity.
std::vector<double> compute_arias_share(const TimeSeries& acceleration);

/// The component of largest peak acceleration, among those with a direction where any has one: a record whose file names no directions is
/// taken as it is. Rotations do not count. Throws ProcessingError when a translation holds no acceleration, and without any.
const Component& find_strongest_horizontal(const GroundMotion& motion);

}  // namespace musim::records
