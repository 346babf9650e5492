#include "records/synthesis/adjustment_wavelet.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "records/measures/oscillator.hpp"

namespace musim::records::detail {
namespace {

using std::numbers::pi;

/// γ in periods. [AlAtikAbrahamson10] has 1.178 f^{−0.93} s, which is no pure number; at 1 Hz it is this.
constexpr double kWidth = 1.2;

/// The wavelet is cut at so many γ to each side, where it has fallen to 1e-7.
constexpr double kReach = 4.0;

/// Wavelets fade in and out over this fraction of the record at its ends, so that none begins with a jump.
constexpr double kFade = 0.02;

double fade(double k, double steps) {
    const double share = std::min(k, steps - k) / (kFade * steps);
    return share < 1.0 ? 0.5 * (1.0 - std::cos(pi * share)) : 1.0;
}

}  // namespace

Wavelet make_adjustment_wavelet(double theta, double damping, double peak, std::size_t size) {
    const double root = std::sqrt(1.0 - damping * damping), damped = theta * root;
    const double middle = peak - std::atan2(root, damping) / damped;
    const double width = kWidth * 2.0 * pi / theta, steps = static_cast<double>(size - 1);
    const auto first = static_cast<std::size_t>(std::max(0.0, std::ceil(middle - kReach * width)));
    const auto last = static_cast<std::size_t>(std::clamp(std::floor(middle + kReach * width), 0.0, steps));
    Wavelet wavelet{first, {}};
    for (std::size_t k = first; k <= last; ++k) {
        const double tau = static_cast<double>(k) - middle, share = tau / width;
        wavelet.samples.push_back(fade(static_cast<double>(k), steps) * std::cos(damped * tau) * std::exp(-share * share));
    }
    return wavelet;
}

std::vector<double> make_influence(double theta, double damping, double peak) {
    // the step that the peak lies in, up to the peak
    const auto last = static_cast<std::size_t>(std::ceil(peak));
    const OscillatorStep end = make_part_of_step(theta, damping, peak - static_cast<double>(last - 1));
    std::vector<double> influence(last + 1, 0.0);
    influence[last] = end.u_1;
    influence[last - 1] = end.u_0;
    // how u at the peak depends on u and u̇ at sample i
    const OscillatorStep step = make_oscillator_step(theta, damping);
    double on_u = end.u_u, on_v = end.u_v;
    for (std::size_t i = last - 1; i > 0; --i) {
        influence[i] += on_u * step.u_1 + on_v * step.v_1;
        influence[i - 1] += on_u * step.u_0 + on_v * step.v_0;
        const double before_u = on_u * step.u_u + on_v * step.v_u;
        on_v = on_u * step.u_v + on_v * step.v_v;
        on_u = before_u;
    }
    return influence;
}

double respond(std::span<const double> influence, const Wavelet& wavelet) {
    double sum = 0.0;
    const std::size_t end = std::min(influence.size(), wavelet.first + wavelet.samples.size());
    for (std::size_t k = wavelet.first; k < end; ++k) sum += influence[k] * wavelet.samples[k - wavelet.first];
    return sum;
}

}  // namespace musim::records::detail
