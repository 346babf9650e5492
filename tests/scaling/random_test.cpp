#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "scaling/detail/portable_math.hpp"
#include "scaling/random_bits.hpp"
#include "scaling/uncertainty/distribution.hpp"
#include "tests/scaling/expected.hpp"
#include "tests/support/relative.hpp"

namespace musim::scaling::tests {

using lsdem::tests::relative;

namespace {

constexpr double kEpsilon = std::numeric_limits<double>::epsilon();

}  // namespace

TEST_CASE("random bits are those of SplitMix64, one after another") {
    // seed 1234567, as published with the generator
    constexpr std::uint64_t kFirst[] = {6457827717110365317ULL, 3203168211198807973ULL, 9817491932198370423ULL};
    for (std::uint64_t i = 0; i < 3; ++i) CHECK(random_bits(1234567, i) == kFirst[i]);
}

TEST_CASE("probabilities lie inside (0, 1), symmetric about 1/2") {
    CHECK(to_probability(0) == 0x1p-53);
    CHECK(to_probability(~std::uint64_t{0}) == 1.0 - 0x1p-53);
}

TEST_CASE("portable logarithms and exponentials agree with those of the C library to a few units in the last place") {
    for (double x = 1e-300; x < 1e300; x *= 7.3) CHECK(detail::portable_log(x) == relative(std::log(x), 4.0 * kEpsilon));
    for (double x = 0.55; x < 1.9; x += 0.0137) {
        // next to 1 the logarithm itself vanishes
        CHECK(std::abs(detail::portable_log(x) - std::log(x)) <= 4.0 * kEpsilon * std::max(std::abs(std::log(x)), 0.1));
    }
    for (double x = 1e-20; x < 1e6; x *= 3.7) CHECK(detail::portable_log1p(x) == relative(std::log1p(x), 4.0 * kEpsilon));
    CHECK(detail::portable_log1p(0.0) == 0.0);
    for (double x = -40.0; x < 40.0; x += 0.313) CHECK(detail::portable_exp(x) == relative(std::exp(x), 4.0 * kEpsilon));
    CHECK(detail::portable_exp(0.0) == 1.0);
}

TEST_CASE("the normal quantile inverts the normal distribution function") {
    CHECK(normal_quantile(0.5) == 0.0);
    CHECK_EXPECTED(normal_quantile(0.975), "1.959963984540054");
    CHECK_EXPECTED(normal_quantile(1e-10), "-6.361340902404056");
    for (double z = -8.0; z < 0.0; z += 0.0625) {
        const double p = 0.5 * std::erfc(-z / std::numbers::sqrt2);
        // an error of p moves z by dp/φ(z): 1e-15 p/φ, at most some 1e-15, of erfc itself, and epsilon/φ(z) of 1 - p, where p/φ is
        // below 1.3
        CHECK(normal_quantile(p) == relative(z, 1e-14));
        CHECK(normal_quantile(1.0 - p) == doctest::Approx(-z).epsilon(1e-13 + 1.3 * kEpsilon / p));
    }
}

TEST_CASE("quantiles of every distribution have the mean and the standard deviation asked for") {
    const Uncertain quantity{.value = 0.63, .uncertainty = 0.11};
    // midpoints of n equal parts of probability: the rule for the mean converges at least like the tail, 1/n of the last part
    constexpr int kParts = 1 << 18;
    for (const Distribution distribution : {Distribution::normal, Distribution::lognormal, Distribution::uniform}) {
        CAPTURE(to_string(distribution));
        double mean = 0.0;
        double square = 0.0;
        for (int i = 0; i < kParts; ++i) {
            const double x = find_quantile(distribution, quantity, (i + 0.5) / kParts);
            mean += x / kParts;
            square += (x - quantity.value) * (x - quantity.value) / kParts;
        }
        // what is cut off lies beyond 4.8 standard deviations (lognormal: 5.1 u): below n^-1 · 5² = 1e-4 of the variance
        CHECK(mean == relative(quantity.value, 1e-5));
        CHECK(std::sqrt(square) == relative(quantity.uncertainty, 2e-4));
    }
}

// made by another program, from the published formulas
TEST_CASE("quantiles are the same numbers everywhere") {
    const Uncertain quantity{.value = 0.63, .uncertainty = 0.03};
    const double p = to_probability(random_bits(42, 7));
    CHECK(find_quantile(Distribution::normal, quantity, p) == 0x1.4f85a1f9eaec8p-1);
    CHECK(find_quantile(Distribution::lognormal, quantity, p) == 0x1.4f65f4fedb210p-1);
    CHECK(find_quantile(Distribution::uniform, quantity, p) == 0x1.528e6339035bap-1);
}

TEST_CASE("distributions are found by name, an unknown one is answered with the list") {
    for (const Distribution distribution : {Distribution::normal, Distribution::lognormal, Distribution::uniform}) {
        CHECK(parse_distribution(to_string(distribution)) == distribution);
    }
    CHECK_THROWS_WITH_AS(parse_distribution("gauss"),
                         "uncertainty: there is no distribution \"gauss\"; choose one of normal, lognormal, uniform", SimilitudeError);
}

}  // namespace musim::scaling::tests
