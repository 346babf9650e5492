#include "records/measures/motion_histories.hpp"

#include "records/measures/intensity.hpp"
#include "records/processing/energy.hpp"
#include "records/processing/processing.hpp"

namespace musim::records {

MotionHistories compute_histories(const TimeSeries& series, std::optional<scaling::Frequency> integration_corner) {
    switch (series.quantity()) {
        case SampleQuantity::acceleration: {
            const TimeSeries velocity =
                integrate(integration_corner ? high_pass(remove_baseline(series, 0), *integration_corner, 2) : series);
            // a high-passed motion has no mean velocity; what is left of the ends of the record would become a drift
            const TimeSeries displacement = integrate(integration_corner ? remove_baseline(velocity, 0) : velocity);
            return {level_uncorrected(series, integration_corner), velocity, displacement};
        }
        case SampleQuantity::velocity:
            return {std::nullopt, series, integrate(series)};
        default:
            return {std::nullopt, std::nullopt, series};
    }
}

std::vector<double> compute_arias_share(const TimeSeries& acceleration) {
    require_quantity(acceleration, SampleQuantity::acceleration, "Arias build-up");
    std::vector<double> share = detail::cumulative_square(acceleration);
    const double whole = share.back();
    if (!(whole > 0.0)) return std::vector<double>(share.size(), 0.0);
    for (double& value : share) value /= whole;
    return share;
}

}  // namespace musim::records
