#include "records/time_series.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace musim::records {

TimeSeries::TimeSeries(SampleQuantity quantity, scaling::Time start, scaling::Time dt, std::vector<double> samples)
    : quantity_(quantity), start_(start), dt_(dt), samples_(std::move(samples)) {
    if (!(dt.value() > 0.0) || !std::isfinite(dt.value())) {
        throw ProcessingError(fmt::format("time step is {} s (must be positive and finite); correct dt", dt.value()));
    }
    if (!std::isfinite(start.value())) throw ProcessingError("start time is not finite; correct it");
    if (samples_.empty()) throw ProcessingError("series has no samples (at least one is needed); check the window or the file");
    for (std::size_t i = 0; i < samples_.size(); ++i) {
        if (!std::isfinite(samples_[i])) {
            throw ProcessingError(fmt::format("sample {} of {} is {} (must be finite); check the values and their unit", i + 1,
                                              samples_.size(), samples_[i]));
        }
    }
}

double find_largest(std::span<const double> samples) {
    double largest = 0.0;
    for (const double sample : samples) largest = std::max(largest, std::abs(sample));
    return largest;
}

double find_mean(std::span<const double> samples) {
    return std::accumulate(samples.begin(), samples.end(), 0.0) / static_cast<double>(samples.size());
}

void require_quantity(const TimeSeries& series, SampleQuantity wanted, std::string_view step) {
    if (series.quantity() == wanted) return;
    throw ProcessingError(fmt::format("{} needs {} (the series holds {}); convert it or name the right quantity", step, to_string(wanted),
                                      to_string(series.quantity())));
}

void require_acceleration(const TimeSeries& series, std::string_view step) {
    require_quantity(series, find_quantity(is_rotation(series.quantity()), 2), step);
}

}  // namespace musim::records
