#include "records/processing/motion_change.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "records/processing/cumulative.hpp"
#include "scaling/angle.hpp"
#include "scaling/quantity_text.hpp"

namespace musim::records {
namespace {

std::vector<double> find_slopes(std::span<const double> velocity, double dt) {
    std::vector<double> slopes;
    for (std::size_t k = 1; k < velocity.size(); ++k) slopes.push_back((velocity[k] - velocity[k - 1]) / dt);
    return slopes;
}

double find_largest_difference(std::span<const double> a, std::span<const double> b) {
    double largest = 0.0;
    for (std::size_t k = 0; k < a.size(); ++k) largest = std::max(largest, std::abs(a[k] - b[k]));
    return largest;
}

/// Largest values that a comparison finds, in SI.
struct Largest {
    double acceleration, velocity, displacement;
};

MotionPeaks to_motion(const Largest& peaks) {
    return {scaling::Acceleration::from_value(peaks.acceleration), scaling::Velocity::from_value(peaks.velocity),
            scaling::Length::from_value(peaks.displacement)};
}

RotationPeaks to_rotation(const Largest& peaks) {
    return {scaling::AngularAcceleration::from_value(peaks.acceleration), scaling::Frequency::from_value(peaks.velocity),
            scaling::Ratio::from_value(peaks.displacement)};
}

std::string in_gravities(scaling::Acceleration acceleration) {
    return fmt::format("{:.4g} g", (acceleration / scaling::kStandardGravity).value());
}

/// "-4.7 %"; of a record that has none, nothing to divide by.
std::string write_change(double base, double record) {
    if (!(record > 0.0)) return "none";
    const double percent = 100.0 * (base / record - 1.0);
    return std::abs(percent) < 0.05 ? "0 %" : fmt::format("{:+.1f} %", percent);
}

/// A peak of base and record by name.
struct NamedPeak {
    const char* name;
    std::string base, record;
    double base_si, record_si;

