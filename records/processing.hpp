#pragma once

#include "records/time_series.hpp"

/// Steps of record processing. All are pure, keep the clock unless said otherwise, and have no length, time or acceleration of their own:
/// a record scaled by factors that are powers of two gives the scaled result to the last bit. All throw ProcessingError.
namespace musim::records {

/// A stretch of a record's own time.
struct TimeWindow {
    scaling::Time start;
    scaling::Time end;
};

/// The samples from `window.start` to `window.end`, both included. Throws when the window is empty or reaches beyond the record.
TimeSeries cut(const TimeSeries& series, const TimeWindow& window);

/// Subtracts the mean of the first 1/64 of the record: the zero level before the event in records with a pre-event part.
TimeSeries remove_initial_level(const TimeSeries& series);

/// Subtracts the polynomial of degree `order` (0: mean, 1: line, 2, 3) that fits best in the least-squares sense.
/// Exact on polynomials, to rounding. Throws for another order and for fewer samples than coefficients.
TimeSeries remove_baseline(const TimeSeries& series, int order);

/// Fades both ends to zero with a half cosine over `fraction` of the record each: w = (1 − cos(π t/T))/2. Throws unless 0 ≤ fraction ≤ 1/2.
TimeSeries taper(const TimeSeries& series, double fraction);

/// Butterworth high-pass of the given order run forward and backward: no phase shift, amplitudes times
///
///   |H|² = 1 / (1 + (tan(π f_c dt)/tan(π f dt))^(2·order)),   1/2 at the corner f_c.
///
/// Second-order sections by the bilinear transform with the corner prewarped. Zeros are put before and after the record for as long as
/// the filter remembers (to 1e-6), as [Boore05] advises, and taken off again: a record that is quiet at zero level at its ends, or tapered,
/// keeps clean ends. Level it first (remove_initial_level, remove_baseline); an offset would ring like a step.
/// Throws unless order is 1 to 8, 0 < f_c dt < 1/2, and the filter remembers no more than 10^8 steps.
TimeSeries high_pass(const TimeSeries& series, scaling::Frequency corner, int order);

/// Trapezoid integral from zero: acceleration → velocity, velocity → displacement. Throws for a displacement.
/// For a piecewise linear velocity (what simulations prescribe) the displacement is exact.
TimeSeries integrate(const TimeSeries& series);

/// Central differences (one-sided at the ends): displacement → velocity, velocity → acceleration. Throws for an acceleration and for one
/// sample.
TimeSeries differentiate(const TimeSeries& series);

/// Where an acceleration record shakes: from 0.5 % to 99.5 % of ∫a²dt, widened by `margin` times that length on both sides, within the
/// record. Throws for other quantities and for a record without motion.
TimeWindow find_strong_motion(const TimeSeries& acceleration, double margin = 0.1);

}  // namespace musim::records
