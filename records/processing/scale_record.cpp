#include "records/processing/scale_record.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace musim::records {
namespace {

double sample_factor(SampleQuantity quantity, const scaling::ShakingScales& scales) {
    if (quantity == SampleQuantity::acceleration) return scales.acceleration;
    if (quantity == SampleQuantity::velocity) return scales.velocity;
    return scales.displacement;
}

std::string describe_factors(const scaling::ModelScales& scales, const std::vector<scaling::Shaking>& directions) {
    std::string text = fmt::format("rescaled by the {} law: length {:.9g}, time {:.9g}, velocity {:.9g}, acceleration {:.9g}", scales.law,
                                   scales.height, scales.time, scales.velocity, scales.acceleration);
    const bool has_vertical = std::find(directions.begin(), directions.end(), scaling::Shaking::vertical) != directions.end();
    if (has_vertical && scales.acceleration_vertical != scales.acceleration) {
        text +=
            fmt::format(", vertical velocity {:.9g}, vertical acceleration {:.9g}", scales.velocity_vertical, scales.acceleration_vertical);
    }
    return text;
}

}  // namespace

scaling::Shaking find_shaking(const Component& component) {
    return is_vertical(component) ? scaling::Shaking::vertical : scaling::Shaking::horizontal;
}

TimeSeries rescale(const TimeSeries& prototype, const scaling::ModelScales& scales, scaling::Shaking direction) {
    const double factor = sample_factor(prototype.quantity(), scales.shaking(direction));
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
    model.time_zero.reset();
    if (model.integration_corner) *model.integration_corner *= scales.frequency;
    model.history.push_back(describe_factors(scales, directions));
    return model;
}

}  // namespace musim::records
