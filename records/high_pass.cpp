#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "records/detail/biquad.hpp"
#include "records/processing.hpp"

namespace musim::records {
namespace {

using std::numbers::pi;

// Butterworth sections s²/(s² + 2 sin θ_k K s + K²), θ_k = (2k+1)π/(2n), and s/(s + K) for the odd one; K = tan(π f_c dt)
std::vector<detail::Biquad> design_sections(double corner_steps, int order) {
    const double k = std::tan(pi * corner_steps);
    std::vector<detail::Biquad> sections;
    for (int pair = 0; pair < order / 2; ++pair) {
        const double damping = 2.0 * std::sin(pi * (2 * pair + 1) / (2 * order));
        sections.push_back(detail::bilinear(0.0, 0.0, 1.0, k * k, damping * k, 1.0));
    }
    if (order % 2 == 1) {
        const double scale = 1.0 / (1.0 + k);
        sections.push_back({.b0 = scale, .b1 = -scale, .a1 = (k - 1.0) * scale});
    }
    return sections;
}

// steps after which the slowest pole, K sin(π/(2n)), has decayed to 1e-6
std::size_t memory_in_steps(double corner_steps, int order) {
    const double decay = 2.0 * pi * corner_steps * std::sin(pi / (2 * order));
    return static_cast<std::size_t>(std::ceil(std::log(1e6) / decay));
}

void run_once(const std::vector<detail::Biquad>& sections, std::vector<double>& samples) {
    for (const detail::Biquad& section : sections) detail::apply_biquad(section, samples);
}

}  // namespace

TimeSeries high_pass(const TimeSeries& series, scaling::Frequency corner, int order) {
    constexpr int kHighestOrder = 8;
    if (order < 1 || order > kHighestOrder) {
        throw ProcessingError(fmt::format("high-pass order is {} (must be 1 to {}); choose one of these", order, kHighestOrder));
    }
    const double corner_steps = corner.value() * series.dt().value();
    if (!(corner_steps > 0.0 && corner_steps < 0.5)) {
        throw ProcessingError(
            fmt::format("high-pass corner is {:.6g} Hz (must be between 0 and the Nyquist frequency {:.6g} Hz); change it", corner.value(),
                        0.5 / series.dt().value()));
    }
    const std::vector<detail::Biquad> sections = design_sections(corner_steps, order);
    constexpr std::size_t kLongestMemory = 100'000'000;  // steps, a gigabyte: surely a slip in the corner
    const std::size_t pad = memory_in_steps(corner_steps, order);
    if (pad > kLongestMemory) {
        throw ProcessingError(fmt::format("high-pass corner is {:.6g} Hz (filter would remember {} steps); raise it", corner.value(), pad));
    }

    // zeros before and after, for as long as the filter remembers: what rings beyond the ends comes back in the second pass
    const std::span<const double> x = series.samples();
    std::vector<double> samples(x.size() + 2 * pad, 0.0);
    std::copy(x.begin(), x.end(), samples.begin() + static_cast<std::ptrdiff_t>(pad));

    // forward, backward, and back to the record's own stretch
    run_once(sections, samples);
    std::reverse(samples.begin(), samples.end());
    run_once(sections, samples);
    std::reverse(samples.begin(), samples.end());
    const auto begin = samples.begin() + static_cast<std::ptrdiff_t>(pad);
    return series.with_samples({begin, begin + static_cast<std::ptrdiff_t>(x.size())});
}

}  // namespace musim::records
