#include <doctest/doctest.h>

#include <cmath>
#include <complex>
#include <initializer_list>
#include <numbers>
#include <random>
#include <vector>

#include "records/processing/transform.hpp"

namespace musim::records {
namespace {

std::vector<double> make_noise(std::size_t n) {
    std::mt19937_64 random(n);
    std::vector<double> samples(n);
    for (double& sample : samples) sample = std::ldexp(static_cast<double>(random()), -63) - 1.0;
    return samples;
}

TEST_CASE("the transform is the sum that defines it, and its inverse gives the samples back, of any size") {
    // powers of two, other small factors, primes, and a prime times them
    for (const std::size_t n : std::initializer_list<std::size_t>{1, 2, 3, 8, 13, 17, 60, 97, 101, 128, 194, 1009, 1020}) {
        CAPTURE(n);
        const std::vector<double> samples = make_noise(n);
        const detail::Transform transform(samples);
        REQUIRE(transform.spectrum().size() == n / 2 + 1);
        // rounding of some log2(n) stages, each relative to the root of n that the values have
        const double tolerance = 64.0 * 2.2e-16 * std::sqrt(static_cast<double>(n)) * (1.0 + std::log2(static_cast<double>(n)));
        for (std::size_t k = 0; k <= n / 2; ++k) {
            std::complex<double> sum;
            for (std::size_t j = 0; j < n; ++j) {
                sum += samples[j] * std::polar(1.0, -2.0 * std::numbers::pi * static_cast<double>(j * k % n) / static_cast<double>(n));
            }
            CHECK(std::abs(transform.spectrum()[k] - sum) <= tolerance);
        }
        const std::vector<double> back = transform.back();
        REQUIRE(back.size() == n);
        for (std::size_t j = 0; j < n; ++j) CHECK(std::abs(back[j] - samples[j]) <= tolerance);
    }
}

TEST_CASE("a factor applied to a spectrum is a filter of the samples: a delay turns phases") {
    for (const std::size_t n : std::initializer_list<std::size_t>{24, 31}) {
        const std::vector<double> samples = make_noise(n);
        detail::Transform transform(samples);
        // three samples later; of an even size the last frequency stays real
        transform.apply([&](std::size_t k) {
            return std::polar(1.0, -2.0 * std::numbers::pi * 3.0 * static_cast<double>(k) / static_cast<double>(n));
        });
        const std::vector<double> back = transform.back();
        for (std::size_t j = 0; j < n; ++j) CHECK(back[(j + 3) % n] == doctest::Approx(samples[j]).scale(1.0).epsilon(1e-14));
    }
}

}  // namespace
}  // namespace musim::records
