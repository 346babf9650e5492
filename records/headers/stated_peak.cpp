#include "records/headers/stated_peak.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numeric>

#include "records/detail/text.hpp"

namespace musim::records::detail {
namespace {

// what one unit of the last digit of "-41.60" is worth: 0.01
double last_digit_of(std::string_view number) {
    const std::size_t point = number.find('.');
    const std::size_t decimals = point == std::string_view::npos ? 0 : number.size() - point - 1;
    return std::pow(10.0, -static_cast<double>(decimals));
}

}  // namespace

double signed_peak(std::span<const double> samples, double level) {
    double peak = 0.0;
    for (const double sample : samples) {
        if (std::abs(sample - level) > std::abs(peak)) peak = sample - level;
    }
    return peak;
}

double mean_of(std::span<const double> samples) {
    return std::accumulate(samples.begin(), samples.end(), 0.0) / static_cast<double>(samples.size());
}

void check_stated_peak(const TextFile& file, std::size_t index, std::string_view name, std::string_view printed, double measured) {
    const std::optional<double> stated = parse_real(printed);
    if (!stated) file.fail(index, fmt::format("{} is {} (no number)", name, quoted(printed)), "correct the header");

    // rounded or cut to the printed digits; the rest is rounding of the unit
    const double tolerance = last_digit_of(printed) + 1e-9 * std::abs(*stated);
    if (!(std::abs(measured - *stated) <= tolerance)) {
        file.fail(index, fmt::format("{} is {} (the samples peak at {:.6g}; header or data are damaged)", name, quoted(printed), measured),
                  "fetch the record again");
    }
}

}  // namespace musim::records::detail
