#include "records/measures/oscillator_walk.hpp"

#include <algorithm>
#include <cmath>

namespace musim::records::detail {

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
