#include "records/processing/uncorrected.hpp"

#include "records/processing/processing.hpp"

namespace musim::records {

TimeSeries level_uncorrected(const TimeSeries& series, std::optional<scaling::Frequency> integration_corner) {
    return integration_corner ? remove_initial_level(series) : series;
}

TimeSeries integrate_record(const TimeSeries& acceleration, std::optional<scaling::Frequency> integration_corner) {
    return integrate(integration_corner ? high_pass(remove_baseline(acceleration, 0), *integration_corner, 2) : acceleration);
}

}  // namespace musim::records
