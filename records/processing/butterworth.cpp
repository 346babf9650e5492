#include "records/processing/butterworth.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "records/processing/biquad.hpp"
#include "records/processing/processing.hpp"

namespace musim::records {
namespace {

using std::numbers::pi;

enum class Passes { high, low };

/// Sections s²/(s² + 2 sin θ_k K s + K²), θ_k = (2k+1)π/(2n), and s/(s + K) for the odd one, K = tan(π f_c dt); of a low-pass K² and K
/// above.
void add_sections(Passes passes, double corner_steps, int order, std::vector<detail::Biquad>& sections) {
    const double k = std::tan(pi * corner_steps);
    const bool low = passes == Passes::low;
    for (int pair = 0; pair < order / 2; ++pair) {
        const double damping = 2.0 * std::sin(pi * (2 * pair + 1) / (2 * order));
        sections.push_back(detail::bilinear(low ? k * k : 0.0, 0.0, low ? 0.0 : 1.0, k * k, damping * k, 1.0));
    }
    if (order % 2 == 0) return;
    const double scale = 1.0 / (1.0 + k);
    sections.push_back({.b0 = low ? k * scale : scale, .b1 = low ? k * scale : -scale, .a1 = (k - 1.0) * scale});
}

/// Steps after which the slowest pole, K sin(π/(2n)), has decayed to 1e-6.
std::size_t memory_in_steps(double corner_steps, int order) {
    const double decay = 2.0 * pi * corner_steps * std::sin(pi / (2 * order));
    return static_cast<std::size_t>(std::ceil(std::log(1e6) / decay));
}

void run_once(const std::vector<detail::Biquad>& sections, std::vector<double>& samples) {
    for (const detail::Biquad& section : sections) detail::apply_biquad(section, samples);
}

/// A corner in cycles a step.
double check_corner(const TimeSeries& series, scaling::Frequency corner, std::string_view filter) {
    const double corner_steps = corner.value() * series.dt().value();
    if (!(corner_steps > 0.0 && corner_steps < 0.5)) {
        throw ProcessingError(fmt::format("{} corner is {:.6g} Hz (must be between 0 and the Nyquist frequency {:.6g} Hz); change it",
                                          filter, corner.value(), 0.5 / series.dt().value()));
    }
    return corner_steps;
}

std::string_view name_of(const FilterBand& band) { return band.low && band.high ? "band-pass" : band.low ? "high-pass" : "low-pass"; }

}  // namespace

TimeSeries apply_butterworth(const TimeSeries& series, const FilterBand& band, int order, FilterPhase phase) {
    if (!band.low && !band.high) throw ProcessingError("a filter has no corner (it would change nothing); give a low or a high corner");
    if (order < 1 || order > kHighestFilterOrder)
        throw ProcessingError(
            fmt::format("{} order is {} (must be 1 to {}); choose one of these", name_of(band), order, kHighestFilterOrder));
    if (band.low && band.high && !(*band.low < *band.high)) {
        throw ProcessingError(fmt::format("band-pass lies between {:.6g} and {:.6g} Hz (the first must be below the second); exchange them",
                                          band.low->value(), band.high->value()));
    }
    std::vector<detail::Biquad> sections;
    std::size_t pad = 0;
    const auto add = [&](Passes passes, const std::optional<scaling::Frequency>& corner, std::string_view filter) {
        if (!corner) return;
        const double corner_steps = check_corner(series, *corner, filter);
        add_sections(passes, corner_steps, order, sections);
        constexpr std::size_t kLongestMemory = 100'000'000;  // steps, a gigabyte: surely a slip in the corner
        const std::size_t memory = memory_in_steps(corner_steps, order);
        if (memory > kLongestMemory) {
            throw ProcessingError(
                fmt::format("{} corner is {:.6g} Hz (filter would remember {} steps); raise it", filter, corner->value(), memory));
        }
        pad = std::max(pad, memory);
    };
    add(Passes::high, band.low, "high-pass");
    add(Passes::low, band.high, "low-pass");

    // zeros before and after, for as long as the filter remembers: what rings beyond the ends comes back in the second pass
    const std::span<const double> x = series.samples();
    if (phase == FilterPhase::causal) {
        std::vector<double> samples(x.begin(), x.end());
        run_once(sections, samples);
        return series.with_samples(std::move(samples));
    }
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

std::vector<detail::Biquad> make_low_pass(double corner_steps, int order) {
    std::vector<detail::Biquad> sections;
    add_sections(Passes::low, corner_steps, order, sections);
    return sections;
}

double find_low_pass_delay(double corner_steps, int order) { return 0.5 / (std::tan(pi * corner_steps) * std::sin(pi / (2 * order))); }

TimeSeries high_pass(const TimeSeries& series, scaling::Frequency corner, int order) {
    return apply_butterworth(series, {.low = corner}, order, FilterPhase::zero);
}

}  // namespace musim::records
