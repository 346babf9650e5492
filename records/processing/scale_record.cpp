#include "records/processing/scale_record.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace musim::records {
namespace {

/// λ of a quantity's samples; an angle is a ratio of lengths, its derivatives are divided by times.
double sample_factor(SampleQuantity quantity, const scaling::ModelScales& scales, scaling::Shaking direction) {
    const scaling::ShakingScales shaking = scales.shaking(direction);
    switch (quantity) {
        case SampleQuantity::acceleration:
            return shaking.acceleration;
        case SampleQuantity::velocity:
            return shaking.velocity;
        case SampleQuantity::displacement:
            return shaking.displacement;
        case SampleQuantity::angular_acceleration:
            return scales.angular_acceleration();
        case SampleQuantity::angular_velocity:
            return scales.angular_velocity();
        case SampleQuantity::angle:
            break;
    }
    return 1.0;
}

std::string describe_factors(const scaling::ModelScales& scales, const std::vector<scaling::Shaking>& directions, bool has_rotation) {
    std::string text = fmt::format("rescaled by the {} law: length {:.9g}, time {:.9g}, velocity {:.9g}, acceleration {:.9g}", scales.law,
                                   scales.height, scales.time, scales.velocity, scales.acceleration);
    const bool has_vertical = std::find(directions.begin(), directions.end(), scaling::Shaking::vertical) != directions.end();
    if (has_vertical && scales.acceleration_vertical != scales.acceleration) {
        text +=
            fmt::format(", vertical velocity {:.9g}, vertical acceleration {:.9g}", scales.velocity_vertical, scales.acceleration_vertical);
    }
    if (has_rotation) {
        text += fmt::format(", angle 1, angular velocity {:.9g}, angular acceleration {:.9g}", scales.angular_velocity(),
                            scales.angular_acceleration());
    }
    return text;
}

}  // namespace

scaling::Shaking find_shaking(const Component& component) {
    return is_vertical(component) ? scaling::Shaking::vertical : scaling::Shaking::horizontal;
}

TimeSeries rescale(const TimeSeries& prototype, const scaling::ModelScales& scales, scaling::Shaking direction) {
    const double factor = sample_factor(prototype.quantity(), scales, direction);
    std::vector<double> samples(prototype.samples().begin(), prototype.samples().end());
    for (double& sample : samples) sample *= factor;
    return {prototype.quantity(), prototype.start() * scales.time, prototype.dt() * scales.time, std::move(samples)};
}

GroundMotion rescale(const GroundMotion& prototype, const scaling::ModelScales& scales) {
    std::vector<scaling::Shaking> directions;
    for (const Component& component : prototype.components) directions.push_back(find_shaking(component));
    return rescale(prototype, scales, directions);
}

GroundMotion rescale(const GroundMotion& prototype, const scaling::ModelScales& scales, const std::vector<scaling::Shaking>& directions) {
    GroundMotion model = prototype;
    for (std::size_t c = 0; c < model.components.size(); ++c) {
        Component& component = model.components[c];
        component.series = rescale(component.series, scales, directions.at(c));
    }
    const auto turns = [](const Component& component) { return is_rotation(component); };
    const bool has_rotation = std::any_of(model.components.begin(), model.components.end(), turns);
    model.time_zero.reset();
    if (model.integration_corner) *model.integration_corner *= scales.frequency;
    model.history.push_back(describe_factors(scales, directions, has_rotation));
    return model;
}

}  // namespace musim::records
