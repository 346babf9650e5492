#include "records/processing/base_motion.hpp"

#include <fmt/format.h>

#include "records/processing/cumulative.hpp"

namespace musim::records {
namespace {

// window, mean, taper and high-pass, each noted
TimeSeries prepare(TimeSeries series, const BaseMotionSettings& settings, std::vector<std::string>& steps) {
    if (settings.window) {
        series = cut(series, *settings.window);
        steps.push_back(fmt::format("cut to {:.6g} s ... {:.6g} s", series.start().value(), series.end().value()));
    }
    if (settings.take_out_mean) {
        series = remove_baseline(series, 0);
        steps.emplace_back("baseline of order 0 removed");
    }
    if (settings.window || settings.high_pass) {
        series = taper(series, kDefaultTaper);
        steps.push_back(fmt::format("cosine taper over {:.6g} of each end", kDefaultTaper));
    }
    if (settings.high_pass) {
        series = high_pass(series, *settings.high_pass, 2);
        steps.push_back(fmt::format("Butterworth high-pass at {:.6g} Hz, order 2, two passes", settings.high_pass->value()));
    }
    return series;
}

TimeSeries to_velocity(const TimeSeries& series) {
    if (series.quantity() == SampleQuantity::acceleration) return integrate(series);
    if (series.quantity() == SampleQuantity::displacement) return differentiate(series);
    return series;
}

}  // namespace

BaseMotion make_base_motion(const TimeSeries& series, const BaseMotionSettings& settings) {
    std::vector<std::string> steps;
    const TimeSeries velocity = to_velocity(prepare(series, settings, steps));
    constexpr std::size_t kFewestSamples = 4;
    if (velocity.size() < kFewestSamples) {
        throw ProcessingError(fmt::format("{} samples cannot end at rest (at least {} are needed); use a longer record or window",
                                          velocity.size(), kFewestSamples));
    }

    // start from rest, then take out what is left at the end
    const double dt = velocity.dt().value();
    std::vector<double> v(velocity.samples().begin(), velocity.samples().end());
    const double initial = v.front();
    for (double& value : v) value -= initial;
    const double drift = detail::cumulative_trapezoid(v, dt).back();
    const std::vector<double> correction = detail::cumulative_trapezoid(detail::rest_correction(v.size(), dt, v.back(), drift), dt);
    for (std::size_t i = 0; i < v.size(); ++i) v[i] -= correction[i];
    v.back() = 0.0;  // was rounding
    steps.push_back(fmt::format("ended at rest: {:.3e} m/s and {:.3e} m taken out", correction.back(), drift));

    TimeSeries corrected = velocity.with_samples(std::move(v));
    TimeSeries displacement = integrate(corrected);
    const scaling::Length residual = displacement.samples().back() * scaling::si::meters;
    return {std::move(corrected), std::move(displacement), residual, std::move(steps)};
}

BaseMotion make_base_motion(const GroundMotion& motion, std::string_view component, BaseMotionSettings settings) {
    if (!settings.high_pass) settings.high_pass = motion.integration_corner;
    // an uncorrected record has its zero anywhere
    settings.take_out_mean = settings.take_out_mean || motion.integration_corner.has_value();
    return make_base_motion(motion.find_component(component).series, settings);
}

}  // namespace musim::records
