#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace musim::records::detail {

/// Samples from `first` on; zero before and after.
struct Wavelet {
    std::size_t first = 0;
    std::vector<double> samples;
};

/// Improved tapered cosine wavelet [AlAtikAbrahamson10] for an oscillator of θ = ω dt and damping ratio ζ < 1 whose response peaks at
/// `peak` [steps], in a record of `size` samples. In steps, around τ = 0 at the peak less the oscillator's lag:
///
///   cos(θ_d τ) e^{−(τ/γ)²},   θ_d = θ √(1 − ζ²),   lag = atan(√(1 − ζ²)/ζ)/θ_d,   γ = 1.2 · 2π/θ
///
/// Its velocity and displacement return to zero to e^{−(θ_d γ/2)²} = 7e-7. Both ends of the record are faded to zero.
Wavelet make_adjustment_wavelet(double theta, double damping, double peak, std::size_t size);

/// Dependence of the response of an oscillator at the time `peak` > 0 [steps] on each sample a_k, k from 0 to the sample at the peak or the
/// first after it: ∂u/∂a_k in steps, by the recursion of the oscillator run backward. The response to a wavelet is then a sum over the
/// wavelet's samples.
std::vector<double> make_influence(double theta, double damping, double peak);

/// Σ influence·wavelet: u at the peak due to the wavelet alone.
double respond(std::span<const double> influence, const Wavelet& wavelet);

}  // namespace musim::records::detail
