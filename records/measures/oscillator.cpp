#include "records/measures/oscillator.hpp"

#include <algorithm>
#include <cmath>

namespace musim::records::detail {

namespace {

/// e^{−ζθ}·cos(θ_d) and e^{−ζθ}·sin(θ_d)/θ_d with θ_d² = θ²(1 − ζ²), and what they become above critical damping.
struct Decay {
    double cosine = 1.0, sine = 1.0;
};

Decay find_decay(double theta, double damping) {
    const double damped = damping * theta, root = theta * std::sqrt(std::abs((1.0 - damping) * (1.0 + damping)));
    if (damping <= 1.0) return {std::exp(-damped) * std::cos(root), std::exp(-damped) * (root > 0.0 ? std::sin(root) / root : 1.0)};
    // θ² = (ζθ − x)(ζθ + x): the slow root without cancellation
    const double fast = std::exp(-(damped + root)), slow = std::exp(-theta * theta / (damped + root));
    return {0.5 * (slow + fast), root > 0.0 ? 0.5 * (slow - fast) / root : fast};
}

/// Displacement after one step from rest under the load −τ^power, τ from 0 to 1, as a power series; for θ small, where the closed form is a
/// difference of large numbers.
double sum_series(double theta, double damping, int power) {
    constexpr int kTerms = 60;
    double term0 = 0.0, term1 = 0.0, sum = 0.0;  // coefficients of τ^k and τ^(k+1)
    for (int k = 0; k < kTerms; ++k) {
        const double load = k == power ? 1.0 : 0.0;
        const double term2 = -(2.0 * damping * theta * (k + 1) * term1 + theta * theta * term0 + load) / ((k + 2.0) * (k + 1.0));
        sum += term2;
        term0 = term1;
        term1 = term2;
    }
    return sum;
}

}  // namespace

OscillatorStep make_oscillator_step(double theta, double damping) {
    // below, the series has lost nothing after kTerms, also at high damping; above, the closed form loses three digits at most
    constexpr double kSmall = 0.25;
    constexpr double kSmallDamped = 2.0;
    const auto [cosine, sine] = find_decay(theta, damping);
    OscillatorStep step;
    step.u_u = cosine + damping * theta * sine;
    step.u_v = sine;
    step.v_u = -theta * theta * sine;
    step.v_v = cosine - damping * theta * sine;
    double constant = 0.0, ramp = 0.0;
    if (theta < kSmall && 2.0 * damping * theta < kSmallDamped) {
        constant = sum_series(theta, damping, 0);
        ramp = sum_series(theta, damping, 1);
    } else {
        const double square = theta * theta;
        constant = -(1.0 - step.u_u) / square;
        ramp = -(1.0 - step.u_v) / square + 2.0 * damping / (square * theta) * (1.0 - step.u_u);
    }
    // the rate of the response to a ramp is the response to a constant load, and that of the latter the one to a blow
    step.u_0 = constant - ramp;
    step.u_1 = ramp;
    step.v_0 = -sine - constant;
    step.v_1 = constant;
    return step;
}

OscillatorStep make_part_of_step(double theta, double damping, double share) {
    // a step of its own, s times as long; its load ends at (1 − s)a₀ + s·a₁
    const OscillatorStep part = make_oscillator_step(share * theta, damping);
    const double square = share * share;
    OscillatorStep step{.u_u = part.u_u, .u_v = share * part.u_v};
    step.u_0 = square * (part.u_0 + part.u_1 * (1.0 - share));
    step.u_1 = square * part.u_1 * share;
    step.v_v = 0.0;
    return step;
}

Substeps find_substeps(double theta, double damping) {
    constexpr double kLargestTurn = 0.25;
    const double fastest = damping > 1.0 ? theta * (damping + std::sqrt((damping - 1.0) * (damping + 1.0))) : theta;
    Substeps substeps;
    while (substeps.count < kMostSubsteps && fastest > kLargestTurn * static_cast<double>(substeps.count)) substeps.count *= 2;
    substeps.fine = fastest <= kLargestTurn * static_cast<double>(substeps.count);
    return substeps;
}

double Cubic::at(double share) const {
    const double rise = value1 - value0, square = 3.0 * rise - 2.0 * slope0 - slope1, cube = slope0 + slope1 - 2.0 * rise;
    return value0 + share * (slope0 + share * (square + share * cube));
}

std::array<double, 2> Cubic::find_extremes() const {
    // slope0 + 2·square·τ + 3·cube·τ² = 0, by the form that does not cancel
    const double rise = value1 - value0, square = 3.0 * rise - 2.0 * slope0 - slope1, cube = slope0 + slope1 - 2.0 * rise;
    std::array<double, 2> extremes{-1.0, -1.0};
    const double root = square * square - 3.0 * cube * slope0;
    if (!(root >= 0.0)) return extremes;
    const double sum = -(square + std::copysign(std::sqrt(root), square));
    const auto keep = [](double numerator, double denominator) {
        const bool inside = numerator != 0.0 && std::abs(numerator) <= std::abs(denominator) && (numerator > 0.0) == (denominator > 0.0);
        return inside ? numerator / denominator : -1.0;
    };
    return {keep(sum, 3.0 * cube), keep(slope0, sum)};
}

double Cubic::find_peak() const {
    double peak = 0.0;
    for (const double share : find_extremes()) {
        if (share > 0.0) peak = std::max(peak, std::abs(at(share)));
    }
    return peak;
}

OscillatorWalk::OscillatorWalk(std::span<const double> samples, double theta, double damping)
    : samples_(samples),
      substeps_(find_substeps(theta, damping)),
      part_(make_oscillator_step(theta / static_cast<double>(substeps_.count), damping)),
      unit_(1.0 / static_cast<double>(substeps_.count * substeps_.count)) {}

bool OscillatorWalk::next() {
    if (next_ / substeps_.count + 1 >= samples_.size()) return false;
    step_ = next_ / substeps_.count;
    substep_ = next_ % substeps_.count;
    ++next_;
    const double first = samples_[step_], rise = (samples_[step_ + 1] - first) / static_cast<double>(substeps_.count);
    const double before = first + rise * static_cast<double>(substep_);
    const double now = substep_ + 1 == substeps_.count ? samples_[step_ + 1] : first + rise * static_cast<double>(substep_ + 1);
    before_u_ = u_;
    before_v_ = v_;
    u_ = (part_.u_u * before_u_ + part_.u_v * before_v_) + (part_.u_0 * before + part_.u_1 * now);
    v_ = (part_.v_u * before_u_ + part_.v_v * before_v_) + (part_.v_0 * before + part_.v_1 * now);
    return true;
}

Cubic OscillatorWalk::displacement() const { return {unit_ * before_u_, unit_ * before_v_, unit_ * u_, unit_ * v_}; }

}  // namespace musim::records::detail
