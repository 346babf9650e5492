#include "records/processing/resample.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace musim::records {
namespace {

/// Zeros of the sine to each side, and the Kaiser window's β: 100 dB, over a transition of a tenth of half the rate.
constexpr double kZeros = 64.0;
constexpr double kBeta = 10.0;

/// Corner over half the new rate when the step grows: half the transition below it.
constexpr double kCorner = 0.95;

/// sin(πy)/(πy) under the Kaiser window that ends at y = kZeros, from a table: cubics through four entries are within 1e-10 of it.
class Kernel {
  public:
    Kernel() {
        const double scale = 1.0 / std::cyl_bessel_i(0.0, kBeta);
        for (std::size_t i = 0; i < table_.size(); ++i) {
            const double y = (static_cast<double>(i) - 1.0) / kPerZero, part = y / kZeros, inside = (1.0 - part) * (1.0 + part);
            if (inside <= 0.0) continue;  // zero
            const double sinc = y == 0.0 ? 1.0 : std::sin(std::numbers::pi * y) / (std::numbers::pi * y);
            table_[i] = sinc * scale * std::cyl_bessel_i(0.0, kBeta * std::sqrt(inside));
        }
    }

    /// For y from 0 to kZeros.
    double operator()(double y) const {
        const double place = y * kPerZero, floor = std::floor(place), t = place - floor;
        const double* const entry = &table_[static_cast<std::size_t>(floor)];
        const double a = entry[0], b = entry[1], c = entry[2], d = entry[3];
        const double third = (d - a + 3.0 * (b - c)) / 6.0, second = (a - 2.0 * b + c) / 2.0;
        return b + t * ((c - a) / 2.0 - third + t * (second + t * third));
    }

  private:
    static constexpr double kPerZero = 512.0;
    /// Entry i is for y = (i − 1)/kPerZero; two more than reach the end, for the cubic.
    std::vector<double> table_ = std::vector<double>(static_cast<std::size_t>(kZeros * kPerZero) + 4);
};

const Kernel& kernel() {
    static const Kernel kKernel;
    return kKernel;
}

/// Values of a record between its samples, band-limited.
class BandLimited {
  public:
    /// `corner`: f_c over half the record's own rate, at most one.
    BandLimited(std::span<const double> samples, double corner)
        : samples_(samples), corner_(corner), reach_(kZeros / corner), kernel_(kernel()) {}

    /// At `place`, in steps from the first sample.
    double operator()(double place) const {
        const double last = static_cast<double>(samples_.size() - 1);
        const double first = std::clamp(std::ceil(place - reach_), 0.0, last), end = std::clamp(std::floor(place + reach_), 0.0, last);
        double sum = 0.0;
        for (double i = first; i <= end; i += 1.0) {
            sum += samples_[static_cast<std::size_t>(i)] * kernel_(std::min(corner_ * std::abs(place - i), kZeros));
        }
        return corner_ * sum;
    }

  private:
    std::span<const double> samples_;
    double corner_, reach_;
    const Kernel& kernel_;
};

double between_straight(std::span<const double> samples, double place) {
    const auto i = std::min(static_cast<std::size_t>(std::max(0.0, place)), samples.size() - 1);
    const double part = place - static_cast<double>(i);
    return i + 1 < samples.size() ? samples[i] + part * (samples[i + 1] - samples[i]) : samples[i];
}

/// Samples at first + k·ratio, in steps of the record.
std::vector<double> sample_at(std::span<const double> samples, double first, double ratio, std::size_t count, Between between) {
    std::vector<double> values;
    values.reserve(count);
    const BandLimited band(samples, ratio > 1.0 ? kCorner / ratio : 1.0);
    for (std::size_t k = 0; k < count; ++k) {
        const double place = first + static_cast<double>(k) * ratio;
        // a place on a sample, but for rounding, is that sample
        const double nearest = std::round(place);
        const bool on_sample = ratio <= 1.0 && std::abs(place - nearest) <= 1e-9;
        if (on_sample) {
            values.push_back(samples[static_cast<std::size_t>(nearest)]);
        } else {
            values.push_back(between == Between::straight ? between_straight(samples, place) : band(place));
        }
    }
    return values;
}

}  // namespace

TimeSeries resample(const TimeSeries& series, scaling::Time dt, Between between) {
    const double ratio = dt.value() / series.dt().value();
    constexpr double kMostSamples = 1e8;
    const double steps = static_cast<double>(series.size() - 1) / ratio;
    if (!(ratio > 0.0 && std::isfinite(ratio) && steps < kMostSamples)) {
        throw ProcessingError(fmt::format("new step is {:.6g} s (must be positive, and leave at most 1e8 samples); change it", dt.value()));
    }
    // the last step counts when it is whole but for rounding
    const auto count = static_cast<std::size_t>(std::floor(steps * (1.0 + 1e-12) + 1e-9)) + 1;
    if (count < 2 && series.size() > 1) {
        throw ProcessingError(fmt::format("new step is {:.6g} s (longer than the record of {:.6g} s); give a shorter one", dt.value(),
                                          series.duration().value()));
    }
    return {series.quantity(), series.start(), dt, sample_at(series.samples(), 0.0, ratio, count, between)};
}

TimeSeries shift_clock(const TimeSeries& series, scaling::Time later, Between between) {
    const double part = later.value() / series.dt().value();
    if (!(std::abs(part) < 1.0 && series.size() > 1)) {
        throw ProcessingError(
            fmt::format("a clock cannot be shifted by {} of its step (less than one, of two samples or more); change it", part));
    }
    const double first = part < 0.0 ? 1.0 + part : part;
    const std::size_t count = part == 0.0 ? series.size() : series.size() - 1;
    return {series.quantity(), series.start() + first * series.dt(), series.dt(), sample_at(series.samples(), first, 1.0, count, between)};
}

}  // namespace musim::records
