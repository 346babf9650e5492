#include "records/scale_record.hpp"

#include <fmt/format.h>

namespace musim::records {
namespace {

double sample_factor(SampleQuantity quantity, const scaling::Similitude& similitude) {
    if (quantity == SampleQuantity::acceleration) return similitude.factor<scaling::Acceleration>();
    if (quantity == SampleQuantity::velocity) return similitude.factor<scaling::Velocity>();
    return similitude.factor<scaling::Length>();
}

}  // namespace

TimeSeries rescale(const TimeSeries& prototype, const scaling::Similitude& similitude) {
    const double factor = sample_factor(prototype.quantity(), similitude);
    std::vector<double> samples(prototype.samples().begin(), prototype.samples().end());
    for (double& sample : samples) sample *= factor;
    return {prototype.quantity(), similitude.to_model(prototype.start()), similitude.to_model(prototype.dt()), std::move(samples)};
}

GroundMotion rescale(const GroundMotion& prototype, const scaling::Similitude& similitude) {
    GroundMotion model = prototype;
    for (Component& component : model.components) component.series = rescale(component.series, similitude);
    model.time_zero.reset();
    if (model.integration_corner) model.integration_corner = similitude.to_model(*model.integration_corner);
    model.history.push_back(fmt::format("rescaled by the {} law: length {:.9g}, time {:.9g}, velocity {:.9g}, acceleration {:.9g}",
                                        similitude.law_name(), similitude.length(), similitude.time(), similitude.velocity(),
                                        similitude.acceleration()));
    return model;
}

}  // namespace musim::records
