#include <doctest/doctest.h>

#include <algorithm>
#include <numeric>
#include <random>
#include <set>

#include "scaling/detail/integer_matrix.hpp"
#include "scaling/pi/pi_express.hpp"
#include "scaling/pi/pi_remarks.hpp"
#include "tests/scaling/pi_problems.hpp"
#include "tests/scaling/random_problem.hpp"

namespace musim::scaling::tests {

namespace {

constexpr int kRandomProblems = 250;

template <class Check>
void for_random_problems(const Check& check) {
    std::mt19937_64 random(20240601);
    for (int i = 0; i < kRandomProblems; ++i) {
        CAPTURE(i);
        check(make_random_problem(random, 1 + random() % 12), random);
    }
}

std::size_t rank_of(const std::vector<PiGroup>& groups, std::size_t count) {
    detail::IntegerMatrix matrix;
    for (const PiGroup& group : groups) matrix.emplace_back(group.begin(), group.end());
    return detail::eliminate(std::move(matrix), count).rank();
}

/// Groups as sets of (name, exponent), whatever the order of quantities and groups.
std::set<std::set<std::pair<std::string, std::int64_t>>> by_names(const PiBasis& basis, const std::vector<PiQuantity>& quantities) {
    std::set<std::set<std::pair<std::string, std::int64_t>>> result;
    for (const PiGroup& group : basis.groups) {
        std::set<std::pair<std::string, std::int64_t>> one;
        for (std::size_t j = 0; j < quantities.size(); ++j) {
            if (group[j] != 0) one.emplace(quantities[j].name, group[j]);
        }
        result.insert(one);
    }
    return result;
}

std::vector<std::string> names_of(const std::vector<PiQuantity>& quantities, const std::vector<std::size_t>& positions) {
    std::vector<std::string> names;
    for (const std::size_t j : positions) names.push_back(quantities[j].name);
    return names;
}

}  // namespace

TEST_CASE("groups of random problems are dimensionless, n - rank, independent, in lowest terms, positive in what does not repeat") {
    for_random_problems([](const std::vector<PiQuantity>& quantities, std::mt19937_64&) {
        const PiBasis basis = find_pi_basis(quantities);
        REQUIRE(basis.groups.size() == quantities.size() - basis.rank());
        CHECK(rank_of(basis.groups, quantities.size()) == basis.groups.size());
        for (const PiGroup& group : basis.groups) {
            RationalDimension dimension;
            std::int64_t divisor = 0;
            int not_repeating = 0;
            for (std::size_t j = 0; j < quantities.size(); ++j) {
                dimension = dimension * pow(quantities[j].dimension, group[j]);
                divisor = std::gcd(divisor, group[j]);
                if (std::find(basis.repeating.begin(), basis.repeating.end(), j) != basis.repeating.end() || group[j] == 0) continue;
                ++not_repeating;
                CHECK(group[j] > 0);
            }
            CHECK(dimension.is_dimensionless());
            CHECK(divisor == 1);
            CHECK(not_repeating == 1);
        }
        // what no group holds is explained, nothing else
        for (const UnusedQuantity& unused : explain_unused(quantities, basis)) {
            for (const PiGroup& group : basis.groups) CHECK(group[unused.quantity] == 0);
            CHECK(unused.why.find("carries") != std::string::npos);
        }
    });
}

TEST_CASE("groups of random problems do not depend on the order of the quantities when the repeating ones are named") {
    for_random_problems([](const std::vector<PiQuantity>& quantities, std::mt19937_64& random) {
        const PiBasis basis = find_pi_basis(quantities);
        std::vector<PiQuantity> shuffled = quantities;
        std::shuffle(shuffled.begin(), shuffled.end(), random);
        const auto repeating = names_of(quantities, basis.repeating);
        CHECK(by_names(find_pi_basis(shuffled, repeating), shuffled) == by_names(basis, quantities));
    });
}

TEST_CASE("groups of random problems do not depend on the base dimensions") {
    for_random_problems([](const std::vector<PiQuantity>& quantities, std::mt19937_64&) {
        // force, length, time for mass, length, time: M = F T^2 L^-1
        std::vector<PiQuantity> other = quantities;
        for (PiQuantity& quantity : other) {
            const Rational mass = quantity.dimension[BaseDimension::mass];
            quantity.dimension[BaseDimension::time] = quantity.dimension[BaseDimension::time] + mass * 2;
            quantity.dimension[BaseDimension::length] = quantity.dimension[BaseDimension::length] - mass;
        }
        const PiBasis basis = find_pi_basis(quantities);
        const PiBasis other_basis = find_pi_basis(other);
        CHECK(basis.repeating == other_basis.repeating);
        CHECK(basis.groups == other_basis.groups);
    });
}

TEST_CASE("each basis of a random problem expresses the groups of the others, and gives them back") {
    for_random_problems([](const std::vector<PiQuantity>& quantities, std::mt19937_64&) {
        const PiBases all = find_all_pi_bases(quantities, 4);
        for (const PiBasis& basis : all.bases) {
            for (const PiGroup& group : all.bases.front().groups) {
                const std::vector<Rational> wanted(group.begin(), group.end());
                const std::vector<Rational> powers = express(wanted, basis.groups, quantities);
                for (std::size_t j = 0; j < quantities.size(); ++j) {
                    Rational sum;
                    for (std::size_t k = 0; k < powers.size(); ++k) sum = sum + powers[k] * basis.groups[k][j];
                    CHECK(sum == wanted[j]);
                }
            }
        }
    });
}

TEST_CASE("forty quantities are solved exactly") {
    std::mt19937_64 random(7);
    const auto quantities = make_random_problem(random, 40);
    const PiBasis basis = find_pi_basis(quantities);
    CHECK(basis.groups.size() == 40 - basis.rank());
    CHECK(rank_of(basis.groups, 40) == basis.groups.size());
    for (const PiGroup& group : basis.groups) {
        RationalDimension dimension;
        for (std::size_t j = 0; j < quantities.size(); ++j) dimension = dimension * pow(quantities[j].dimension, group[j]);
        CHECK(dimension.is_dimensionless());
    }
}

}  // namespace musim::scaling::tests
