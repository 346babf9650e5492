#include "records/processing/base_motion.hpp"

#include <fmt/format.h>

#include <utility>

#include "records/processing/cumulative.hpp"
#include "records/processing/uncorrected.hpp"

namespace musim::records {
namespace {

/// Mean, taper and high-pass of the whole series, each noted.
TimeSeries filter_whole(TimeSeries series, const BaseMotionSettings& settings, std::vector<std::string>& steps) {
    if (settings.take_out_mean) {
        series = remove_baseline(series, 0);
        steps.emplace_back("baseline of order 0 removed");
    }
    if (settings.high_pass) {
        series = high_pass(taper(series, kDefaultTaper), *settings.high_pass, 2);
        steps.push_back(fmt::format("cosine taper over {:.6g} of each end", kDefaultTaper));
        steps.push_back(fmt::format("Butterworth high-pass at {:.6g} Hz, order 2, two passes", settings.high_pass->value()));
    }
    return series;
}

TimeSeries to_velocity(const TimeSeries& series) {
    const int order = derivative_order(series.quantity());
    if (order == 2) return integrate(series);
    return order == 0 ? differentiate(series) : series;
}

TimeSeries cut_to(const TimeSeries& series, const std::optional<TimeWindow>& window) { return window ? cut(series, *window) : series; }

/// Velocities counted from the first one.
TimeSeries count_from_first(const TimeSeries& velocity) {
    std::vector<double> samples(velocity.samples().begin(), velocity.samples().end());
    const double initial = samples.front();
    for (double& sample : samples) sample -= initial;
    return velocity.with_samples(std::move(samples));
}

RecordedMotion find_recorded(const TimeSeries& series, const BaseMotionSettings& settings) {
    const bool is_acceleration = derivative_order(series.quantity()) == 2;
    const TimeSeries velocity = is_acceleration ? integrate_record(series, settings.integration_corner) : to_velocity(series);
    RecordedMotion part{.acceleration = {}, .velocity = cut_to(velocity, settings.window)};
    if (is_acceleration) part.acceleration = cut_to(level_uncorrected(series, settings.integration_corner), settings.window);
    if (settings.at_rest == AtRest::as_given) part.velocity = count_from_first(part.velocity);
    return part;
}

/// The velocity less what keeps it from ending at rest.
TimeSeries end_at_rest(const TimeSeries& velocity, const BaseMotionSettings& settings, std::vector<std::string>& steps) {
    const double dt = velocity.dt().value();
    std::vector<double> v(velocity.samples().begin(), velocity.samples().end());
    const double drift = detail::cumulative_trapezoid(v, dt).back();
    const bool home = settings.at_rest == AtRest::home;
    const detail::RestShape shape = settings.window ? detail::RestShape::open : detail::RestShape::faded;
    const std::vector<double> correction = detail::cumulative_trapezoid(
        detail::rest_correction(v.size(), dt, v.back(), home ? std::optional(drift) : std::nullopt, shape), dt);
    for (std::size_t i = 0; i < v.size(); ++i) v[i] -= correction[i];
    v.back() = 0.0;  // was rounding
    const std::string unit(si_unit_name(find_quantity(is_rotation(velocity.quantity()), 0)));
    steps.push_back(home ? fmt::format("ended at rest: {:.3e} {}/s and {:.3e} {} taken out", correction.back(), unit, drift, unit)
                         : fmt::format("ended at rest: {:.3e} {}/s taken out", correction.back(), unit));
    return velocity.with_samples(std::move(v));
}

}  // namespace

BaseMotion make_base_motion(const TimeSeries& series, const BaseMotionSettings& settings) {
    std::vector<std::string> steps;
    const TimeSeries whole = to_velocity(filter_whole(series, settings, steps));
    if (settings.window) {
        steps.push_back(fmt::format("cut to {:.6g} s ... {:.6g} s", settings.window->start.value(), settings.window->end.value()));
    }
    TimeSeries velocity = count_from_first(cut_to(whole, settings.window));
    constexpr std::size_t kFewestSamples = 4;
    if (velocity.size() < kFewestSamples) {
        throw ProcessingError(fmt::format("{} samples cannot end at rest (at least {} are needed); use a longer record or window",
                                          velocity.size(), kFewestSamples));
    }
    if (settings.at_rest != AtRest::as_given) velocity = end_at_rest(velocity, settings, steps);
    TimeSeries displacement = integrate(velocity);
    return {std::move(velocity), std::move(displacement), find_recorded(series, settings), std::move(steps)};
}

BaseMotion make_base_motion(const GroundMotion& motion, std::string_view component, BaseMotionSettings settings) {
    settings.integration_corner = motion.integration_corner;
    if (!settings.high_pass) settings.high_pass = motion.integration_corner;
    // an uncorrected record has its zero anywhere
    settings.take_out_mean = settings.take_out_mean || motion.integration_corner.has_value();
    return make_base_motion(motion.find_component(component).series, settings);
}

}  // namespace musim::records
