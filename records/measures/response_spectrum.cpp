#include "records/measures/response_spectrum.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>

#include "records/error.hpp"
#include "records/measures/oscillator.hpp"
#include "records/processing/processing.hpp"
#include "scaling/interruption.hpp"

namespace musim::records {

namespace {

/// So many oscillators go through the record side by side.
constexpr std::size_t kBatch = 8;

using Lane = std::array<double, kBatch>;

/// One response of the oscillators of a batch: where it is, its slope per substep, and its largest size so far.
struct ResponsePeak {
    Lane value{}, slope{}, most{};

    /// Goes on to the end of a substep. Its extremes inside are looked for only where the cubic may go beyond the largest size so far: it
    /// stays within its ends and the points that its slopes reach after a third of the substep.
    void advance(const Lane& next_value, const Lane& next_slope, bool fine) {
        const Lane last_value = value, last_slope = slope;
        value = next_value;
        slope = next_slope;
        double beyond = 0.0;
        for (std::size_t k = 0; k < kBatch; ++k) {
            most[k] = std::max(most[k], std::abs(value[k]));
            const double reach = std::max(std::abs(last_value[k] + last_slope[k] / 3.0), std::abs(value[k] - slope[k] / 3.0));
            beyond = std::max(beyond, reach - most[k]);
        }
        if (!(beyond > 0.0 && fine)) return;
        for (std::size_t k = 0; k < kBatch; ++k) {
            most[k] = std::max(most[k], detail::Cubic{last_value[k], last_slope[k], value[k], slope[k]}.find_peak());
        }
    }
};

/// Oscillators that go through a record side by side, from rest at its first sample, all by the same substeps and in units of these.
class OscillatorBatch {
  public:
    OscillatorBatch(const Lane& theta, double damping, const detail::Substeps& substeps) : substeps_(substeps) {
        for (std::size_t k = 0; k < kBatch; ++k) {
            const double turn = theta[k] / static_cast<double>(substeps.count);
            const detail::OscillatorStep step = detail::make_oscillator_step(turn, damping);
            uu_[k] = step.u_u, uv_[k] = step.u_v, u0_[k] = step.u_0, u1_[k] = step.u_1;
            vu_[k] = step.v_u, vv_[k] = step.v_v, v0_[k] = step.v_0, v1_[k] = step.v_1;
            drag_[k] = 2.0 * damping * turn;
            spring_[k] = turn * turn;
        }
    }

    void run(std::span<const double> samples) {
        if (samples.empty()) return;
        velocity.slope.fill(-samples[0]);
        for (std::size_t k = 0; k < kBatch; ++k) total.slope[k] = -drag_[k] * samples[0];
        for (std::size_t i = 1; i < samples.size(); ++i) {
            const double rise = (samples[i] - samples[i - 1]) / static_cast<double>(substeps_.count);
            double before = samples[i - 1];
            for (std::size_t part = 1; part < substeps_.count; ++part) {
                const double now = samples[i - 1] + rise * static_cast<double>(part);
                advance(before, now);
                before = now;
            }
            advance(before, samples[i]);
        }
    }

    ResponsePeak displacement;  ///< u
    ResponsePeak velocity;      ///< u̇
    ResponsePeak total;         ///< 2ζθ u̇ + θ² u, less the acceleration of the mass

  private:
    void advance(double before, double now) {
        Lane u, v, w, a, rate;
        for (std::size_t k = 0; k < kBatch; ++k) {
            const double u_before = displacement.value[k], v_before = velocity.value[k];
            u[k] = (uu_[k] * u_before + uv_[k] * v_before) + (u0_[k] * before + u1_[k] * now);
            v[k] = (vu_[k] * u_before + vv_[k] * v_before) + (v0_[k] * before + v1_[k] * now);
            a[k] = drag_[k] * v[k] + spring_[k] * u[k];
            w[k] = -(a[k] + now);
            rate[k] = drag_[k] * w[k] + spring_[k] * v[k];
        }
        displacement.advance(u, v, substeps_.fine);
        velocity.advance(v, w, substeps_.fine);
        total.advance(a, rate, substeps_.fine);
    }

