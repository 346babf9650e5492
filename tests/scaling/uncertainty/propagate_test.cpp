#include "scaling/uncertainty/propagate.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <cstring>
#include <stdexcept>

#include "scaling/uncertainty/monte_carlo.hpp"
#include "tests/scaling/expected.hpp"
#include "tests/support/relative.hpp"

namespace musim::scaling::tests {

using lsdem::tests::relative;

namespace {

/// x²/√y, x/x, y^(1/3), √x.
std::vector<double> evaluate_products(std::span<const double> v) {
    return {v[0] * v[0] / std::sqrt(v[1]), v[0] / v[0], std::cbrt(v[1]), std::sqrt(v[0])};
}

std::vector<UncertainInput> make_inputs(double relative_x, double relative_y) {
    return {{"x", {0.63, 0.63 * relative_x}}, {"y", {0.59, 0.59 * relative_y}}};
}

/// Bounds of sampling errors in standard deviations: a normal one passes with 1 - 6e-7, and seeds are fixed.
constexpr double kSigmas = 5.0;

}  // namespace

TEST_CASE("relative variances of a product add with the squares of its exponents") {
    const std::vector<FirstOrder> results = propagate_first_order(make_inputs(0.05, 0.02), evaluate_products);
    REQUIRE(results.size() == 4);
    CHECK(results[0].exponents == std::vector{2.0, -0.5});
    CHECK_EXPECTED(results[0].relative, std::hypot(2.0 * 0.05, 0.5 * 0.02));
    CHECK_EXPECTED(results[0].uncertainty(), results[0].value * std::hypot(0.1, 0.01));
    CHECK(results[2].exponents == std::vector{0.0, 1.0 / 3.0});
    CHECK_EXPECTED(results[3].relative, 0.025);
}

TEST_CASE("an input that cancels leaves no uncertainty") {
    const std::vector<FirstOrder> results = propagate_first_order(make_inputs(0.05, 0.02), evaluate_products);
    CHECK(results[1].exponents == std::vector{0.0, 0.0});
    CHECK(results[1].relative == 0.0);
}

TEST_CASE("a result that is no product of powers has the derivative of its logarithm") {
    // ln(x + y): x/(x + y), to the square of the step that is taken
    const auto results = propagate_first_order(make_inputs(0.05, 0.02), [](auto v) { return std::vector{v[0] + v[1]}; });
    CHECK(results[0].exponents[0] == relative(0.63 / 1.22, 1e-6));
    CHECK(results[0].exponents[1] == relative(0.59 / 1.22, 1e-6));
}

TEST_CASE("for small uncertainties Monte Carlo agrees with first order within its sampling error") {
    // second order adds some u² = 1e-3 u to value and spread; skewness, some 1e-2, moves ends of the interval by (1.96² - 1)/6 of it, in u
    const std::vector<UncertainInput> inputs = make_inputs(1e-3, 1e-3);
    const std::vector<FirstOrder> first = propagate_first_order(inputs, evaluate_products);
    for (const Distribution distribution : {Distribution::normal, Distribution::lognormal, Distribution::uniform}) {
        CAPTURE(to_string(distribution));
        const MonteCarloSettings settings{.samples = 100'000, .seed = 7, .distribution = distribution};
        const MonteCarloRun run = run_monte_carlo(inputs, evaluate_products, settings);
        const double n = 100'000.0;
        CHECK(run.draws.rejected == 0);
        for (const std::size_t r : {0U, 2U, 3U}) {
            CAPTURE(r);
            const double u = first[r].uncertainty();
            CHECK(std::abs(run.results[r].mean - first[r].value) <= kSigmas * u / std::sqrt(n) + 1e-2 * u);
            // the standard deviation of a sample's standard deviation is at most u/√(2 n), of a normal one
            CHECK(std::abs(run.results[r].standard_deviation - u) <= kSigmas * u / std::sqrt(2.0 * n) + 1e-3 * u);
            // of a quantile √(p (1 - p)/n)/density: at 2.5 % of a normal one 0.156/0.0584 u = 2.67 u/√n, of sums of uniform ones less
            if (distribution != Distribution::uniform) {
                CHECK(std::abs(run.results[r].lower - (first[r].value - 1.959964 * u)) <= kSigmas * 2.67 * u / std::sqrt(n) + 5e-3 * u);
                CHECK(std::abs(run.results[r].upper - (first[r].value + 1.959964 * u)) <= kSigmas * 2.67 * u / std::sqrt(n) + 5e-3 * u);
            }
        }
        // one uniform input: 95 % of a width of 2 √3 u
        if (distribution == Distribution::uniform) {
            const double half = 0.95 * std::sqrt(3.0) * first[3].uncertainty();
            // density 1/(2 √3 u): √(0.025 · 0.975/n) 2 √3 u = 0.54 u/√n
            const double sampling = kSigmas * 0.55 * first[3].uncertainty() / std::sqrt(n);
            CHECK(std::abs(run.results[3].upper - (first[3].value + half)) <= sampling + 2e-3 * first[3].uncertainty());
        }
    }
}

TEST_CASE("products of lognormal inputs follow their closed form at large uncertainties") {
    const std::vector<UncertainInput> inputs = make_inputs(0.5, 0.3);
    const double n = 200'000.0;
    const MonteCarloSettings settings{.samples = 200'000, .seed = 11, .distribution = Distribution::lognormal};
    const SampleSummary summary = run_monte_carlo(inputs, evaluate_products, settings).results[0];

    // ln x is normal with variance ln(1 + r²) and mean ln(value) - variance/2; x²/√y so too
    const double variance_x = std::log(1.0 + 0.25);
    const double variance_y = std::log(1.0 + 0.09);
    const double mean = 2.0 * (std::log(0.63) - 0.5 * variance_x) - 0.5 * (std::log(0.59) - 0.5 * variance_y);
    const double s = std::sqrt(4.0 * variance_x + 0.25 * variance_y);
    CHECK(std::abs(std::log(summary.median) - mean) <= kSigmas * s * 1.2534 / std::sqrt(n));
    CHECK(std::abs(std::log(summary.lower) - (mean - 1.959964 * s)) <= kSigmas * 2.67 * s / std::sqrt(n));
    CHECK(std::abs(std::log(summary.upper) - (mean + 1.959964 * s)) <= kSigmas * 2.67 * s / std::sqrt(n));
    const double spread = std::sqrt(std::exp(s * s) - 1.0);  // standard deviation over mean
    CHECK(std::abs(summary.mean / std::exp(mean + 0.5 * s * s) - 1.0) <= kSigmas * spread / std::sqrt(n));
    // P(result > 1) = Φ(mean/s)
    const double above = 0.5 * std::erfc(-mean / s / std::sqrt(2.0));
    CHECK(std::abs(summary.share_above_one - above) <= kSigmas * std::sqrt(above * (1.0 - above) / n));
}

TEST_CASE("a seed gives the same bits again, for any number of threads, and another seed gives others") {
    const std::vector<UncertainInput> inputs = make_inputs(0.5, 0.3);
    MonteCarloSettings settings{.samples = 5'000, .seed = 3, .threads = 1};
    const MonteCarloRun one = run_monte_carlo(inputs, evaluate_products, settings);
    CHECK(one.draws.rejected > 0);
    for (const int threads : {2, 3, 0}) {
        settings.threads = threads;
        const MonteCarloRun again = run_monte_carlo(inputs, evaluate_products, settings);
        CHECK(again.draws.rejected == one.draws.rejected);
        for (std::size_t r = 0; r < one.results.size(); ++r) {
            CHECK(std::memcmp(&again.results[r], &one.results[r], sizeof(SampleSummary)) == 0);
        }
    }
    settings.seed = 4;
    CHECK(run_monte_carlo(inputs, evaluate_products, settings).results[0].mean != one.results[0].mean);
}

TEST_CASE("draws that are not positive are counted and drawn again") {
    // P(x <= 0) = Φ(-1/r) at each draw; Φ(-2) = 2.275 % of x, Φ(-10/3) of y is 0.04 %
    const std::vector<UncertainInput> inputs = make_inputs(0.5, 0.3);
    const double n = 100'000.0;
    const MonteCarloRun run = run_monte_carlo(inputs, evaluate_products, {.samples = 100'000, .seed = 5});
    double expected = 0.0;
    for (const double r : {0.5, 0.3}) {
        const double p = 0.5 * std::erfc(1.0 / (r * std::sqrt(2.0)));
        expected += n * p / (1.0 - p);
    }
    CHECK(std::abs(static_cast<double>(run.draws.rejected) - expected) <= kSigmas * std::sqrt(expected));
    // the mean of a normal distribution cut at zero: x + u φ(1/r)/Φ(1/r); here of √x's square, the draws themselves
    const auto identity = [](std::span<const double> v) { return std::vector{v[0]}; };
    const SampleSummary cut = run_monte_carlo({inputs[0]}, identity, {.samples = 100'000, .seed = 5}).results[0];
    const double density = std::exp(-2.0) / std::sqrt(2.0 * 3.14159265358979);
    CHECK(std::abs(cut.mean - 0.63 * (1.0 + 0.5 * density / (1.0 - 0.0227501))) <= kSigmas * 0.315 / std::sqrt(n));
    CHECK(cut.lower > 0.0);
}

TEST_CASE("Monte Carlo without an uncertain input, or with too few or too many samples, is refused") {
    CHECK_THROWS_WITH_AS(run_monte_carlo(make_inputs(0.0, 0.0), evaluate_products, {}),
                         "Monte Carlo: nothing is uncertain (no input has an uncertainty); write one, such as 0.63+/-0.03",
                         SimilitudeError);
    for (const std::size_t samples : {std::size_t{0}, std::size_t{999}, std::size_t{1'000'001}}) {
        CHECK_THROWS_AS(run_monte_carlo(make_inputs(0.1, 0.1), evaluate_products, {.samples = samples}), SimilitudeError);
    }
}

TEST_CASE("what an evaluation throws comes out of the threads") {
    const Evaluation failing = [](std::span<const double> v) -> std::vector<double> {
        if (v[0] > 0.7) throw SimilitudeError("too large");
        return {v[0]};
    };
    CHECK_THROWS_WITH_AS(run_monte_carlo(make_inputs(0.1, 0.1), failing, {}), "too large", SimilitudeError);
}

}  // namespace musim::scaling::tests
