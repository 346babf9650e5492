#pragma once

#include <span>
#include <string>
#include <vector>

#include "records/processing/base_motion.hpp"
#include "scaling/units.hpp"

/// Comparison of the motion that a base makes with the record that it was made from.
namespace musim::records {

/// Largest absolute values of a motion.
struct MotionPeaks {
    scaling::Acceleration pga{};
    scaling::Velocity pgv{};
    scaling::Length pgd{};  ///< displacement from where it begins
};

/// Relative change from which PGA and PGV of a base are no longer those of its record [-].
inline constexpr double kChangedPeak = 0.02;

/// Peaks of what a base makes and of what it was made from, and the largest differences of the two at any one time.
struct MotionChange {
    MotionPeaks record, base, difference;

    /// PGA or PGV of the base is off by more than kChangedPeak.
    bool is_changed() const;
};

/// Compares velocities [m/s] that are linear between samples dt [s] apart with a record on the same clock. The base's acceleration is
/// constant between samples; its largest difference from the record is the one from the mean of the record's two samples there, so that
/// straight lines of velocity change PGA but differ from nothing. A record without `acceleration` [m/s²] has that of its own straight
/// lines.
MotionChange compare_motions(std::span<const double> velocity, std::span<const double> record_velocity,
                             std::span<const double> record_acceleration, double dt);

/// The same of a velocity and of the record on its clock.
MotionChange compare_motions(const TimeSeries& velocity, const RecordedMotion& record);

/// "PGA 0.52 g (record 0.5454 g, -4.7 %), PGV 4.39 cm/s (record 4.4 cm/s, -0.2 %), PGD ...; largest difference at any time 0.01 g (of
/// means over a step), 0.2 cm/s, 3 mm". `source`: what the base was made from, in a word.
std::string describe(const MotionChange& change, std::string_view source = "record");

/// The peaks that changed, as a sentence without its end: "makes PGA 0.52 g where its record has 0.5454 g (-4.7 %)"; empty without any.
std::string describe_changed_peaks(const MotionChange& change);

}  // namespace musim::records
