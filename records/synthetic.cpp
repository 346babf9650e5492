#include "records/synthetic.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "records/detail/biquad.hpp"
#include "records/detail/rest_correction.hpp"

namespace musim::records {
namespace {

// frequencies are multiples of PGA/PGV [rad/s], 11.8 rad/s for the default peaks
constexpr double kLowestFrequency = 1.0 / 16.0;  ///< high-pass; 0.12 Hz by default, below it lies drift
constexpr double kHighestFrequency = 16.0;       ///< low-pass; 30 Hz by default
constexpr double kGroundDamping = 0.6;           ///< of the ground filter, Kanai's value for firm ground
constexpr double kFilterDamping = 0.7;           ///< of both others: no peak of their own

// search range of the ground frequency, in the same unit: outside, the other filters set PGV/PGA
constexpr double kSoftestGround = 1.0 / 16.0;
constexpr double kStiffestGround = 16.0;

// envelope: full strength from 1/8 to 3/8 of the duration
constexpr double kRiseEnd = 0.125;
constexpr double kFallStart = 0.375;

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

double envelope(double tau) {
    if (tau < kRiseEnd) return tau / kRiseEnd * (tau / kRiseEnd);
    if (tau < kFallStart) return 1.0;
    const double fall = (1.0 - tau) / (1.0 - kFallStart);
    return fall * fall;
}

// acceleration of unit time step from the ground frequency [rad/step], at rest at the end
std::vector<double> shape_noise(std::vector<double> samples, double ground, double lowest, double highest) {
    // bilinear transform of s = 2/dt (…): frequencies in units of 2/step
    const auto section = [](double n0, double n1, double n2, double frequency, double damping) {
        const double w = 0.5 * frequency;
        return detail::bilinear(n0 * w * w, n1 * w, n2, w * w, 2.0 * damping * w, 1.0);
    };
    detail::apply_biquad(section(1.0, 2.0 * kGroundDamping, 0.0, ground, kGroundDamping), samples);
    detail::apply_biquad(section(1.0, 0.0, 0.0, highest, kFilterDamping), samples);
    const double steps = static_cast<double>(samples.size() - 1);
    for (std::size_t i = 0; i < samples.size(); ++i) samples[i] *= envelope(static_cast<double>(i) / steps);
    detail::apply_biquad(section(0.0, 0.0, 1.0, lowest, kFilterDamping), samples);

    const std::vector<double> velocity = detail::cumulative_trapezoid(samples, 1.0);
    const double drift = detail::cumulative_trapezoid(velocity, 1.0).back();
    const std::vector<double> correction = detail::rest_correction(samples.size(), 1.0, velocity.back(), drift);
    for (std::size_t i = 0; i < samples.size(); ++i) samples[i] -= correction[i];
    return samples;
}

double largest_magnitude(const std::vector<double>& samples) {
    double largest = 0.0;
    for (const double sample : samples) largest = std::max(largest, std::abs(sample));
    return largest;
}

void require_positive(std::string_view name, double value) {
    if (value > 0.0 && std::isfinite(value)) return;
    throw ProcessingError(fmt::format("synthetic record: {} is {} (must be positive and finite); correct it", name, value));
}

}  // namespace

GroundMotion make_synthetic_record(const SyntheticSettings& settings) {
    const double pga = settings.pga.value();
    const double pgv = settings.pgv.value();
    const double dt = settings.dt.value();
    require_positive("PGA", pga);
    require_positive("PGV", pgv);
    require_positive("time step", dt);
    require_positive("duration", settings.duration.value());
    const double steps = std::round(settings.duration.value() / dt);
    constexpr double kFewestSteps = 64.0;
    constexpr double kMostSteps = 1e8;  // a gigabyte: surely a slip in dt or duration
    if (!(steps >= kFewestSteps && steps <= kMostSteps)) {
        throw ProcessingError(
            fmt::format("synthetic record: {} steps (must be {} to {}); change dt or duration", steps, kFewestSteps, kMostSteps));
    }

    // everything below is in steps; `unit` is PGA/PGV in rad/step
    const std::vector<double> noise = make_noise(static_cast<std::size_t>(steps) + 1, settings.seed);
    const double unit = pga / pgv * dt;
    const auto make = [&](double ground) { return shape_noise(noise, ground * unit, kLowestFrequency * unit, kHighestFrequency * unit); };
    // PGV/PGA over the wanted one: above 1 the ground is too soft
    const auto excess = [&](const std::vector<double>& acceleration) {
        return largest_magnitude(detail::cumulative_trapezoid(acceleration, 1.0)) / largest_magnitude(acceleration) * unit;
    };

    // bisection for the ground frequency until neighboring doubles enclose it
    double soft = kSoftestGround;
    double stiff = kStiffestGround;
    if (!(excess(make(soft)) > 1.0 && excess(make(stiff)) < 1.0)) {
        throw ProcessingError(
            fmt::format("synthetic record: PGV/PGA = {:.6g} s cannot be met with dt {:.6g} s and duration {:.6g} s; lengthen the "
                        "record or refine dt",
                        pgv / pga, dt, settings.duration.value()));
    }
    for (double middle = 0.5 * (soft + stiff); soft < middle && middle < stiff; middle = 0.5 * (soft + stiff)) {
        (excess(make(middle)) > 1.0 ? soft : stiff) = middle;
    }

    std::vector<double> samples = make(stiff);
    const double largest = largest_magnitude(samples);
    for (double& sample : samples) sample = sample / largest * pga;

    GroundMotion motion{.format = "synthetic"};
    motion.event = fmt::format("synthetic, seed {}", settings.seed);
    motion.components.push_back(
        {.name = "1", .azimuth_deg = std::nullopt, .series = {SampleQuantity::acceleration, {}, settings.dt, std::move(samples)}});
    motion.history.push_back(
        fmt::format("made: filtered noise, ground frequency {:.6g} rad/s, PGA {:.9g} m/s^2, PGV {:.9g} m/s", stiff * pga / pgv, pga, pgv));
    return motion;
}

}  // namespace musim::records
