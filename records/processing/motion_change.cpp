#include "records/processing/motion_change.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "records/processing/cumulative.hpp"
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

MotionPeaks make_peaks(double acceleration, double velocity, double displacement) {
    return {scaling::Acceleration::from_value(acceleration), scaling::Velocity::from_value(velocity),
            scaling::Length::from_value(displacement)};
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

std::vector<NamedPeak> name_peaks(const MotionChange& change) {
    const MotionPeaks &base = change.base, &record = change.record;
    return {{"PGA", in_gravities(base.pga), in_gravities(record.pga), base.pga.value(), record.pga.value()},
            {"PGV", scaling::format_quantity(base.pgv, 3), scaling::format_quantity(record.pgv, 3), base.pgv.value(), record.pgv.value()},
            {"PGD", scaling::format_quantity(base.pgd, 3), scaling::format_quantity(record.pgd, 3), base.pgd.value(), record.pgd.value()}};
}

/// PGA and PGV where they changed; displacement is what an end at home takes.
std::vector<NamedPeak> name_changed_peaks(const MotionChange& change) {
    std::vector<NamedPeak> peaks = name_peaks(change);
    peaks.pop_back();
    std::erase_if(peaks, [](const NamedPeak& peak) { return !peak.is_changed(); });
    return peaks;
}

}  // namespace

bool MotionChange::is_changed() const { return !name_changed_peaks(*this).empty(); }

MotionChange compare_motions(std::span<const double> velocity, std::span<const double> record_velocity,
                             std::span<const double> record_acceleration, double dt) {
    const std::vector<double> made = find_slopes(velocity, dt), own = find_slopes(record_velocity, dt);
    std::vector<double> between = own;
    if (!record_acceleration.empty()) {
        for (std::size_t k = 0; k < between.size(); ++k) between[k] = 0.5 * (record_acceleration[k] + record_acceleration[k + 1]);
    }
    const std::vector<double> path = detail::cumulative_trapezoid(velocity, dt);
    const std::vector<double> record_path = detail::cumulative_trapezoid(record_velocity, dt);
    return {.record = make_peaks(find_largest(record_acceleration.empty() ? std::span<const double>(own) : record_acceleration),
                                 find_largest(record_velocity), find_largest(record_path)),
            .base = make_peaks(find_largest(made), find_largest(velocity), find_largest(path)),
            .difference = make_peaks(find_largest_difference(made, between), find_largest_difference(velocity, record_velocity),
                                     find_largest_difference(path, record_path))};
}

MotionChange compare_motions(const TimeSeries& velocity, const RecordedMotion& record) {
    const auto& acceleration = record.acceleration;
    return compare_motions(velocity.samples(), record.velocity.samples(),
                           acceleration ? acceleration->samples() : std::span<const double>(), velocity.dt().value());
}

std::string describe(const MotionChange& change, std::string_view source) {
    std::string text;
    for (const NamedPeak& peak : name_peaks(change)) {
        text += fmt::format("{}{} {} ({} {}, {})", text.empty() ? "" : ", ", peak.name, peak.base, source, peak.record, peak.change());
    }
    return text + fmt::format("; largest difference at any time {} (of means over a step), {}, {}", in_gravities(change.difference.pga),
                              scaling::format_quantity(change.difference.pgv, 3), scaling::format_quantity(change.difference.pgd, 3));
}

std::string describe_changed_peaks(const MotionChange& change) {
    std::string text;
    for (const NamedPeak& peak : name_changed_peaks(change)) {
        text += fmt::format("{} {} {} where its record has {} ({})", text.empty() ? "makes" : " and", peak.name, peak.base, peak.record,
                            peak.change());
    }
    return text;
}

}  // namespace musim::records