    bool is_changed() const { return record_si > 0.0 && std::abs(base_si / record_si - 1.0) > kChangedPeak; }
    std::string change() const { return write_change(base_si, record_si); }
};

std::string in_degrees(double angle, const char* unit) { return fmt::format("{:.3g} {}", angle * scaling::kDegrees, unit); }

/// Sizes of peaks as text, in the order acceleration, velocity, displacement.
std::array<std::string, 3> write_sizes(const MotionPeaks& peaks) {
    return {in_gravities(peaks.pga), scaling::format_quantity(peaks.pgv, 3), scaling::format_quantity(peaks.pgd, 3)};
}

std::array<std::string, 3> write_sizes(const RotationPeaks& peaks) {
    return {fmt::format("{:.4g} rad/s^2", peaks.acceleration.value()), in_degrees(peaks.rate.value(), "deg/s"),
            in_degrees(peaks.angle.value(), "deg")};
}

std::vector<NamedPeak> name_peaks(const MotionChange& change) {
    const MotionPeaks &base = change.base, &record = change.record;
    const std::array<std::string, 3> of_base = write_sizes(base), of_record = write_sizes(record);
    return {{"PGA", of_base[0], of_record[0], base.pga.value(), record.pga.value()},
            {"PGV", of_base[1], of_record[1], base.pgv.value(), record.pgv.value()},
            {"PGD", of_base[2], of_record[2], base.pgd.value(), record.pgd.value()}};
}

std::vector<NamedPeak> name_peaks(const RotationChange& change) {
    const RotationPeaks &base = change.base, &record = change.record;
    const std::array<std::string, 3> of_base = write_sizes(base), of_record = write_sizes(record);
    return {{"angular acceleration", of_base[0], of_record[0], base.acceleration.value(), record.acceleration.value()},
            {"angular velocity", of_base[1], of_record[1], base.rate.value(), record.rate.value()},
            {"angle", of_base[2], of_record[2], base.angle.value(), record.angle.value()}};
}

/// Peaks of acceleration and velocity where they changed; displacement is what an end at home takes.
template <class Change>
std::vector<NamedPeak> name_changed_peaks(const Change& change) {
    std::vector<NamedPeak> peaks = name_peaks(change);
    peaks.pop_back();
    std::erase_if(peaks, [](const NamedPeak& peak) { return !peak.is_changed(); });
    return peaks;
}

template <class Change>
std::string describe_peaks(const Change& change, std::string_view source) {
    std::string text;
    for (const NamedPeak& peak : name_peaks(change)) {
        text += fmt::format("{}{} {} ({} {}, {})", text.empty() ? "" : ", ", peak.name, peak.base, source, peak.record, peak.change());
    }
    const std::array<std::string, 3> difference = write_sizes(change.difference);
    return text +
           fmt::format("; largest difference at any time {} (of means over a step), {}, {}", difference[0], difference[1], difference[2]);
}

template <class Change>
std::string name_changes(const Change& change) {
    std::string text;
    for (const NamedPeak& peak : name_changed_peaks(change)) {
        text += fmt::format("{} {} {} where its record has {} ({})", text.empty() ? "makes" : " and", peak.name, peak.base, peak.record,
                            peak.change());
    }
    return text;
}

/// Accelerations that a record holds itself; none of one of velocities or displacements.
std::span<const double> find_own_acceleration(const RecordedMotion& record) {
    return record.acceleration ? record.acceleration->samples() : std::span<const double>();
}

/// Largest values of record and base, and of their difference.
PeakChange<Largest> compare(std::span<const double> velocity, std::span<const double> record_velocity,
                            std::span<const double> record_acceleration, double dt) {
    const std::vector<double> made = find_slopes(velocity, dt), own = find_slopes(record_velocity, dt);
    std::vector<double> between = own;
    if (!record_acceleration.empty()) {
        for (std::size_t k = 0; k < between.size(); ++k) between[k] = 0.5 * (record_acceleration[k] + record_acceleration[k + 1]);
    }
    const std::vector<double> path = detail::cumulative_trapezoid(velocity, dt);
    const std::vector<double> record_path = detail::cumulative_trapezoid(record_velocity, dt);
    return {.record = {find_largest(record_acceleration.empty() ? std::span<const double>(own) : record_acceleration),
                       find_largest(record_velocity), find_largest(record_path)},
            .base = {find_largest(made), find_largest(velocity), find_largest(path)},
            .difference = {find_largest_difference(made, between), find_largest_difference(velocity, record_velocity),
                           find_largest_difference(path, record_path)}};
}

}  // namespace

template <class Peaks>
bool PeakChange<Peaks>::is_changed() const {
    return !name_changed_peaks(*this).empty();
}
template struct PeakChange<MotionPeaks>;
template struct PeakChange<RotationPeaks>;

MotionChange compare_motions(std::span<const double> velocity, std::span<const double> record_velocity,
                             std::span<const double> record_acceleration, double dt) {
    const PeakChange<Largest> found = compare(velocity, record_velocity, record_acceleration, dt);
    return {to_motion(found.record), to_motion(found.base), to_motion(found.difference)};
}

RotationChange compare_rotations(std::span<const double> rate, std::span<const double> record_rate,
                                 std::span<const double> record_acceleration, double dt) {
    const PeakChange<Largest> found = compare(rate, record_rate, record_acceleration, dt);
    return {to_rotation(found.record), to_rotation(found.base), to_rotation(found.difference)};
}

MotionChange compare_motions(const TimeSeries& velocity, const RecordedMotion& record) {
    return compare_motions(velocity.samples(), record.velocity.samples(), find_own_acceleration(record), velocity.dt().value());
}

RotationChange compare_rotations(const TimeSeries& rate, const RecordedMotion& record) {
    return compare_rotations(rate.samples(), record.velocity.samples(), find_own_acceleration(record), rate.dt().value());
}

ComponentChange compare_component(const TimeSeries& velocity, const RecordedMotion& record) {
    if (is_rotation(velocity.quantity())) return compare_rotations(velocity, record);
    return compare_motions(velocity, record);
}

std::string describe(const MotionChange& change, std::string_view source) { return describe_peaks(change, source); }
std::string describe(const RotationChange& change, std::string_view source) { return describe_peaks(change, source); }

std::string describe_changed_peaks(const MotionChange& change) { return name_changes(change); }
std::string describe_changed_peaks(const RotationChange& change) { return name_changes(change); }

}  // namespace musim::records