    detail::Substeps substeps_;
    Lane uu_{}, uv_{}, u0_{}, u1_{}, vu_{}, vv_{}, v0_{}, v1_{}, drag_{}, spring_{};
};

/// Fills in the responses at some of the spectrum's periods, at most kBatch, which have as many substeps.
void compute_batch(const TimeSeries& acceleration, std::span<const std::size_t> members, ResponseSpectrum& spectrum) {
    scaling::stop_if_interrupted();
    Lane theta{};
    for (std::size_t k = 0; k < kBatch; ++k) {
        theta[k] = detail::find_theta(spectrum.period[members[std::min(k, members.size() - 1)]] * scaling::si::seconds, acceleration.dt());
    }
    const detail::Substeps substeps = detail::find_substeps(theta[0], spectrum.damping);
    OscillatorBatch batch(theta, spectrum.damping, substeps);
    batch.run(acceleration.samples());
    const double dt = acceleration.dt().value() / static_cast<double>(substeps.count);
    for (std::size_t k = 0; k < members.size(); ++k) {
        spectrum.displacement[members[k]] = batch.displacement.most[k] * dt * dt;
        spectrum.velocity[members[k]] = batch.velocity.most[k] * dt;
        spectrum.acceleration[members[k]] = batch.total.most[k];
    }
}

/// Samples in the shortest period, and how many periods there are.
constexpr double kShortest = 4.0;
constexpr std::size_t kPeriods = 200;

scaling::Time find_longest_period(const TimeSeries& acceleration, const std::optional<scaling::Frequency>& corner) {
    if (!corner) return acceleration.duration();
    if (!(corner->value() > 0.0)) {
        throw ProcessingError(fmt::format("the integration corner is {} Hz (must be above 0); change it", corner->value()));
    }
    return std::min(0.25 * acceleration.duration(), scaling::Time(1.0 / *corner));
}

}  // namespace

void require_damping(double damping) {
    if (!(damping >= 0.0 && damping <= kLargestDamping)) {
        throw ProcessingError(
            fmt::format("damping ratio is {} (must be a fraction of critical from 0 to {}); give 0.05 for 5 %", damping, kLargestDamping));
    }
}

void require_periods(std::span<const scaling::Time> periods) {
    for (const scaling::Time& period : periods) {
        if (!(std::isfinite(period.value()) && period.value() >= 0.0)) {
            throw ProcessingError(fmt::format("period is {} s (must be 0 or more); change it", period.value()));
        }
    }
}

std::vector<double> ResponseSpectrum::pseudo_velocity() const {
    std::vector<double> values(period.size(), 0.0);
    for (std::size_t i = 0; i < period.size(); ++i) {
        if (period[i] > 0.0) values[i] = 2.0 * std::numbers::pi / period[i] * displacement[i];
    }
    return values;
}

std::vector<double> ResponseSpectrum::pseudo_acceleration() const {
    std::vector<double> values = acceleration;
    for (std::size_t i = 0; i < period.size(); ++i) {
        const double omega = 2.0 * std::numbers::pi / period[i];
        if (period[i] > 0.0) values[i] = omega * omega * displacement[i];
    }
    return values;
}

ResponseSpectrum compute_response_spectrum(const TimeSeries& acceleration, std::span<const scaling::Time> periods, double damping) {
    require_quantity(acceleration, SampleQuantity::acceleration, "the response spectrum");
    require_damping(damping);
    require_periods(periods);
    ResponseSpectrum spectrum;
    spectrum.damping = damping;
    for (const scaling::Time& period : periods) spectrum.period.push_back(period.value());
    spectrum.displacement.assign(periods.size(), 0.0);
    spectrum.velocity.assign(periods.size(), 0.0);
    spectrum.acceleration.assign(periods.size(), find_largest(acceleration.samples()));

    // oscillators with as many substeps go side by side
    std::map<detail::Substeps, std::vector<std::size_t>> flexible;
    for (std::size_t i = 0; i < periods.size(); ++i) {
        if (periods[i].value() > 0.0) {
            flexible[detail::find_substeps(detail::find_theta(periods[i], acceleration.dt()), damping)].push_back(i);
        }
    }
    for (const auto& [substeps, members] : flexible) {
        for (std::size_t first = 0; first < members.size(); first += kBatch) {
            compute_batch(acceleration, std::span(members).subspan(first, std::min(kBatch, members.size() - first)), spectrum);
        }
    }
    return spectrum;
}

TimeSeries compute_oscillator_response(const TimeSeries& acceleration, scaling::Time period, double damping) {
    require_quantity(acceleration, SampleQuantity::acceleration, "the response of an oscillator");
    require_damping(damping);
    require_periods({&period, 1});
    if (period.value() == 0.0) throw ProcessingError("period is 0 s (must be above 0); change it");
    const double dt = acceleration.dt().value();
    const detail::OscillatorStep step = detail::make_oscillator_step(detail::find_theta(period, acceleration.dt()), damping);
    const std::span<const double> a = acceleration.samples();
    std::vector<double> response(a.size(), 0.0);
    double u = 0.0, v = 0.0;
    for (std::size_t i = 1; i < a.size(); ++i) {
        const double next_u = (step.u_u * u + step.u_v * v) + (step.u_0 * a[i - 1] + step.u_1 * a[i]);
        v = (step.v_u * u + step.v_v * v) + (step.v_0 * a[i - 1] + step.v_1 * a[i]);
        u = next_u;
        response[i] = u * dt * dt;
    }
    return acceleration.with_samples(SampleQuantity::displacement, std::move(response));
}

std::vector<scaling::Time> make_periods(scaling::Time first, scaling::Time last, std::size_t count) {
    if (!(first.value() > 0.0 && last > first && std::isfinite(last.value()) && count >= 2)) {
        throw ProcessingError(fmt::format("{} periods from {} s to {} s are impossible (0 < first < last, at least 2); change them", count,
                                          first.value(), last.value()));
    }
    std::vector<scaling::Time> periods;
    const double ratio = last.value() / first.value();
    for (std::size_t i = 0; i < count; ++i) {
        periods.push_back(first * std::pow(ratio, static_cast<double>(i) / static_cast<double>(count - 1)));
    }
    periods.back() = last;
    return periods;
}

ResponseSpectrum compute_own_spectrum(const TimeSeries& acceleration, std::optional<scaling::Frequency> integration_corner,
                                      double damping) {
    const scaling::Time first = kShortest * acceleration.dt(), last = find_longest_period(acceleration, integration_corner);
    const std::vector<scaling::Time> periods = first < last ? make_periods(first, last, kPeriods) : std::vector<scaling::Time>();
    if (integration_corner) return compute_response_spectrum(acceleration, periods, damping);
    return compute_response_spectrum(pad(acceleration, {}, acceleration.duration()), periods, damping);
}

}  // namespace musim::records
