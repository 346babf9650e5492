#include "records/headers/header_checks.hpp"

#include <fmt/format.h>

#include <cmath>

#include "records/detail/text.hpp"

namespace musim::records::detail {

namespace {

// what one unit of the last digit is worth: 0.01 of "-41.60", 10 of "1.20E3"
double last_digit_of(std::string_view number) {
    const std::size_t letter = number.find_first_of("eEdD");
    const std::string_view mantissa = number.substr(0, letter);
    const double exponent = letter == std::string_view::npos ? 0.0 : parse_real(number.substr(letter + 1)).value_or(0.0);
    const std::size_t point = mantissa.find('.');
    const std::size_t decimals = point == std::string_view::npos ? 0 : mantissa.size() - point - 1;
    return std::pow(10.0, exponent - static_cast<double>(decimals));
}

}  // namespace

double half_last_digit(std::string_view number) { return 0.5 * last_digit_of(trim(number)); }

void check_record_length(const TextFile& file, std::size_t index, std::size_t count, scaling::Time dt, double length,
                         std::size_t stated_on) {
    if (length <= 0.0) return;
    const double step = dt.value();
    if (std::abs(static_cast<double>(count) * step - length) > 0.01 * length + 2.0 * step) {
        file.fail(index, fmt::format("{} points of {} s do not make the {} s of line {}", count, step, length, stated_on + 1),
                  "correct the time step or the number of points");
    }
}

void check_peak(const TextFile& file, std::size_t index, std::span<const double> samples, const StatedPeak& stated) {
    const double peak = std::abs(signed_peak(samples)) / stated.si;
    if (std::abs(peak - std::abs(stated.value)) > stated.tolerance) {
        file.fail(index,
                  fmt::format("peak is {} {} (largest sample: {:.6g}; samples or header are damaged)", stated.value, stated.unit, peak),
                  "fetch the record again");
    }
}

void check_azimuth(const TextFile& file, std::size_t index, double stored, const Direction& direction, std::size_t titled_on) {
    if (!direction.azimuth_deg || stored == 0.0 || stored == -999.0) return;
    if (std::fmod(stored, 360.0) != std::fmod(*direction.azimuth_deg, 360.0) || stored > 360.0) {
        file.fail(index, fmt::format("azimuth is {} (line {} says {} Deg; header is damaged)", stored, titled_on + 1, direction.name),
                  "fetch the record again or correct the header");
    }
}

std::size_t find_peak(std::span<const double> samples, double level) {
    std::size_t peak = 0;
    for (std::size_t i = 1; i < samples.size(); ++i) {
        if (std::abs(samples[i] - level) > std::abs(samples[peak] - level)) peak = i;
    }
    return peak;
}

double signed_peak(std::span<const double> samples, double level) {
    return samples.empty() ? 0.0 : samples[find_peak(samples, level)] - level;
}

void check_stated_peak(const TextFile& file, std::size_t index, std::string_view name, std::string_view printed,
                       const MeasuredPeak& measured) {
    const std::optional<double> stated = parse_real(printed);
    if (!stated) file.fail(index, fmt::format("{} is {} (no number)", name, quoted(printed)), "correct the header");

    // rounded or cut to the printed digits, as the samples are to theirs; the rest is rounding of the unit
    const double tolerance = last_digit_of(printed) + measured.rounding + 1e-9 * std::abs(*stated);
    if (!(std::abs(measured.value - *stated) <= tolerance)) {
        file.fail(index,
                  fmt::format("{} is {} (the samples peak at {:.6g}; header or data are damaged)", name, quoted(printed), measured.value),
                  "fetch the record again");
    }
}

}  // namespace musim::records::detail
