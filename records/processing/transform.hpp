#pragma once

#include <complex>
#include <span>
#include <vector>

namespace musim::records::detail {

/// Discrete Fourier transform of real samples, X_k = Σ x_j e^{−2πijk/n} for k = 0 ... n/2, of any size in a time of order n log n.
class Transform {
  public:
    explicit Transform(std::span<const double> samples);

    const std::vector<std::complex<double>>& spectrum() const { return spectrum_; }

    /// Multiplies every X_k by factor(k).
    template <class Factor>
    void apply(const Factor& factor) {
        for (std::size_t k = 0; k < spectrum_.size(); ++k) spectrum_[k] *= factor(k);
    }

    /// The samples that now belong to the spectrum.
    std::vector<double> back() const;

  private:
    std::size_t size_;
    std::vector<std::complex<double>> spectrum_;
};

}  // namespace musim::records::detail
