#include "scaling/laws/length_range.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>

#include "tests/support/relative.hpp"

using namespace musim::scaling;
using musim::lsdem::tests::relative;

namespace {

constexpr LengthRange kAll{1.0 / 16384.0, 1.0};

/// A pow, a product and the last bisection: a few roundings.
constexpr double kRounding = 8.0 * std::numeric_limits<double>::epsilon();

}  // namespace

TEST_CASE("the range of a power of the length scale ends at its root") {
    for (const double power : {0.5, 1.0, 2.0, 3.0}) {
        CAPTURE(power);
        const auto up_to = find_length_range([&](double length) { return 7.0 * std::pow(length, power); }, kAll);
        REQUIRE(up_to.size() == 1);
        const double root = std::pow(7.0, -1.0 / power);
        CHECK(up_to.front().smallest == kAll.smallest);
        CHECK(up_to.front().largest == relative(root, kRounding));
        const auto from = find_length_range([&](double length) { return std::pow(length, -power) / 7.0; }, kAll);
        REQUIRE(from.size() == 1);
        CHECK(from.front().smallest == relative(root, kRounding));
        CHECK(from.front().largest == 1.0);
    }
}

TEST_CASE("an end is the last length scale that fits, to the last bit") {
    const ShareUsed used = [](double length) { return 3.0 * length; };
    const double end = find_length_range(used, kAll).at(0).largest;
    CHECK(used(end) <= 1.0);
    CHECK(used(std::nextafter(end, 1.0)) > 1.0);
}

TEST_CASE("a limit that always or never holds leaves all or nothing") {
    CHECK(find_length_range([](double length) { return length; }, kAll) == std::vector{kAll});
    CHECK(find_length_range([](double length) { return 2.0 / length; }, kAll).empty());
}

TEST_CASE("ranges have in common what lies in both, single points included") {
    CHECK(intersect({{0.1, 0.2}, {0.4, 0.8}}, {{0.15, 0.5}}) == std::vector<LengthRange>{{0.15, 0.2}, {0.4, 0.5}});
    CHECK(intersect({{0.1, 0.2}}, {{0.2, 0.3}}) == std::vector<LengthRange>{{0.2, 0.2}});
    CHECK(intersect({{0.1, 0.2}}, {{0.3, 0.4}}).empty());
    CHECK(intersect({}, {kAll}).empty());
}
