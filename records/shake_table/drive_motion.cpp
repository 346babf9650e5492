#include "records/shake_table/drive_motion.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "records/processing/align.hpp"

namespace musim::records {
namespace {

constexpr int kLowPassOrder = 4;

/// Last velocity of a motion at rest, and last displacement of one that came home, over its largest: rounding of sums.
constexpr double kAtRest = 1e-6;

/// The series held at its first and last value around it.
TimeSeries hold(const TimeSeries& series, scaling::Time rest, double last) {
    std::vector<double> samples(series.samples().begin(), series.samples().end());
    samples.back() = last;
    const TimeSeries padded = pad(series.with_samples(std::move(samples)), rest, rest);
    std::vector<double> held(padded.samples().begin(), padded.samples().end());
    const auto after = static_cast<std::ptrdiff_t>((padded.size() - series.size()) / 2);
    std::fill(held.end() - after, held.end(), last);
    return padded.with_samples(std::move(held));
}

}  // namespace

Recipe make_drive_recipe(const GroundMotion& model, const DriveSettings& settings) {
    Recipe recipe;
    const int order = derivative_order(model.components.front().series.quantity());
    const bool is_mixed = std::any_of(model.components.begin(), model.components.end(),
                                      [&](const Component& each) { return derivative_order(each.series.quantity()) != order; });
    if (is_mixed) recipe.emplace_back(step::ToAcceleration{});
    for (int i = order; i < 2 && !is_mixed; ++i) recipe.emplace_back(step::Differentiate{});
    if (model.components.size() > 1) recipe.emplace_back(step::Align{});
    if (model.integration_corner) recipe.emplace_back(step::Baseline{.order = 0});
    const auto corner = settings.high_pass ? settings.high_pass : model.integration_corner;
    if (corner || settings.low_pass) recipe.emplace_back(step::Taper{.fraction = kDefaultTaper});
    if (corner) recipe.emplace_back(step::Filter{.band = {.low = corner, .high = {}}});
    if (settings.low_pass) recipe.emplace_back(step::Filter{.band = {.low = {}, .high = settings.low_pass}, .order = kLowPassOrder});
    if (settings.amplitude != 1.0) recipe.emplace_back(step::Amplify{settings.amplitude});
    if (settings.dt) recipe.emplace_back(step::Resample{.dt = *settings.dt});
    if (settings.at_rest != AtRest::as_given) recipe.emplace_back(step::Rest{.displaced = settings.at_rest == AtRest::displaced});
    return recipe;
}

std::vector<DriveMotion> make_drive_motions(const GroundMotion& model, const DriveSettings& settings) {
    std::vector<DriveMotion> motions;
    for (const Component& component : process(model, make_drive_recipe(model, settings)).components) {
        motions.push_back(integrate_twice(component.series));
    }
    return motions;
}

std::vector<ComponentChange> compare_drive_motions(const GroundMotion& model, const DriveSettings& settings) {
    const std::vector<DriveMotion> motions = make_drive_motions(model, settings), own = make_drive_motions(model, settings.at_own_step());
    const GroundMotion aligned = model.components.size() > 1 ? align(model) : model;
    std::vector<ComponentChange> changes;
    for (std::size_t c = 0; c < motions.size(); ++c) {
        const RecordedMotion record =
            make_base_motion(aligned.components[c].series, {.integration_corner = model.integration_corner}).record;
        ComponentChange& change = changes.emplace_back(compare_component(own[c].velocity, record));
        const double acceleration = find_largest(motions[c].acceleration.samples());
        const double velocity = find_largest(motions[c].velocity.samples());
        const double displacement = find_largest(motions[c].displacement.samples());
        if (auto* const motion = std::get_if<MotionChange>(&change)) {
            motion->base = {.pga = scaling::Acceleration::from_value(acceleration),
                            .pgv = scaling::Velocity::from_value(velocity),
                            .pgd = scaling::Length::from_value(displacement)};
        } else {
            std::get<RotationChange>(change).base = {.acceleration = scaling::AngularAcceleration::from_value(acceleration),
                                                     .rate = scaling::Frequency::from_value(velocity),
                                                     .angle = scaling::Ratio::from_value(displacement)};
        }
    }
    return changes;
}

DriveMotion integrate_twice(const TimeSeries& acceleration_at_rest) {
    require_acceleration(acceleration_at_rest, "a table's motion");
    const TimeSeries velocity = integrate(acceleration_at_rest);
    return {acceleration_at_rest, velocity, integrate(velocity)};
}

DriveMotion add_rest(const DriveMotion& motion, scaling::Time rest) {
    const double last = std::abs(motion.velocity.samples().back());
    if (!(last <= kAtRest * find_largest(motion.velocity.samples()))) {
        throw ProcessingError(fmt::format("the motion ends at {:.3g} {} (a table must stop); let it end at rest, displaced if need be",
                                          last, si_unit_name(motion.velocity.quantity())));
    }
    const double end = motion.displacement.samples().back();
    const bool is_home = std::abs(end) <= kAtRest * find_largest(motion.displacement.samples());
    return {hold(motion.acceleration, rest, 0.0), hold(motion.velocity, rest, 0.0), hold(motion.displacement, rest, is_home ? 0.0 : end)};
}

}  // namespace musim::records
