#include "records/processing/transform.hpp"

#include <algorithm>
#include <numbers>
#include <unsupported/Eigen/FFT>

namespace musim::records::detail {
namespace {

using Values = std::vector<std::complex<double>>;

/// Largest prime factor that the library's transform takes in a time of order n log n: that of other factors p is of order n p.
constexpr std::size_t kLargestFactor = 13;

bool has_small_factors(std::size_t n) {
    for (std::size_t factor = 2; factor <= kLargestFactor; ++factor) {
        while (n % factor == 0) n /= factor;
    }
    return n == 1;
}

Values transform_directly(const Values& in) {
    Values out(in.size());
    Eigen::FFT<double>().fwd(out.data(), in.data(), static_cast<Eigen::Index>(in.size()));
    return out;
}

Values transform_back(const Values& in) {
    Values out(in.size());
    Eigen::FFT<double>().inv(out.data(), in.data(), static_cast<Eigen::Index>(in.size()));
    return out;
}

/// A transform of any size as a convolution of one with small factors: jk = (j² + k² − (k − j)²)/2 [Bluestein70].
Values transform_by_chirp(const Values& in) {
    const std::size_t n = in.size();
    std::size_t padded = 2 * n - 1;
    while (!has_small_factors(padded)) ++padded;

    Values chirp(n);  // e^{−πij²/n}, whose exponent repeats with j² modulo 2n
    for (std::size_t j = 0; j < n; ++j) {
        chirp[j] = std::polar(1.0, -std::numbers::pi * static_cast<double>(j * j % (2 * n)) / static_cast<double>(n));
    }
    Values signal(padded), kernel(padded);
    for (std::size_t j = 0; j < n; ++j) {
        signal[j] = in[j] * chirp[j];
        kernel[j] = kernel[(padded - j) % padded] = std::conj(chirp[j]);
    }
    signal = transform_directly(signal);
    kernel = transform_directly(kernel);
    for (std::size_t k = 0; k < padded; ++k) signal[k] *= kernel[k];
    signal = transform_back(signal);

    Values out(n);
    for (std::size_t k = 0; k < n; ++k) out[k] = signal[k] * chirp[k];
    return out;
}

/// Σ x_j e^{−2πijk/n}. The library's own has no case for a single sample.
Values transform(const Values& in) {
    if (in.size() < 2) return in;
    return has_small_factors(in.size()) ? transform_directly(in) : transform_by_chirp(in);
}

}  // namespace

Transform::Transform(std::span<const double> samples) : size_(samples.size()) {
    spectrum_ = transform(Values(samples.begin(), samples.end()));
    spectrum_.resize(size_ / 2 + 1);
}

std::vector<double> Transform::back() const {
    // the inverse is the transform of the conjugate, which real samples leave as it is
    Values whole(size_);
    for (std::size_t k = 0; k < spectrum_.size(); ++k) {
        whole[k] = std::conj(spectrum_[k]);
        if (k > 0) whole[size_ - k] = spectrum_[k];
    }
    // these are their own conjugates
    whole.front() = spectrum_.front().real();
    if (size_ % 2 == 0) whole[size_ / 2] = spectrum_.back().real();
    whole = transform(whole);
    std::vector<double> samples(size_);
    std::transform(whole.begin(), whole.end(), samples.begin(), [&](const auto& x) { return x.real() / static_cast<double>(size_); });
    return samples;
}

}  // namespace musim::records::detail
