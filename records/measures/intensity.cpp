#include "records/measures/intensity.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "records/processing/cumulative.hpp"
#include "records/processing/processing.hpp"

namespace musim::records {

namespace {

template <class Quantity>
Peak<Quantity> find_peak(const TimeSeries& series) {
    const std::span<const double> samples = series.samples();
    std::size_t largest = 0;
    for (std::size_t i = 1; i < samples.size(); ++i) {
        if (std::abs(samples[i]) > std::abs(samples[largest])) largest = i;
    }
    return {Quantity::from_value(samples[largest]), series.time(largest)};
}

}  // namespace

Peak<scaling::Acceleration> find_peak_acceleration(const TimeSeries& acceleration) {
    require_quantity(acceleration, SampleQuantity::acceleration, "PGA");
    return find_peak<scaling::Acceleration>(acceleration);
}

Peak<scaling::Velocity> find_peak_velocity(const TimeSeries& velocity) {
    require_quantity(velocity, SampleQuantity::velocity, "PGV");
    return find_peak<scaling::Velocity>(velocity);
}

Peak<scaling::Length> find_peak_displacement(const TimeSeries& displacement) {
    require_quantity(displacement, SampleQuantity::displacement, "PGD");
    return find_peak<scaling::Length>(displacement);
}

scaling::Velocity compute_arias_intensity(const TimeSeries& acceleration, scaling::Acceleration gravity) {
    require_quantity(acceleration, SampleQuantity::acceleration, "Arias intensity");
    const double integral = detail::cumulative_square(acceleration).back();  // [m²/s³]
    return scaling::Velocity::from_value(0.5 * std::numbers::pi / gravity.value() * integral);
}

scaling::Time compute_significant_duration(const TimeSeries& acceleration, double from, double to) {
    require_quantity(acceleration, SampleQuantity::acceleration, "significant duration");
    if (!(0.0 <= from && from < to && to <= 1.0)) {
        throw ProcessingError(
            fmt::format("no significant duration between the shares {} and {} (0 <= from < to <= 1); change them", from, to));
    }
    const std::vector<double> energy = detail::cumulative_square(acceleration);
    if (!(energy.back() > 0.0)) return {};
    return detail::time_of_share(acceleration, energy, to) - detail::time_of_share(acceleration, energy, from);
}

Intensity compute_intensity(const TimeSeries& series, std::optional<scaling::Frequency> integration_corner) {
    const MotionHistories histories = compute_histories(series, integration_corner);
    Intensity intensity;
    if (is_rotation(series.quantity())) {
        if (histories.acceleration) intensity.angular_acceleration = find_peak<scaling::AngularAcceleration>(*histories.acceleration);
        if (histories.velocity) intensity.angular_velocity = find_peak<scaling::Frequency>(*histories.velocity);
        intensity.angle = find_peak<scaling::Ratio>(histories.displacement);
        return intensity;
    }
    if (histories.acceleration) {
        intensity.pga = find_peak_acceleration(*histories.acceleration);
        intensity.arias = compute_arias_intensity(*histories.acceleration);
        intensity.d5_95 = compute_significant_duration(*histories.acceleration);
    }
    if (histories.velocity) intensity.pgv = find_peak_velocity(*histories.velocity);
    intensity.pgd = find_peak_displacement(histories.displacement);
    return intensity;
}

MotionHistories compute_histories(const TimeSeries& series, std::optional<scaling::Frequency> integration_corner) {
    switch (derivative_order(series.quantity())) {
        case 2: {
            const TimeSeries velocity = integrate_record(series, integration_corner);
            // a high-passed motion has no mean velocity; what is left of the ends of the record would become a drift
            const TimeSeries displacement = integrate(integration_corner ? remove_baseline(velocity, 0) : velocity);
            return {level_uncorrected(series, integration_corner), velocity, displacement};
        }
        case 1:
            return {std::nullopt, series, integrate(series)};
        default:
            return {std::nullopt, std::nullopt, series};
    }
}

std::vector<double> compute_arias_share(const TimeSeries& acceleration) {
    require_quantity(acceleration, SampleQuantity::acceleration, "Arias build-up");
    std::vector<double> share = detail::cumulative_square(acceleration);
    const double whole = share.back();
    if (!(whole > 0.0)) return std::vector<double>(share.size(), 0.0);
    for (double& value : share) value /= whole;
    return share;
}

const Component& find_strongest_horizontal(const GroundMotion& motion) {
    const auto& all = motion.components;
    const bool directions_known = std::any_of(all.begin(), all.end(), [](const auto& c) { return c.azimuth_deg.has_value(); });
    const auto strength = [&](const Component& component) {
        return is_rotation(component) || (directions_known && !component.azimuth_deg)
                   ? -1.0
                   : std::abs(find_peak_acceleration(level_uncorrected(component.series, motion.integration_corner)).value.value());
    };
    if (std::all_of(all.begin(), all.end(), [](const Component& component) { return is_rotation(component); })) {
        throw ProcessingError(
            fmt::format("no component is a translation (present: {}); read one with accelerations", motion.component_names()));
    }
    return *std::max_element(all.begin(), all.end(), [&](const auto& a, const auto& b) { return strength(a) < strength(b); });
}

}  // namespace musim::records
