#include "scaling/uncertainty/uncertain_reading.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <vector>

#include "scaling/uncertainty/propagate.hpp"
#include "tests/scaling/expected.hpp"
#include "tests/support/relative.hpp"

namespace musim::scaling::tests {

using lsdem::tests::relative;

namespace {

/// Results of a file with x = 4 +/- 5 %, y = 3 +/- 2 %, z = 2: x²/√y, x + y, 1 − x/8·y, z, 0.
std::vector<double> read_file(UncertainReading& reading) {
    const double x = reading.take("f.json: side: x", {4.0, 0.2});
    const double y = reading.take("f.json: y", {3.0, 0.06});
    const double z = reading.take("f.json: z", {2.0, 0.0});
    return {x * x / std::sqrt(y), x + y, 1.0 - x * y / 8.0, z, 0.0};
}

std::vector<FirstOrder> propagate_file(UncertainReading& reading) {
    const std::vector<double> results = read_file(reading);
    std::vector<MovedResults> moved;
    for (const auto& each : read_moved(reading, read_file)) moved.push_back({each.below, each.above});
    return find_first_order(results, reading.inputs(), moved);
}

}  // namespace

TEST_CASE("a file read again with one value moved shows exponents of products exactly, slopes of others") {
    UncertainReading reading("f.json");
    const std::vector<FirstOrder> results = propagate_file(reading);
    REQUIRE(reading.inputs().size() == 2);
    CHECK(reading.inputs()[0].name == "side: x");
    CHECK(results[0].exponents == std::vector{2.0, -0.5});
    CHECK_EXPECTED(results[0].relative, std::hypot(2.0 * 0.05, 0.5 * 0.02));
    // central differences in ln x: ln(x e^h + y) has an error below h²/6 of a third derivative below 1, h = 2^-10
    CHECK(std::abs(results[1].exponents[0] - 4.0 / 7.0) < 0x1p-20);
    CHECK(std::abs(results[1].exponents[1] - 3.0 / 7.0) < 0x1p-20);
    // a negative result: −1/2, of which each input moves −3/2 by its own share, so that u = 1.5 hypot(5 %, 2 %)
    CHECK(results[2].value == -0.5);
    CHECK(results[2].uncertainty() == relative(1.5 * std::hypot(0.05, 0.02), 1e-5));
    CHECK(results[3].relative == 0.0);
    CHECK(results[4].relative == 0.0);
    CHECK_FALSE(reading.is_moved());
}

TEST_CASE("a value read twice at one place is one input, another of its name is one more") {
    UncertainReading reading("f.json");
    reading.take("f.json: set: a", {2.0, 0.1});
    reading.take("f.json: set: a", {2.0, 0.1});
    reading.take("f.json: set: a", {3.0, 0.1});
    reading.take("table.json: axes 1: payload", {5.0, 0.1});
    REQUIRE(reading.inputs().size() == 3);
    CHECK(reading.inputs()[1].name == "set: a (2)");
    CHECK(reading.inputs()[2].name == "table.json: axes 1: payload");
    UncertainReading moved = reading.move(1, 2.0);
    CHECK(moved.is_moved());
    CHECK(moved.take("f.json: set: a", {2.0, 0.1}) == 2.0);
    CHECK(moved.take("f.json: set: a", {3.0, 0.1}) == 6.0);
    CHECK(moved.moved_input()->name == "set: a (2)");
}

TEST_CASE("a drawn reading takes every input at its drawn value, and names the file when that cannot be") {
    UncertainReading reading("f.json");
    const auto read = [](UncertainReading& each) {
        const double x = each.take("f.json: x", {2.0, 0.1}), y = each.take("f.json: y", {3.0, 0.1});
        if (y < x) throw SimilitudeError("y is below x");
        return y - x + each.take("f.json: z", {10.0, 0.0});
    };
    CHECK(read(reading) == 11.0);
    CHECK(read_drawn(reading, std::vector{1.0, 5.0}, read) == 14.0);
    CHECK(reading.draw(std::vector{1.0, 5.0}).is_moved());
    CHECK(reading.draw(std::vector{1.0, 5.0}).moved_input() == nullptr);
    CHECK_THROWS_WITH_AS(read_drawn(reading, std::vector{4.0, 3.0}, read),
                         "f.json: a sample of the uncertain values is refused (y is below x); give smaller uncertainties, or choose "
                         "another distribution",
                         SimilitudeError);
}

TEST_CASE("the interval of a quotient is that of its inverse upside down, near the value 1.96 u to either side") {
    const CoverageInterval interval = find_interval({.value = 0.25, .relative = 0.1});
    const CoverageInterval inverse = find_interval({.value = 4.0, .relative = 0.1});
    CHECK_EXPECTED(interval.lower, 1.0 / inverse.upper);
    CHECK_EXPECTED(interval.upper, 1.0 / inverse.lower);
    CHECK(std::log(inverse.upper / 4.0) == relative(0.1959964, 1e-7));  // z of 97.5 %, [Wichura88]
    CHECK(interval.contains(0.25));
    CHECK_FALSE(interval.contains(0.31));
    const CoverageInterval negative = find_interval({.value = -0.5, .relative = 0.1});
    CHECK(negative.lower < -0.5);
    CHECK(negative.upper > -0.5);
}

}  // namespace musim::scaling::tests
