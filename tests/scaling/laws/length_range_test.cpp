#include "scaling/laws/length_range.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>

#include "tests/support/relative.hpp"

using namespace musim::scaling;
using musim::lsdem::tests::relative;

namespace {

constexpr LengthRange kAll{1.0 / 16384.0, 1.0};

/// A pow, a product and the search: a few roundings.
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

TEST_CASE("a share that rises and falls leaves several ranges, whose ends are its roots") {
    // |ln(8 λ_l)| ≤ 1 and ≥ 1: one range about 1/8, and what lies on both sides of it
    const auto distance = [](double length) { return std::abs(std::log(8.0 * length)); };
    const auto about = find_length_ranges(distance, kAll);
    REQUIRE(about.size() == 1);
    CHECK(about[0].smallest == relative(std::exp(-1.0) / 8.0, kRounding));
    CHECK(about[0].largest == relative(std::exp(1.0) / 8.0, kRounding));
    const auto beside = find_length_ranges([&](double length) { return 1.0 / distance(length); }, kAll);
    REQUIRE(beside.size() == 2);
    CHECK(beside[0].smallest == kAll.smallest);
    CHECK(beside[0].largest == relative(std::exp(-1.0) / 8.0, kRounding));
    CHECK(beside[1].smallest == relative(std::exp(1.0) / 8.0, kRounding));
    CHECK(beside[1].largest == 1.0);
}

TEST_CASE("a range is found by a few evaluations of its share") {
    int evaluations = 0;
    const ShareUsed used = [&](double length) {
        ++evaluations;
        return 7.0 * length * length * length;
    };
    find_length_range(used, kAll);
    CHECK(evaluations < 30);  // bisection to neighbouring doubles needs 53
}

TEST_CASE("limits leave a range narrower than any step, between the two that bind") {
    const auto ranges = find_common({{{0.1, 0.2}, {0.4, 0.5}}, {kAll}, {{0.1999, 0.45}}}, kAll);
    REQUIRE(ranges.size() == 2);
    CHECK(ranges[0].scales == LengthRange{0.1999, 0.2});
    CHECK(ranges[0].binds_below == 2);
    CHECK(ranges[0].binds_above == 0);
    CHECK(ranges[1].scales == LengthRange{0.4, 0.45});
    CHECK(find_common({}, kAll).at(0).scales == kAll);
    CHECK_FALSE(find_common({}, kAll).at(0).binds_below);
}

TEST_CASE("a limit that always or never holds leaves all or nothing") {
    CHECK(find_length_range([](double length) { return length; }, kAll) == std::vector{kAll});
    CHECK(find_length_range([](double length) { return 2.0 / length; }, kAll).empty());
    CHECK(find_length_range([](double) { return 0.0; }, kAll) == std::vector{kAll});
    CHECK(find_length_range([](double) { return std::numeric_limits<double>::quiet_NaN(); }, kAll).empty());
}

TEST_CASE("ranges have in common what lies in both, single points included") {
    CHECK(intersect({{0.1, 0.2}, {0.4, 0.8}}, {{0.15, 0.5}}) == std::vector<LengthRange>{{0.15, 0.2}, {0.4, 0.5}});
    CHECK(intersect({{0.1, 0.2}}, {{0.2, 0.3}}) == std::vector<LengthRange>{{0.2, 0.2}});
    CHECK(intersect({{0.1, 0.2}}, {{0.3, 0.4}}).empty());
    CHECK(intersect({}, {kAll}).empty());
}
