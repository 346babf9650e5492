#include "records/compare.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace musim::records {
namespace {

// 0/0 is agreement: nothing moved and nothing should have
double ratio(double difference, double reference) {
    if (!std::isfinite(difference) || !std::isfinite(reference)) return std::numeric_limits<double>::infinity();
    return difference == 0.0 ? 0.0 : difference / reference;
}

}  // namespace

Misfit compute_misfit(std::span<const double> reference, std::span<const double> other) {
    if (reference.size() != other.size() || reference.empty()) {
        throw ProcessingError(fmt::format("histories of {} and {} samples cannot be compared (same length needed, not empty); resample one",
                                          reference.size(), other.size()));
    }
    double largest = 0.0;
    double largest_difference = 0.0;
    for (std::size_t i = 0; i < reference.size(); ++i) {
        const double difference = other[i] - reference[i];
        if (!std::isfinite(difference)) return {std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
        largest = std::max(largest, std::abs(reference[i]));
        largest_difference = std::max(largest_difference, std::abs(difference));
    }

    // squares of values over the largest: no underflow for tiny histories
    const double unit = largest > 0.0 ? largest : 1.0;
    double square = 0.0;
    double square_difference = 0.0;
    for (std::size_t i = 0; i < reference.size(); ++i) {
        const double value = reference[i] / unit;
        const double difference = (other[i] - reference[i]) / unit;
        square += value * value;
        square_difference += difference * difference;
    }
    return {ratio(largest_difference, largest), ratio(std::sqrt(square_difference), std::sqrt(square))};
}

Misfit compute_misfit(const TimeSeries& reference, const TimeSeries& other) {
    require_quantity(other, reference.quantity(), "the comparison");
    constexpr double kSameStep = 1e-9;  // relative; model times carry the rounding of one multiplication and one division
    const double dt = reference.dt().value();
    if (std::abs(other.dt().value() - dt) > kSameStep * dt) {
        throw ProcessingError(fmt::format("time steps {} s and {} s differ; resample one history", dt, other.dt().value()));
    }
    return compute_misfit(reference.samples(), other.samples());
}

}  // namespace musim::records
