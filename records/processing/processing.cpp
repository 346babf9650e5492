#include "records/processing/processing.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <numeric>

#include "records/processing/cumulative.hpp"
#include "records/processing/transform.hpp"

namespace musim::records {
namespace {

// the quantity that has so many derivatives more
SampleQuantity neighbor(SampleQuantity quantity, int derivatives) {
    return find_quantity(is_rotation(quantity), derivative_order(quantity) + derivatives);
}

double dot(const std::vector<double>& a, const std::vector<double>& b) { return std::inner_product(a.begin(), a.end(), b.begin(), 0.0); }

double find_rms_about_mean(std::span<const double> samples) {
    const double mean = find_mean(samples);
    double sum = 0.0;
    for (const double sample : samples) sum += (sample - mean) * (sample - mean);
    return std::sqrt(sum / static_cast<double>(samples.size()));
}

// subtracts from `vector` its part along the unit vector `direction`
void remove_part(std::vector<double>& vector, const std::vector<double>& direction) {
    const double part = dot(vector, direction);
    for (std::size_t i = 0; i < vector.size(); ++i) vector[i] -= part * direction[i];
}

void refuse_displacement(const TimeSeries& series) {
    if (derivative_order(series.quantity()) > 0) return;
    throw ProcessingError(fmt::format("a{} {} is not integrated (nothing is its rate); integrate acceleration or velocity",
                                      is_rotation(series.quantity()) ? "n" : "", to_string(series.quantity())));
}

}  // namespace

TimeSeries cut(const TimeSeries& series, const TimeWindow& window) {
    // window edges in samples; rounding of times must not lose a sample that is meant
    constexpr double kEdge = 1e-6;
    const double first = std::ceil((window.start - series.start()).value() / series.dt().value() - kEdge);
    const double last = std::floor((window.end - series.start()).value() / series.dt().value() + kEdge);
    if (!(first >= 0.0 && last <= static_cast<double>(series.size() - 1) && first <= last)) {
        throw ProcessingError(
            fmt::format("window {:.6g} s to {:.6g} s does not fit (record lasts from {:.6g} s to {:.6g} s); change the window",
                        window.start.value(), window.end.value(), series.start().value(), series.end().value()));
    }
    const auto begin = static_cast<std::size_t>(first);
    const std::span<const double> kept = series.samples().subspan(begin, static_cast<std::size_t>(last) - begin + 1);
    return {series.quantity(), series.time(begin), series.dt(), {kept.begin(), kept.end()}};
}

std::size_t find_initial_part(const TimeSeries& series) {
    constexpr std::size_t kPart = 64;  // 5 s of a record of 320 s: longer than noise, shorter than pre-event parts
    return (series.size() - 1) / kPart + 1;
}

double find_initial_motion(const TimeSeries& series) {
    const double whole = find_rms_about_mean(series.samples());
    return whole > 0.0 ? find_rms_about_mean(series.samples().first(find_initial_part(series))) / whole : 0.0;
}

bool begins_in_motion(const TimeSeries& series) {
    constexpr double kQuiet = 0.1;
    return find_initial_motion(series) > kQuiet;
}

TimeSeries remove_initial_level(const TimeSeries& series) {
    const double level = find_mean(begins_in_motion(series) ? series.samples() : series.samples().first(find_initial_part(series)));
    std::vector<double> samples(series.samples().begin(), series.samples().end());
    for (double& sample : samples) sample -= level;
    return series.with_samples(std::move(samples));
}

TimeSeries remove_baseline(const TimeSeries& series, int order) {
    constexpr int kHighestBaseline = 3;
    if (order < 0 || order > kHighestBaseline) {
        throw ProcessingError(fmt::format("baseline order is {} (must be 0 to {}); choose one of these", order, kHighestBaseline));
    }
    if (series.size() <= static_cast<std::size_t>(order)) {
        throw ProcessingError(fmt::format("{} samples do not fix a baseline of order {}; lower the order", series.size(), order));
    }

    // orthonormal polynomials on the samples, by Gram-Schmidt on powers of τ in [−1, 1]; each is taken out of the record in turn
    std::vector<double> samples(series.samples().begin(), series.samples().end());
    std::vector<std::vector<double>> basis;
    const double middle = 0.5 * static_cast<double>(series.size() - 1);
    for (int degree = 0; degree <= order; ++degree) {
        std::vector<double> polynomial(series.size());
        for (std::size_t i = 0; i < polynomial.size(); ++i) {
            const double tau = (static_cast<double>(i) - middle) / (middle > 0.0 ? middle : 1.0);
            polynomial[i] = degree == 0 ? 1.0 : tau * basis.back()[i];
        }
        for (const std::vector<double>& lower : basis) remove_part(polynomial, lower);
        const double length = std::sqrt(dot(polynomial, polynomial));
        for (double& value : polynomial) value /= length;
        remove_part(samples, polynomial);
        basis.push_back(std::move(polynomial));
    }
    return series.with_samples(std::move(samples));
}

TimeSeries taper(const TimeSeries& series, double fraction) {
    if (!(fraction >= 0.0 && fraction <= 0.5)) {
        throw ProcessingError(fmt::format("taper fraction is {} (must be 0 to 0.5 of the record); choose one of these", fraction));
    }
    std::vector<double> samples(series.samples().begin(), series.samples().end());
    const double length = fraction * static_cast<double>(samples.size() - 1);  // in steps
    for (std::size_t i = 0; static_cast<double>(i) < length; ++i) {
        const double weight = 0.5 * (1.0 - std::cos(std::numbers::pi * static_cast<double>(i) / length));
        samples[i] *= weight;
        samples[samples.size() - 1 - i] *= weight;
    }
    return series.with_samples(std::move(samples));
}

TimeSeries amplify(const TimeSeries& series, double factor) {
    if (!std::isfinite(factor)) throw ProcessingError(fmt::format("a factor of {} is no number; give a finite one", factor));
    std::vector<double> samples(series.samples().begin(), series.samples().end());
    for (double& sample : samples) sample *= factor;
    return series.with_samples(std::move(samples));
}

TimeSeries pad(const TimeSeries& series, scaling::Time before, scaling::Time after) {
    constexpr double kMostSamples = 1e8;  // a gigabyte: surely a slip in the time
    const double dt = series.dt().value(), first = std::round(before.value() / dt), last = std::round(after.value() / dt);
    if (!(before.value() >= 0.0 && after.value() >= 0.0 && first + last <= kMostSamples)) {
        throw ProcessingError(
            fmt::format("{:.6g} s before and {:.6g} s after the record are impossible (0 or more, at most 1e8 samples); change them",
                        before.value(), after.value()));
    }
    std::vector<double> samples(static_cast<std::size_t>(first), 0.0);
    samples.insert(samples.end(), series.samples().begin(), series.samples().end());
    samples.resize(samples.size() + static_cast<std::size_t>(last), 0.0);
    return {series.quantity(), series.start() - first * series.dt(), series.dt(), std::move(samples)};
}

TimeSeries bring_to_rest(const TimeSeries& acceleration, AtRest at_rest) {
    require_acceleration(acceleration, "the correction to rest");
    constexpr std::size_t kFewestSamples = 4;
    if (acceleration.size() < kFewestSamples) {
        throw ProcessingError(fmt::format("{} samples cannot end at rest (at least {} are needed); use a longer record",
                                          acceleration.size(), kFewestSamples));
    }
    if (at_rest == AtRest::as_given) return acceleration;
    return acceleration.with_samples(detail::end_at_rest({acceleration.samples().begin(), acceleration.samples().end()},
                                                         acceleration.dt().value(),
                                                         at_rest == AtRest::home ? std::optional(0.0) : std::nullopt));
}

TimeSeries integrate(const TimeSeries& series) {
    refuse_displacement(series);
    return series.with_samples(neighbor(series.quantity(), -1), detail::cumulative_trapezoid(series.samples(), series.dt().value()));
}

TimeSeries integrate_by_frequency(const TimeSeries& series) {
    refuse_displacement(series);
    detail::Transform transform(series.samples());
    const double step = 2.0 * std::numbers::pi / (static_cast<double>(series.size()) * series.dt().value());
    transform.apply([&](std::size_t i) {
        const bool no_phase = i == 0 || 2 * i == series.size();
        return no_phase ? std::complex<double>() : std::complex<double>(0.0, -1.0 / (step * static_cast<double>(i)));
    });
    return series.with_samples(neighbor(series.quantity(), -1), transform.back());
}

TimeSeries differentiate(const TimeSeries& series) {
    if (derivative_order(series.quantity()) == 2) {
        throw ProcessingError("an acceleration is not differentiated (jerk is no quantity here); differentiate velocity or displacement");
    }
    if (series.size() < 2) throw ProcessingError("one sample has no rate; give a longer record");
    const std::span<const double> x = series.samples();
    const double dt = series.dt().value();
    std::vector<double> rate(x.size());
    rate.front() = (x[1] - x[0]) / dt;
    rate.back() = (x[x.size() - 1] - x[x.size() - 2]) / dt;
    for (std::size_t i = 1; i + 1 < x.size(); ++i) rate[i] = 0.5 * (x[i + 1] - x[i - 1]) / dt;
    return series.with_samples(neighbor(series.quantity(), 1), std::move(rate));
}

TimeWindow find_energy_window(const TimeSeries& acceleration, double from, double to, double margin) {
    require_acceleration(acceleration, "the strong-motion window");
    if (!(from >= 0.0 && from < to && to <= 1.0 && margin >= 0.0 && std::isfinite(margin))) {
        throw ProcessingError(fmt::format(
            "a window from {} to {} of the energy, {} of it added, is impossible (0 to 1, the first below); change it", from, to, margin));
    }
    const std::vector<double> energy = detail::cumulative_square(acceleration);
    if (!(energy.back() > 0.0)) throw ProcessingError("record has no motion (all samples zero); choose another component");
    const scaling::Time first = detail::time_of_share(acceleration, energy, from);
    const scaling::Time last = detail::time_of_share(acceleration, energy, to);
    const scaling::Time reach = margin * (last - first);
    return {std::max(acceleration.start(), first - reach), std::min(acceleration.end(), last + reach)};
}

TimeWindow find_strong_motion(const TimeSeries& acceleration, double margin) {
    return find_energy_window(acceleration, 0.005, 0.995, margin);
}

}  // namespace musim::records
