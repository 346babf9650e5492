#include "records/formats/resample_uneven.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "records/detail/text.hpp"

namespace musim::records {
namespace {

bool are_finite(std::span<const double> values) {
    return std::all_of(values.begin(), values.end(), [](double value) { return std::isfinite(value); });
}

void check_timed_samples(std::span<const double> times, std::span<const double> samples) {
    if (times.size() < 2 || times.size() != samples.size()) {
        throw ReadError(
            fmt::format("{} times for {} samples (two or more of each are needed); complete them", times.size(), samples.size()));
    }
    if (!are_finite(times) || !are_finite(samples)) throw ReadError("a time or sample is not finite (damaged); correct it");
    if (const std::optional<std::size_t> found = find_time_out_of_order(times)) {
        throw ReadError(fmt::format("time {} is {} s (not after the one before it); correct it", *found + 1, times[*found]));
    }
}

bool are_even(std::span<const double> times, double dt) {
    for (std::size_t i = 0; i < times.size(); ++i) {
        const double expected = times.front() + static_cast<double>(i) * dt;
        if (!(std::abs(times[i] - expected) <= kTimeJitter * dt)) return false;
    }
    return true;
}

}  // namespace

std::optional<std::size_t> find_time_out_of_order(std::span<const double> times) {
    for (std::size_t i = 1; i < times.size(); ++i)
        if (!(times[i] > times[i - 1])) return i;
    return std::nullopt;
}

ResampledSeries resample_uneven(SampleQuantity quantity, std::span<const double> times, std::span<const double> samples) {
    check_timed_samples(times, samples);
    const scaling::Time start = times.front() * scaling::si::seconds;
    const double span = times.back() - times.front();

    const double mean = detail::to_short_decimal(span / static_cast<double>(times.size() - 1));
    if (are_even(times, mean)) return {{quantity, start, mean * scaling::si::seconds, {samples.begin(), samples.end()}}};

    std::vector<double> steps(times.size());
    std::adjacent_difference(times.begin(), times.end(), steps.begin());
    steps.erase(steps.begin());  // the first time itself
    std::sort(steps.begin(), steps.end());
    const double dt = detail::to_short_decimal(steps[steps.size() / 2]);
    constexpr double kMostPerSample = 4.0;  // met: 1.1; a gap beyond that is a hole in the record, not jitter of its clock
    if (!(span / dt <= kMostPerSample * static_cast<double>(times.size()))) {
        throw ReadError(fmt::format("times are too uneven to resample (steps of {:.3g} to {:.3g} s); cut the record at its gaps",
                                    steps.front(), steps.back()));
    }

    // a time within rounding dust of the last one still counts as reached
    constexpr double kDust = 1e-6;  // of a step
    const std::size_t count = static_cast<std::size_t>(span / dt + kDust) + 1;
    std::vector<double> even;
    even.reserve(count);
    std::size_t left = 0;
    for (std::size_t i = 0; i < count; ++i) {
        const double time = std::min(times.front() + static_cast<double>(i) * dt, times.back());
        while (left + 2 < times.size() && times[left + 1] <= time) ++left;
        const double weight = (time - times[left]) / (times[left + 1] - times[left]);
        even.push_back((1.0 - weight) * samples[left] + weight * samples[left + 1]);
    }
    return {{quantity, start, dt * scaling::si::seconds, std::move(even)},
            fmt::format("resampled from {} uneven samples ({:.3g} to {:.3g} s) to {:.6g} s by straight lines", samples.size(),
                        steps.front(), steps.back(), dt)};
}

}  // namespace musim::records
