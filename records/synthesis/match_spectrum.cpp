#include "records/synthesis/match_spectrum.hpp"

#include <fmt/format.h>

#include <Eigen/Cholesky>

#include <algorithm>
#include <cmath>

#include "records/measures/intensity.hpp"
#include "records/measures/oscillator.hpp"
#include "records/measures/response_spectrum.hpp"
#include "records/processing/cumulative.hpp"
#include "records/processing/processing.hpp"
#include "records/synthesis/adjustment_wavelet.hpp"
#include "scaling/interruption.hpp"

namespace musim::records {
namespace {

constexpr const char* kSpectrumMatch = "spectrum match";

// damping λ of the least squares, in units of the largest diagonal element: from bold to so cautious that nothing would change any more
constexpr double kFirstCaution = 1e-2;
constexpr double kLeastCaution = 1e-6;
constexpr double kMostCaution = 1e6;
constexpr double kBolder = 0.3, kMoreCautious = 4.0;

/// A step may be worse than the last, but not than the worst of so many: it gets over kinks, where another swing becomes the largest.
constexpr std::size_t kMemory = 5;

/// Swings of an oscillator that reach this fraction of its largest get wavelets of their own, and must not rise above the target.
constexpr double kRival = 0.9;

/// One swing of an oscillator.
struct Swing {
    std::size_t oscillator = 0;
    double time = 0.0;  ///< of its peak [steps]
    double psa = 0.0;   ///< ω²|u| there [m/s²]
    double sign = 1.0;  ///< of u
};

/// The largest responses of one oscillator: swings that take the lead when another falls a little.
struct Response {
    double psa = 0.0;           ///< of the largest [m/s²]
    double peak = 0.0;          ///< its time [steps]
    std::vector<Swing> swings;  ///< it and its rivals
};

Response find_response(const TimeSeries& acceleration, const TargetSpectrum& target, std::size_t oscillator) {
    const double theta = detail::find_theta(target.period[oscillator], acceleration.dt());
    detail::OscillatorWalk walk(acceleration.samples(), theta, target.damping);
    Response response;
    const auto keep = [&](double u, double time) {
        const double psa = theta * theta * std::abs(u);
        if (psa < kRival * response.psa) return;
        response.swings.push_back({oscillator, time, psa, u < 0.0 ? -1.0 : 1.0});
        if (psa <= response.psa) return;
        response.psa = psa;
        response.peak = time;
    };
    // extremes between the samples, and the end of the motion
    const double substeps = static_cast<double>(walk.substeps().count);
    while (walk.next()) {
        const double start = static_cast<double>(walk.step()) + static_cast<double>(walk.substep()) / substeps;
        const detail::Cubic u = walk.displacement();
        for (const double share : u.find_extremes()) {
            if (share > 0.0) keep(u.at(share), start + share / substeps);
        }
    }
    keep(walk.displacement().value1, static_cast<double>(acceleration.size() - 1));
    std::erase_if(response.swings, [&](const Swing& swing) { return swing.psa < kRival * response.psa; });
    return response;
}

std::vector<Response> find_responses(const TimeSeries& acceleration, const TargetSpectrum& target) {
    std::vector<Response> responses;
    for (std::size_t i = 0; i < target.period.size(); ++i) responses.push_back(find_response(acceleration, target, i));
    return responses;
}

double log_ratio(const TargetSpectrum& target, const std::vector<Response>& responses, std::size_t i) {
    return std::log(responses[i].psa / target.psa[i].value());
}

SpectrumMisfit find_misfit(const TargetSpectrum& target, const std::vector<Response>& responses) {
    SpectrumMisfit misfit;
    for (std::size_t i = 0; i < responses.size(); ++i) {
        const double size = std::abs(log_ratio(target, responses, i));
        misfit.mean += size / static_cast<double>(responses.size());
        if (size <= misfit.largest) continue;
        misfit.largest = size;
        misfit.largest_at = target.period[i];
    }
    return misfit;
}

/// Cost that the search makes smaller: the sum of the fourth powers of the logarithms, since the largest counts.
double find_cost(const TargetSpectrum& target, const std::vector<Response>& responses) {
    double cost = 0.0;
    for (std::size_t i = 0; i < responses.size(); ++i) {
        const double square = log_ratio(target, responses, i) * log_ratio(target, responses, i);
        cost += square * square;
    }
    return cost;
}

/// Wavelets at the swings of all oscillators and what they do: a row of A is the change of one swing, over its target, by every wavelet, in
/// units of the target of its own oscillator. Rows are weighted, W.
struct Linearization {
    std::vector<detail::Wavelet> wavelets;
    std::vector<double> unit;  ///< of the wavelets' amplitudes [m/s²]
    Eigen::MatrixXd normal;    ///< AᵀWA
    Eigen::VectorXd right;     ///< AᵀWr, r the wanted changes over the targets
};

Linearization linearize(const TimeSeries& motion, const TargetSpectrum& target, const std::vector<Response>& responses, double tolerance) {
    std::vector<Swing> swings;
    for (const Response& response : responses) swings.insert(swings.end(), response.swings.begin(), response.swings.end());
    const auto n = static_cast<Eigen::Index>(swings.size());
    Linearization linear{{}, {}, Eigen::MatrixXd::Zero(n, n), Eigen::VectorXd::Zero(n)};
    for (const Swing& swing : swings) {
        const double theta = detail::find_theta(target.period[swing.oscillator], motion.dt());
        linear.wavelets.push_back(detail::make_adjustment_wavelet(theta, target.damping, swing.time, motion.size()));
        linear.unit.push_back(target.psa[swing.oscillator].value());
    }
    Eigen::VectorXd row(n);
    for (const Swing& swing : swings) {
        const double theta = detail::find_theta(target.period[swing.oscillator], motion.dt()), aim = target.psa[swing.oscillator].value();
        const std::vector<double> influence = detail::make_influence(theta, target.damping, swing.time);
        for (std::size_t j = 0; j < swings.size(); ++j) {
            row[static_cast<Eigen::Index>(j)] =
                swing.sign * theta * theta * detail::respond(influence, linear.wavelets[j]) * (linear.unit[j] / aim);
        }
        // weights that make least squares the sum of fourth powers, for those beyond the tolerance
        const double beyond = (1.0 - responses[swing.oscillator].psa / aim) / tolerance, weight = std::max(1.0, beyond * beyond);
        // a rival only has to stay below
        const double left = 1.0 - swing.psa / aim;
        const double wanted = swing.time == responses[swing.oscillator].peak ? left : std::min(0.0, left);
        linear.right += weight * wanted * row;
        linear.normal.selfadjointView<Eigen::Lower>().rankUpdate(row, weight);
    }
    return linear;
}

/// The motion with the wavelets added that damped least squares ask for.
TimeSeries add_wavelets(const TimeSeries& motion, const Linearization& linear, double caution) {
    Eigen::MatrixXd damped = linear.normal;
    damped.diagonal().array() += caution * linear.normal.diagonal().maxCoeff();
    const Eigen::VectorXd amplitude = damped.llt().solve(linear.right);

    std::vector<double> added(motion.size(), 0.0);
    for (std::size_t j = 0; j < linear.wavelets.size(); ++j) {
        const detail::Wavelet& wavelet = linear.wavelets[j];
        const double size = amplitude[static_cast<Eigen::Index>(j)] * linear.unit[j];
        for (std::size_t k = 0; k < wavelet.samples.size(); ++k) added[wavelet.first + k] += size * wavelet.samples[k];
    }
    added = detail::end_at_rest(std::move(added), motion.dt().value());
    for (std::size_t k = 0; k < added.size(); ++k) added[k] += motion.samples()[k];
    return motion.with_samples(std::move(added));
}

/// exp of the mean logarithm of target/PSA.
double find_factor(const TargetSpectrum& target, const std::vector<Response>& responses) {
    double sum = 0.0;
    for (std::size_t i = 0; i < responses.size(); ++i) sum -= log_ratio(target, responses, i);
    return std::exp(sum / static_cast<double>(responses.size()));
}

void check_target(const TimeSeries& motion, const TargetSpectrum& target) {
    constexpr std::size_t kMostPeriods = 1000;  // a matrix of 8 MB
    constexpr double kFewestSteps = 4.0;        // in a period: a wavelet needs samples
    if (target.period.empty() || target.period.size() > kMostPeriods || target.psa.size() != target.period.size()) {
        throw ProcessingError(fmt::format("{}: the target has {} periods and {} values (must be as many, 1 to {}); correct it or the band",
                                          kSpectrumMatch, target.period.size(), target.psa.size(), kMostPeriods));
    }
    require_damping(target.damping);
    if (!(target.damping < 1.0)) {
        throw ProcessingError(fmt::format("{}: damping ratio is {} (must be below 1); lower it", kSpectrumMatch, target.damping));
    }
    for (std::size_t i = 0; i < target.period.size(); ++i) {
        const double period = target.period[i].value(), psa = target.psa[i].value();
        if (!(psa > 0.0 && std::isfinite(psa))) {
            throw ProcessingError(fmt::format("{}: the target at {:.6g} s is {} m/s^2 (must be positive and finite); correct it",
                                              kSpectrumMatch, period, psa));
        }
        if (i > 0 && !(period > target.period[i - 1].value())) {
            throw ProcessingError(fmt::format("{}: period {:.6g} s follows {:.6g} s (must rise); sort the target", kSpectrumMatch, period,
                                              target.period[i - 1].value()));
        }
        if (!(period >= kFewestSteps * motion.dt().value() && period <= motion.duration().value())) {
            throw ProcessingError(
                fmt::format("{}: period {:.6g} s cannot be matched (must be {} time steps, {:.6g} s, to the record's length, {:.6g} s); "
                            "narrow the band or resample the record",
                            kSpectrumMatch, period, kFewestSteps, kFewestSteps * motion.dt().value(), motion.duration().value()));
        }
    }
}

}  // namespace

SpectrumMatch match_spectrum(const TimeSeries& acceleration, const TargetSpectrum& target, const SpectrumMatchSettings& settings) {
    require_quantity(acceleration, SampleQuantity::acceleration, kSpectrumMatch);
    if (!(settings.tolerance > 0.0 && std::isfinite(settings.tolerance))) {
        throw ProcessingError(fmt::format("{}: tolerance is {} (must be positive); give 0.05 for 5 %", kSpectrumMatch, settings.tolerance));
    }
    check_target(acceleration, target);
    std::vector<Response> responses = find_responses(acceleration, target);
    if (std::any_of(responses.begin(), responses.end(), [](const Response& response) { return !(response.psa > 0.0); })) {
        throw ProcessingError(fmt::format("{}: the record has no motion (nothing to match); choose another component", kSpectrumMatch));
    }

    SpectrumMatch match{acceleration, 1.0, find_misfit(target, responses), find_misfit(target, responses), 0};
    if (match.before.largest <= settings.tolerance) return match;
    match.factor = find_factor(target, responses);
    match.acceleration = amplify(acceleration, match.factor);
    responses = find_responses(match.acceleration, target);
    match.after = find_misfit(target, responses);

    // Levenberg-Marquardt: a step that makes it worse than all of the last ones is taken back and tried again with more caution
    double caution = kFirstCaution;
    std::vector<double> costs;
    while (match.after.largest > settings.tolerance) {
        const Linearization linear = linearize(match.acceleration, target, responses, settings.tolerance);
        costs.push_back(find_cost(target, responses));
        const auto recent = costs.end() - static_cast<std::ptrdiff_t>(std::min(costs.size(), kMemory));
        const double cost = *std::max_element(recent, costs.end());
        for (bool better = false; !better; ++match.iterations) {
            scaling::stop_if_interrupted();
            if (match.iterations >= settings.most_iterations || caution > kMostCaution) {
                throw ProcessingError(
                    fmt::format("{}: not reached after {} iterations (largest |ln(PSA/target)| {:.4g} at {:.4g} s, wanted {:.4g}); narrow "
                                "the band, raise the tolerance, smooth the target or take another record",
                                kSpectrumMatch, match.iterations, match.after.largest, match.after.largest_at.value(), settings.tolerance));
            }
            TimeSeries tried = add_wavelets(match.acceleration, linear, caution);
            std::vector<Response> there = find_responses(tried, target);
            better = find_cost(target, there) < cost;
            caution = better ? std::max(kLeastCaution, kBolder * caution) : kMoreCautious * caution;
            if (!better) continue;
            match.acceleration = std::move(tried);
            responses = std::move(there);
            match.after = find_misfit(target, responses);
        }
    }
    return match;
}

MatchedRecord match_spectrum(const GroundMotion& motion, std::string_view component, const TargetSpectrum& target,
                             const SpectrumMatchSettings& settings) {
    const Component& chosen = motion.find_component(component);
    SpectrumMatch match = match_spectrum(level_uncorrected(chosen.series, motion.integration_corner), target, settings);
    GroundMotion matched = motion;
    matched.components = {{.name = chosen.name, .azimuth_deg = chosen.azimuth_deg, .series = match.acceleration}};
    matched.history.push_back(
        fmt::format("matched to a spectrum [AlAtikAbrahamson10]: {} periods from {:.6g} to {:.6g} s, damping {:.6g}, multiplied by {:.9g}, "
                    "{} iterations, largest |ln(PSA/target)| from {:.4g} to {:.4g}",
                    target.period.size(), target.period.front().value(), target.period.back().value(), target.damping, match.factor,
                    match.iterations, match.before.largest, match.after.largest));
    return {std::move(matched), std::move(match)};
}

}  // namespace musim::records
