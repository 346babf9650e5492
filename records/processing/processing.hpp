#pragma once

#include "records/time_series.hpp"

/// Steps of record processing. All are pure, keep the clock unless said otherwise, and have no length, time or acceleration of their own:
/// a record scaled by factors that are powers of two gives the scaled result to the last bit. All throw ProcessingError. What is said of
/// accelerations, velocities and displacements holds for angular accelerations, angular velocities and angles.
namespace musim::records {

/// Beginning and end of the motion of a base.
enum class AtRest {
    home,       ///< at rest, and ends where it began
    displaced,  ///< at rest, wherever it ends
    as_given    ///< as the record says: base and what stands on it begin together, at rest on each other; the last velocity is kept
};

/// A stretch of a record's own time.
struct TimeWindow {
    scaling::Time start;
    scaling::Time end;
};

/// The samples from `window.start` to `window.end`, both included. Throws when the window is empty or reaches beyond the record.
TimeSeries cut(const TimeSeries& series, const TimeWindow& window);

/// Number of samples that are the beginning of a record: 1/64 of them.
std::size_t find_initial_part(const TimeSeries& series);

/// Strength of a record's motion in its beginning: rms of that part about its mean, over the rms of all samples about theirs; 0 without
/// motion.
double find_initial_motion(const TimeSeries& series);

/// True when a record has no part at rest to take its level from: more than 0.1 of its rms in its beginning.
bool begins_in_motion(const TimeSeries& series);

/// Subtracts the zero level: the mean of the beginning, that before the event in records with a pre-event part, or of all samples in one
/// that begins in motion.
TimeSeries remove_initial_level(const TimeSeries& series);

/// Subtracts the polynomial of degree `order` (0: mean, 1: line, 2, 3) that fits best in the least-squares sense.
/// Exact on polynomials, to rounding. Throws for another order and for fewer samples than coefficients.
TimeSeries remove_baseline(const TimeSeries& series, int order);

/// Fades both ends to zero with a half cosine over `fraction` of the record each: w = (1 − cos(π t/T))/2. Throws unless 0 ≤ fraction ≤ 1/2.
TimeSeries taper(const TimeSeries& series, double fraction);

/// All samples times `factor`. Throws unless it is finite.
TimeSeries amplify(const TimeSeries& series, double factor);

/// apply_butterworth() as a high-pass without phase shift.
TimeSeries high_pass(const TimeSeries& series, scaling::Frequency corner, int order);

/// Zeros before and after the record, for so long; the samples keep their times. Throws for a negative time and for more than 10^8 samples.
TimeSeries pad(const TimeSeries& series, scaling::Time before, scaling::Time after);

/// Takes out what keeps an acceleration, integrated by trapezoids from zero, from ending with zero velocity and, for AtRest::home, zero
/// displacement: shapes as long as the record, zero at both ends (docs/theory/records.md, "Ending at rest"). AtRest::as_given leaves it.
/// Throws for another quantity and fewer than four samples.
TimeSeries bring_to_rest(const TimeSeries& acceleration, AtRest at_rest = AtRest::home);

/// Trapezoid integral from zero: acceleration → velocity, velocity → displacement. Throws for a displacement.
/// For a piecewise linear velocity (what simulations prescribe) the displacement is exact.
TimeSeries integrate(const TimeSeries& series);

/// Integral by division by 2πif in the frequency domain, its mean taken out: exact for a motion that repeats itself, such as one that is
/// at rest at zero level at both ends. Throws as integrate().
TimeSeries integrate_by_frequency(const TimeSeries& series);

/// Central differences (one-sided at the ends): displacement → velocity, velocity → acceleration. Throws for an acceleration and for one
/// sample.
TimeSeries differentiate(const TimeSeries& series);

/// From the share `from` to the share `to` of ∫a²dt, linear between samples, widened by `margin` times that length on both sides, within
/// the record. Throws for other quantities, for a record without motion, and unless 0 ≤ from < to ≤ 1 and margin ≥ 0.
TimeWindow find_energy_window(const TimeSeries& acceleration, double from, double to, double margin);

/// Where an acceleration record shakes: find_energy_window() from 0.5 % to 99.5 %.
TimeWindow find_strong_motion(const TimeSeries& acceleration, double margin = 0.1);

}  // namespace musim::records
