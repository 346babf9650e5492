#include "records/synthesis/synthetic.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <random>

#include "records/formats/detail/made_record.hpp"
#include "records/measures/intensity.hpp"
#include "records/processing/biquad.hpp"
#include "records/processing/cumulative.hpp"

namespace musim::records {
namespace {

constexpr const char* kSyntheticRecord = "synthetic record";

// frequencies are multiples of PGA/PGV [rad/s], 11.8 rad/s for the default peaks
constexpr double kLowestFrequency = 1.0 / 16.0;  ///< high-pass; 0.12 Hz by default, below it lies drift
constexpr double kHighestFrequency = 16.0;       ///< low-pass; 30 Hz by default
constexpr double kGroundDamping = 0.6;           ///< of the ground filter, Kanai's value for firm ground
constexpr double kFilterDamping = 0.7;           ///< of both others: no peak of their own

// search range of the ground frequency, in the same unit: outside, the other filters set PGV/PGA
constexpr double kSoftestGround = 1.0 / 16.0;
constexpr double kStiffestGround = 16.0;

/// Envelope in time, in shares of the duration: quadratic rise, full strength, quadratic fall.
struct Envelope {
    double rise_end = 0.125, fall_start = 0.375, end = 1.0;

    double operator()(double tau) const {
        if (tau < rise_end) return tau / rise_end * (tau / rise_end);
        if (tau < fall_start) return 1.0;
        if (tau >= end) return 0.0;
        const double fall = (end - tau) / (end - fall_start);
        return fall * fall;
    }
};

/// One family from short to long strong motion: up to width 1 the default envelope over that share of the record, then with its full
/// strength longer, at width 2 up to 7/8 of the record.
Envelope make_envelope(double width) {
    constexpr Envelope kDefault;
    if (width <= 1.0) return {kDefault.rise_end * width, kDefault.fall_start * width, width};
    return {kDefault.rise_end, kDefault.fall_start + 0.5 * (width - 1.0), 1.0};
}
constexpr double kWidest = 2.0;

/// The search for a width ends where two are this near [fraction]: D5-95 jumps between them.
constexpr double kSameWidth = 1e-6;

// sum of twelve uniform numbers: mean 0, variance 1, normal within ±3, and nothing but sums
std::vector<double> make_noise(std::size_t size, std::uint64_t seed) {
    std::mt19937_64 generator(seed);
    constexpr double kUnit = 0x1p-53;
    std::vector<double> noise(size);
    for (double& value : noise) {
        value = -6.0;
        for (int i = 0; i < 12; ++i) value += static_cast<double>(generator() >> 11U) * kUnit;
    }
    return noise;
}

// acceleration of unit time step from the ground frequency, in `unit` = PGA/PGV [rad/step], at rest at the end
std::vector<double> shape_noise(std::vector<double> samples, double ground, double unit, const Envelope& envelope) {
    // bilinear transform of s = 2/dt (…): frequencies in units of 2/step
    const auto section = [](double n0, double n1, double n2, double frequency, double damping) {
        const double w = 0.5 * frequency;
        return detail::bilinear(n0 * w * w, n1 * w, n2, w * w, 2.0 * damping * w, 1.0);
    };
    detail::apply_biquad(section(1.0, 2.0 * kGroundDamping, 0.0, ground * unit, kGroundDamping), samples);
    detail::apply_biquad(section(1.0, 0.0, 0.0, kHighestFrequency * unit, kFilterDamping), samples);
    const double steps = static_cast<double>(samples.size() - 1);
    for (std::size_t i = 0; i < samples.size(); ++i) samples[i] *= envelope(static_cast<double>(i) / steps);
    detail::apply_biquad(section(0.0, 0.0, 1.0, kLowestFrequency * unit, kFilterDamping), samples);
    return detail::end_at_rest(std::move(samples), 1.0);
}

/// A record that has both peaks.
struct Found {
    double ground = 0.0;  ///< frequency of the ground filter, in PGA/PGV
    TimeSeries acceleration;
};

/// Bisection for the ground frequency until neighboring doubles enclose it; nothing when no ground gives the wanted PGV/PGA. All in steps.
std::optional<Found> find_peaks(const std::vector<double>& noise, const SyntheticSettings& settings, const Envelope& envelope) {
    const double pga = settings.pga.value();
    const double unit = pga / settings.pgv.value() * settings.dt.value();
    const auto make = [&](double ground) { return shape_noise(noise, ground, unit, envelope); };
    // PGV/PGA over the wanted one: above 1 the ground is too soft
    const auto excess = [&](const std::vector<double>& acceleration) {
        return find_largest(detail::cumulative_trapezoid(acceleration, 1.0)) / find_largest(acceleration) * unit;
    };

    double soft = kSoftestGround;
    double stiff = kStiffestGround;
    if (!(excess(make(soft)) > 1.0 && excess(make(stiff)) < 1.0)) return std::nullopt;
    for (double middle = 0.5 * (soft + stiff); soft < middle && middle < stiff; middle = 0.5 * (soft + stiff)) {
        (excess(make(middle)) > 1.0 ? soft : stiff) = middle;
    }

    std::vector<double> samples = make(stiff);
    const double largest = find_largest(samples);
    for (double& sample : samples) sample = sample / largest * pga;
    return Found{stiff, {SampleQuantity::acceleration, {}, settings.dt, std::move(samples)}};
}

/// Both peaks with the default envelope. Throws where they cannot be had.
Found require_peaks(const std::vector<double>& noise, const SyntheticSettings& settings) {
    std::optional<Found> found = find_peaks(noise, settings, {});
    if (found) return *std::move(found);
    throw ProcessingError(
        fmt::format("{}: PGV/PGA = {:.6g} s cannot be met with dt {:.6g} s and duration {:.6g} s; lengthen the record or refine dt",
                    kSyntheticRecord, (settings.pgv / settings.pga).value(), settings.dt.value(), settings.duration.value()));
}

/// Where the search for a width begins: that of the envelope whose square has such a D5-95 [share of the duration].
double guess_width(double share) {
    constexpr double kDefaultShare = 0.447, kWidestShare = 0.72;  // of widths 1 and 2
    if (share <= kDefaultShare) return share / kDefaultShare;
    return std::min(kWidest, 1.0 + (share - kDefaultShare) / (kWidestShare - kDefaultShare));
}

/// Bisection for the envelope's width until D5-95 is met: the wider, the longer the strong motion. Widths at which no ground gives PGV/PGA
/// are taken for too narrow below the first guess, else for too wide.
Found find_peaks_and_duration(const std::vector<double>& noise, const SyntheticSettings& settings, scaling::Time wanted) {
    const double guess = guess_width((wanted / settings.duration).value());
    double narrow = 0.0, wide = kWidest, nearest = 0.0;
    for (double width = guess; wide - narrow > kSameWidth * wide; width = 0.5 * (narrow + wide)) {
        std::optional<Found> found = find_peaks(noise, settings, make_envelope(width));
        bool too_narrow = width < guess;
        if (found) {
            const double ratio = (compute_significant_duration(found->acceleration) / wanted).value();
            if (std::abs(ratio - 1.0) <= kDurationTolerance) return *std::move(found);
            if (std::abs(ratio - 1.0) < std::abs(nearest - 1.0)) nearest = ratio;
            too_narrow = ratio < 1.0;
        }
        (too_narrow ? narrow : wide) = width;
    }
    // too long for the record, too short for PGV/PGA, or at a jump where another ground frequency takes over
    throw ProcessingError(fmt::format(
        "{}: D5-95 of {:.6g} s cannot be met within {:.6g} s of record and PGV/PGA = {:.6g} s (nearest {:.6g} "
        "s); change them or the seed",
        kSyntheticRecord, wanted.value(), settings.duration.value(), (settings.pgv / settings.pga).value(), nearest * wanted.value()));
}

}  // namespace

GroundMotion make_synthetic_record(const SyntheticSettings& settings) {
    const double pga = settings.pga.value();
    const double pgv = settings.pgv.value();
    detail::require_positive(kSyntheticRecord,
                             {{"PGA", pga}, {"PGV", pgv}, {"time step", settings.dt.value()}, {"duration", settings.duration.value()}});
    if (settings.d5_95) detail::require_positive(kSyntheticRecord, {{"D5-95", settings.d5_95->value()}});
    const double steps = std::round((settings.duration / settings.dt).value());
    constexpr double kFewestSteps = 64.0;
    detail::require_steps(kSyntheticRecord, steps, kFewestSteps);

    const std::vector<double> noise = make_noise(static_cast<std::size_t>(steps) + 1, settings.seed);
    const Found found = settings.d5_95 ? find_peaks_and_duration(noise, settings, *settings.d5_95) : require_peaks(noise, settings);
    std::string made =
        fmt::format("filtered noise, ground frequency {:.6g} rad/s, PGA {:.9g} m/s^2, PGV {:.9g} m/s", found.ground * pga / pgv, pga, pgv);
    if (settings.d5_95) made += fmt::format(", D5-95 {:.6g} s", compute_significant_duration(found.acceleration).value());
    return detail::make_record(fmt::format("synthetic, seed {}", settings.seed), std::move(made), settings.dt,
                               {found.acceleration.samples().begin(), found.acceleration.samples().end()});
}

}  // namespace musim::records
