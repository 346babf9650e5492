#include "records/processing/energy.hpp"

#include <algorithm>

#include "records/processing/rest_correction.hpp"

namespace musim::records::detail {

std::vector<double> cumulative_square(const TimeSeries& series) {
    std::vector<double> square(series.samples().begin(), series.samples().end());
    for (double& value : square) value *= value;
    return cumulative_trapezoid(square, series.dt().value());
}

scaling::Time time_of_share(const TimeSeries& series, const std::vector<double>& cumulative, double share) {
    const double wanted = share * cumulative.back();
    const auto reached = std::lower_bound(cumulative.begin(), cumulative.end(), wanted);
    const auto i = static_cast<std::size_t>(reached - cumulative.begin());
    if (i == 0) return series.start();
    const double part = (wanted - cumulative[i - 1]) / (cumulative[i] - cumulative[i - 1]);
    return series.start() + (static_cast<double>(i - 1) + part) * series.dt();
}

}  // namespace musim::records::detail
