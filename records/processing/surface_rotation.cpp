#include "records/processing/surface_rotation.hpp"

#include <fmt/format.h>

#include <cmath>
#include <utility>

#include "records/processing/processing.hpp"

namespace musim::records {
namespace {

/// The derivative of a translation times `slowness` [s/m]: an angle, or its rate.
TimeSeries turn_by(const TimeSeries& translation, double slowness) {
    if (is_rotation(translation.quantity())) {
        throw ProcessingError(fmt::format("rotation of the surface is found from a translation (the series holds {}); name another",
                                          to_string(translation.quantity())));
    }
    const TimeSeries moving = derivative_order(translation.quantity()) == 0 ? differentiate(translation) : translation;
    std::vector<double> samples(moving.samples().begin(), moving.samples().end());
    for (double& sample : samples) sample *= slowness;
    return moving.with_samples(find_quantity(true, derivative_order(moving.quantity()) - 1), std::move(samples));
}

double checked(scaling::Velocity apparent) {
    const double c = apparent.value();
    if (std::isfinite(c) && c != 0.0) return c;
    throw ProcessingError(fmt::format("apparent velocity is {} m/s (must be finite and not zero); give one such as 800 m/s", c));
}

}  // namespace

TimeSeries find_rocking(const TimeSeries& vertical, scaling::Velocity apparent) { return turn_by(vertical, 1.0 / checked(apparent)); }

TimeSeries find_torsion(const TimeSeries& transverse, scaling::Velocity apparent) { return turn_by(transverse, -0.5 / checked(apparent)); }

}  // namespace musim::records
