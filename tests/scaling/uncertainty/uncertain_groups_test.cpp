#include "scaling/uncertainty/uncertain_groups.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <numbers>

#include "scaling/pi/pi_problem.hpp"
#include "tests/scaling/expected.hpp"
#include "tests/support/relative.hpp"

namespace musim::scaling::tests {

using lsdem::tests::relative;

namespace {

/// The square of the mu number, with velocity and friction coefficient known to some percent.
std::vector<PiQuantity> read_problem() {
    return parse_pi_problem(R"({"quantities": [{"name": "v", "unit": "cm/s", "value": "42.4 +/- 10%"},
        {"name": "mu", "unit": "1", "value": "0.59 +/- 0.0295"}, {"name": "g", "unit": "gn", "value": 1},
        {"name": "l", "unit": "m", "value": "161.5"}, {"name": "b", "unit": "m"}]})",
                            "p.json");
}

const PiGroup kSlip{2, -1, -1, -1, 0};
const PiGroup kNoValue{0, 0, 0, 1, -1};

}  // namespace

TEST_CASE("a value's uncertainty stands in its unit, and changes nothing of the value") {
    const std::vector<PiQuantity> quantities = read_problem();
    CHECK(*quantities[0].value == 0.424);
    CHECK_EXPECTED(quantities[0].uncertainty, 0.0424);
    CHECK_EXPECTED(quantities[1].uncertainty, 0.0295);
    CHECK(quantities[3].uncertainty == 0.0);
    REQUIRE(list_uncertain(quantities).size() == 2);
    CHECK(list_uncertain(quantities)[1].name == "mu");
}

TEST_CASE("a group's relative variance is the sum of those of its quantities times their exponents squared") {
    const std::vector<PiQuantity> quantities = read_problem();
    const auto slip = find_uncertain_value(kSlip, quantities);
    REQUIRE(slip.has_value());
    CHECK(slip->value == *group_value(kSlip, quantities));
    CHECK_EXPECTED(slip->relative, std::hypot(2.0 * 0.1, 0.05));
    CHECK(slip->exponents == std::vector{2.0, -1.0});
    CHECK_FALSE(find_uncertain_value(kNoValue, quantities).has_value());
}

TEST_CASE("samples of a group with lognormal quantities are lognormal") {
    const MonteCarloSettings settings{.samples = 20'000, .seed = 2, .distribution = Distribution::lognormal};
    const std::vector<PiQuantity> quantities = read_problem();
    const SampledGroups sampled = draw_groups({kSlip, kNoValue}, quantities, settings);
    CHECK(sampled.groups.size() == 1);
    const SampleSummary& slip = sampled.groups.at(kSlip);
    // ln v and ln μ are normal with variances ln(1 + r²), medians value/√(1 + r²)
    const double v2 = std::log1p(0.1 * 0.1), mu2 = std::log1p(0.05 * 0.05);
    const double sigma = std::sqrt(4.0 * v2 + mu2), median = *group_value(kSlip, quantities) * std::exp(-v2 + 0.5 * mu2);
    // standard errors of quantiles p: √(p (1 − p)/N) over the density there, four of them
    const double root = std::sqrt(static_cast<double>(settings.samples));
    CHECK(std::abs(std::log(slip.median / median)) < 4.0 * sigma * std::sqrt(0.5 * std::numbers::pi) / root);
    const double tail = 4.0 * sigma * std::sqrt(0.025 * 0.975) / (0.05845 * root);
    CHECK(std::abs(std::log(slip.lower / median) + 1.959964 * sigma) < tail);
    CHECK(std::abs(std::log(slip.upper / median) - 1.959964 * sigma) < tail);
    // the mean of a lognormal distribution, with its own standard error
    const double mean = median * std::exp(0.5 * sigma * sigma);
    CHECK(std::abs(slip.mean - mean) < 4.0 * mean * std::sqrt(std::expm1(sigma * sigma)) / root);
}

TEST_CASE("samples of groups are the same bits for one seed, whatever the threads, and need something uncertain") {
    const std::vector<PiQuantity> quantities = read_problem();
    const auto upper = [&](std::uint64_t seed, int threads) {
        return draw_groups({kSlip}, quantities, {.samples = 3'000, .seed = seed, .threads = threads}).groups.at(kSlip).upper;
    };
    CHECK(upper(1, 1) == upper(1, 3));
    CHECK(upper(1, 1) != upper(2, 1));
    std::vector<PiQuantity> certain = quantities;
    for (PiQuantity& quantity : certain) quantity.uncertainty = 0.0;
    CHECK(find_uncertain_value(kSlip, certain)->relative == 0.0);
    CHECK_THROWS_AS(draw_groups({kSlip}, certain, {}), SimilitudeError);
}

}  // namespace musim::scaling::tests
