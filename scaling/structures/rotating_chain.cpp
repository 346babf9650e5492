#include "scaling/structures/rotating_chain.hpp"

#include <cmath>
#include <numbers>

namespace musim::scaling {
namespace {

/// ω² solves i ω⁴ − trace ω² + determinant = 0, all over (k_s/m); `i` is I/(m H²). With `slope` the same, derived by q.
struct Characteristic {
    double inertia, trace, determinant, trace_slope, determinant_slope;
    double root;  ///< √(trace² − 4 i determinant)

    double lower_squared() const { return 2.0 * determinant / (trace + root); }  // without cancellation
    double upper_squared() const { return (trace + root) / (2.0 * inertia); }
};

Characteristic find_characteristic(const RotatingChain& chain, double wavenumber) {
    const double squared = chain.slenderness * chain.slenderness;
    const double s = std::pow(std::sin(0.5 * wavenumber), 2), c = std::pow(std::cos(0.5 * wavenumber), 2),
                 slope = 0.5 * std::sin(wavenumber);
    const double bending = chain.stiffness_ratio * squared / 3.0;

    Characteristic equation{};
    equation.inertia = (1.0 + squared) / 12.0;
    equation.trace = c + bending * s + 4.0 * s * equation.inertia;
    equation.trace_slope = slope * (bending - 1.0 + 4.0 * equation.inertia);
    equation.determinant = 4.0 * bending * s * s;  // shear and rotation as such cancel against their coupling, sin²q
    equation.determinant_slope = 8.0 * bending * s * slope;
    equation.root = std::sqrt(std::fmax(0.0, equation.trace * equation.trace - 4.0 * equation.inertia * equation.determinant));
    return equation;
}

}  // namespace

std::array<double, 2> RotatingChain::frequencies(double wavenumber) const {
    const Characteristic equation = find_characteristic(*this, wavenumber);
    return {std::sqrt(equation.lower_squared()), std::sqrt(equation.upper_squared())};
}

double RotatingChain::group_speed(double wavenumber) const {
    const Characteristic equation = find_characteristic(*this, wavenumber);
    const double squared = equation.lower_squared();
    // implicit derivative of the characteristic equation; 2 i ω² − trace = −root on the lower branch
    const double squared_slope = (equation.determinant_slope - squared * equation.trace_slope) / equation.root;
    return 0.5 * squared_slope / std::sqrt(squared);
}

ChainWave find_fastest_sway(const RotatingChain& chain) {
    constexpr double kStep = std::numbers::pi / (kWavenumbers + 1);
    int best = 1;
    for (int i = 2; i <= kWavenumbers; ++i) {
        if (chain.group_speed(i * kStep) > chain.group_speed(best * kStep)) best = i;
    }

    // golden section between the neighbours of the best one, within the open interval (0, pi); a speed at its peak is flat, so a millionth
    // of the wavenumber leaves 1e-12 of the speed
    constexpr double kGolden = 1.0 / std::numbers::phi;
    double low = best == 1 ? 1e-3 * kStep : (best - 1) * kStep, high = (best + 0.999) * kStep;
    while (high - low > 1e-6 * high) {
        const double left = high - kGolden * (high - low), right = low + kGolden * (high - low);
        if (chain.group_speed(left) < chain.group_speed(right)) {
            low = left;
        } else {
            high = right;
        }
    }
    const double wavenumber = 0.5 * (low + high);
    return {wavenumber, chain.group_speed(wavenumber)};
}

}  // namespace musim::scaling
