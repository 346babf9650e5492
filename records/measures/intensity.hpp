#pragma once

#include <optional>

#include "records/ground_motion.hpp"

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

/// Significant duration D5-95: between 5 % and 95 % of the Arias intensity, linear between samples; zero for a record without motion.
/// Throws ProcessingError for other quantities.
scaling::Time compute_significant_duration(const TimeSeries& acceleration);

/// The same between any two shares of the Arias intensity, D5-75 with 0.05 and 0.75. Also throws unless 0 <= from < to <= 1.
scaling::Time compute_significant_duration(const TimeSeries& acceleration, double from, double to);

/// What measures of a record are taken from: with an integration corner (uncorrected records) the samples above their initial level
/// (remove_initial_level), else the samples as they are.
TimeSeries level_uncorrected(const TimeSeries& series, std::optional<scaling::Frequency> integration_corner);

/// Intensity measures of one component; those that its quantity does not give are left out.
struct Intensity {
    std::optional<Peak<scaling::Acceleration>> pga;
    std::optional<Peak<scaling::Velocity>> pgv;
    std::optional<Peak<scaling::Length>> pgd;
    std::optional<scaling::Velocity> arias;
    std::optional<scaling::Time> d5_95;
};

/// All measures of a series. Velocity and displacement are trapezoid integrals from zero.
///
/// With an integration corner (uncorrected records) velocity and displacement come from the samples, their mean taken out since an offset
/// would ring, high-passed there, order 2, forward and backward (displacement without the velocity's mean); PGA, Arias intensity and
/// duration from the unfiltered samples above their initial level (level_uncorrected).
Intensity compute_intensity(const TimeSeries& series, std::optional<scaling::Frequency> integration_corner = std::nullopt);

}  // namespace musim::records
