#pragma once

#include <span>
#include <string>
#include <string_view>
#include <variant>

#include "records/processing/base_motion.hpp"
#include "scaling/units.hpp"

/// Comparison of the motion that a base makes with the record that it was made from.
namespace musim::records {

/// Largest absolute values of a motion along an axis.
struct MotionPeaks {
    scaling::Acceleration pga{};
    scaling::Velocity pgv{};
    scaling::Length pgd{};  ///< displacement from where it begins
};

/// Largest absolute values of a rotation about an axis.
struct RotationPeaks {
    scaling::AngularAcceleration acceleration{};
    scaling::Frequency rate{};  ///< angular velocity
    scaling::Ratio angle{};     ///< from where it begins [rad]
};

/// Relative change from which peaks of acceleration and velocity of a base are no longer those of its record [-].
inline constexpr double kChangedPeak = 0.02;

/// Peaks of what a base makes and of what it was made from, and the largest differences of the two at any one time.
template <class Peaks>
struct PeakChange {
    Peaks record, base, difference;

    /// The peak of acceleration or of velocity of the base is off by more than kChangedPeak.
    bool is_changed() const;
};
using MotionChange = PeakChange<MotionPeaks>;
using RotationChange = PeakChange<RotationPeaks>;

/// Compares velocities [m/s] that are linear between samples dt [s] apart with a record on the same clock. The base's acceleration is
/// constant between samples; its largest difference from the record is the one from the mean of the record's two samples there, so that
/// straight lines of velocity change PGA but differ from nothing. A record without `acceleration` [m/s²] has that of its own straight
/// lines.
MotionChange compare_motions(std::span<const double> velocity, std::span<const double> record_velocity,
                             std::span<const double> record_acceleration, double dt);

/// The same of a rotation: rates [rad/s], and angular accelerations [rad/s²] of the record.
RotationChange compare_rotations(std::span<const double> rate, std::span<const double> record_rate,
                                 std::span<const double> record_acceleration, double dt);

/// The same of a velocity, or an angular one, and of the record on its clock.
MotionChange compare_motions(const TimeSeries& velocity, const RecordedMotion& record);
RotationChange compare_rotations(const TimeSeries& rate, const RecordedMotion& record);

/// Comparison of a component of a base, whichever it is.
using ComponentChange = std::variant<MotionChange, RotationChange>;

ComponentChange compare_component(const TimeSeries& velocity, const RecordedMotion& record);

/// "PGA 0.52 g (record 0.5454 g, -4.7 %), PGV 4.39 cm/s (record 4.4 cm/s, -0.2 %), PGD ...; largest difference at any time 0.01 g (of
/// means over a step), 0.2 cm/s, 3 mm". `source`: what the base was made from, in a word.
std::string describe(const MotionChange& change, std::string_view source = "record");

/// The same of a rotation: "angular acceleration 0.52 rad/s^2 (record ...), angular velocity 4 deg/s (...), angle 0.3 deg (...); ...".
std::string describe(const RotationChange& change, std::string_view source = "record");

/// The peaks that changed, as a sentence without its end: "makes PGA 0.52 g where its record has 0.5454 g (-4.7 %)"; empty without any.
std::string describe_changed_peaks(const MotionChange& change);
std::string describe_changed_peaks(const RotationChange& change);

}  // namespace musim::records
