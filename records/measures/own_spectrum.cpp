#include "records/measures/own_spectrum.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "records/error.hpp"
#include "records/processing/processing.hpp"

namespace musim::records {
namespace {

/// Samples in the shortest period, and how many periods there are.
constexpr double kShortest = 4.0;
constexpr std::size_t kPeriods = 200;

scaling::Time find_longest_period(const TimeSeries& acceleration, const std::optional<scaling::Frequency>& corner) {
    if (!corner) return acceleration.duration();
    if (!(corner->value() > 0.0)) {
        throw ProcessingError(fmt::format("the integration corner is {} Hz (must be above 0); change it", corner->value()));
    }
    return std::min(0.25 * acceleration.duration(), scaling::Time(1.0 / *corner));
}

}  // namespace

ResponseSpectrum compute_own_spectrum(const TimeSeries& acceleration, std::optional<scaling::Frequency> integration_corner,
                                      double damping) {
    const scaling::Time first = kShortest * acceleration.dt(), last = find_longest_period(acceleration, integration_corner);
    const std::vector<scaling::Time> periods = first < last ? make_periods(first, last, kPeriods) : std::vector<scaling::Time>();
    if (integration_corner) return compute_response_spectrum(acceleration, periods, damping);
    return compute_response_spectrum(pad(acceleration, {}, acceleration.duration()), periods, damping);
}

}  // namespace musim::records
