#include "records/shake_table/drive_motion.hpp"

namespace musim::records {
namespace {

constexpr int kLowPassOrder = 4;

/// The series with zeros around it; its own last sample, rounding, is zero too.
TimeSeries add_rest(const TimeSeries& series, scaling::Time rest) {
    std::vector<double> samples(series.samples().begin(), series.samples().end());
    samples.back() = 0.0;
    return pad(series.with_samples(std::move(samples)), rest, rest);
}

}  // namespace

Recipe make_drive_recipe(const GroundMotion& model, const DriveSettings& settings) {
    Recipe recipe;
    const SampleQuantity quantity = model.components.front().series.quantity();
    if (quantity == SampleQuantity::displacement) recipe.emplace_back(step::Differentiate{});
    if (quantity != SampleQuantity::acceleration) recipe.emplace_back(step::Differentiate{});
    if (model.components.size() > 1) recipe.emplace_back(step::Align{});
    if (model.integration_corner) recipe.emplace_back(step::Baseline{.order = 0});
    const auto corner = settings.high_pass ? settings.high_pass : model.integration_corner;
    if (corner || settings.low_pass) recipe.emplace_back(step::Taper{.fraction = kDefaultTaper});
    if (corner) recipe.emplace_back(step::Filter{.band = {.low = corner, .high = {}}});
    if (settings.low_pass) recipe.emplace_back(step::Filter{.band = {.low = {}, .high = settings.low_pass}, .order = kLowPassOrder});
    recipe.emplace_back(step::Taper{.fraction = kDefaultTaper});
    if (settings.amplitude != 1.0) recipe.emplace_back(step::Amplify{settings.amplitude});
    if (settings.dt) recipe.emplace_back(step::Resample{.dt = *settings.dt});
    recipe.emplace_back(step::Rest{});
    return recipe;
}

std::vector<DriveMotion> make_drive_motions(const GroundMotion& model, const DriveSettings& settings) {
    std::vector<DriveMotion> motions;
    for (const Component& component : process(model, make_drive_recipe(model, settings)).components) {
        motions.push_back(integrate_twice(component.series));
    }
    return motions;
}

DriveMotion integrate_twice(const TimeSeries& acceleration_at_rest) {
    require_quantity(acceleration_at_rest, SampleQuantity::acceleration, "a table's motion");
    const TimeSeries velocity = integrate(acceleration_at_rest);
    return {acceleration_at_rest, velocity, integrate(velocity)};
}

DriveMotion add_rest(const DriveMotion& motion, scaling::Time rest) {
    return {add_rest(motion.acceleration, rest), add_rest(motion.velocity, rest), add_rest(motion.displacement, rest)};
}

}  // namespace musim::records
