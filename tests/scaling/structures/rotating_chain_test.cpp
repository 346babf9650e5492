#include "scaling/structures/rotating_chain.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <Eigen/Dense>
#include <numbers>
#include <vector>

#include "tests/scaling/expected.hpp"

namespace musim::scaling::tests {

namespace {

using std::numbers::pi;

struct ChainCase {
    double slenderness, stiffness_ratio;
};
const std::vector<ChainCase> kCases = {{0.32, 1.05}, {0.6635, 1.154}, {0.05, 10.0}, {3.0, 0.1}, {20.0, 2.6}};

/// Angular frequencies of a ring of `count` blocks, spring by spring, m = k_s = H = 1.
std::vector<double> find_ring_frequencies(const RotatingChain& chain, Eigen::Index count) {
    const double inertia = (1.0 + chain.slenderness * chain.slenderness) / 12.0;
    Eigen::MatrixXd stiffness = Eigen::MatrixXd::Zero(2 * count, 2 * count);
    for (Eigen::Index lower = 0; lower < count; ++lower) {
        const Eigen::Index upper = (lower + 1) % count;
        Eigen::VectorXd shear = Eigen::VectorXd::Zero(2 * count), turn = Eigen::VectorXd::Zero(2 * count);
        // slip of the face between two blocks: shifts, and half a height times both rotations
        shear[upper] += 1.0;
        shear[lower] -= 1.0;
        shear[count + upper] -= 0.5;
        shear[count + lower] -= 0.5;
        turn[count + upper] += 1.0;
        turn[count + lower] -= 1.0;
        const double bed = chain.stiffness_ratio * chain.slenderness * chain.slenderness / 12.0;
        stiffness += shear * shear.transpose() + bed * turn * turn.transpose();
    }
    Eigen::VectorXd root_mass = Eigen::VectorXd::Ones(2 * count);
    root_mass.tail(count).setConstant(std::sqrt(inertia));
    const Eigen::MatrixXd scaled = root_mass.cwiseInverse().asDiagonal() * stiffness * root_mass.cwiseInverse().asDiagonal();
    const Eigen::VectorXd squared = Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(scaled).eigenvalues();
    std::vector<double> frequencies;
    for (const double value : squared) frequencies.push_back(std::sqrt(std::max(0.0, value)));
    return frequencies;
}

}  // namespace

TEST_CASE("both branches are the frequencies of a ring of blocks assembled spring by spring") {
    constexpr int kBlocks = 24;
    for (const auto& [slenderness, stiffness_ratio] : kCases) {
        const RotatingChain chain{slenderness, stiffness_ratio};
        // waves that close in the ring; at q = 0 the ring shifts freely and turns at √(12/(1 + (b/H)²))
        std::vector<double> expected{0.0, std::sqrt(12.0 / (1.0 + slenderness * slenderness))};
        for (int j = 1; j < kBlocks; ++j) {
            const auto branches = chain.frequencies(2.0 * pi * std::min(j, kBlocks - j) / kBlocks);
            expected.insert(expected.end(), branches.begin(), branches.end());
        }
        std::sort(expected.begin(), expected.end());
        const std::vector<double> measured = find_ring_frequencies(chain, kBlocks);
        // an eigenvalue is off by 1e-16 of the largest times the size 48: ω² by 1e-14 of its largest
        const double tolerance = 1e-14 * expected.back() * expected.back();
        REQUIRE(measured.size() == expected.size());
        for (std::size_t i = 0; i < expected.size(); ++i) {
            CHECK(std::abs(measured[i] * measured[i] - expected[i] * expected[i]) <= tolerance);
        }
    }
}

TEST_CASE("long waves bend as a beam of modulus k_n H/A, short ones shear and turn apart") {
    for (const auto& [slenderness, stiffness_ratio] : kCases) {
        const RotatingChain chain{slenderness, stiffness_ratio};
        // ω = q² √(E I/(ρ A))/H², with E I/(ρ A) = k_n H² b²/(12 m); next terms are of order q² and q² b² k_n/k_s
        const double q = 1e-4;
        const double beam = q * q * slenderness * std::sqrt(stiffness_ratio / 12.0);
        CHECK(chain.frequencies(q)[0] / beam == doctest::Approx(1.0).epsilon(q * q * (1.0 + stiffness_ratio * slenderness * slenderness)));
        // group speed dω/dq = 2 ω/q there
        CHECK(chain.group_speed(q) / (2.0 * chain.frequencies(q)[0] / q) ==
              doctest::Approx(1.0).epsilon(q * q * (1.0 + stiffness_ratio * slenderness * slenderness)));
        // q = π: 2 √(k_s/m), and 2 √(k_n b²/(m (b² + H²)))
        std::array<double, 2> apart{2.0, 2.0 * slenderness * std::sqrt(stiffness_ratio / (1.0 + slenderness * slenderness))};
        std::sort(apart.begin(), apart.end());
        const auto branches = chain.frequencies(pi);
        CHECK_EXPECTED(branches[0], apart[0]);
        CHECK_EXPECTED(branches[1], apart[1]);
    }
}

TEST_CASE("blocks too wide to turn leave the shear chain: 2 sin(q/2), speed c_e") {
    // rotation yields by k_s H²/(k_n b²) over q²: 1e-10 of the shear here
    const RotatingChain chain{1e6, 1.5};
    for (const double q : {0.1, 1.0, 3.0}) {
        CHECK(chain.frequencies(q)[0] == doctest::Approx(2.0 * std::sin(0.5 * q)).epsilon(1e-8));
        CHECK(chain.group_speed(q) == doctest::Approx(std::cos(0.5 * q)).epsilon(1e-8));
    }
}

TEST_CASE("group speed is the slope of the lower branch") {
    for (const auto& [slenderness, stiffness_ratio] : kCases) {
        const RotatingChain chain{slenderness, stiffness_ratio};
        for (const double q : {0.3, 1.1, 2.5}) {
            const double step = 1e-4;
            const double slope = (chain.frequencies(q + step)[0] - chain.frequencies(q - step)[0]) / (2.0 * step);
            // central difference: step² = 1e-8 of the third derivative, of order one to a hundred
            CHECK(std::abs(chain.group_speed(q) - slope) < 1e-6);
        }
    }
}

TEST_CASE("the fastest sway is that of a scan sixteen times as fine") {
    for (const double slenderness : {0.05, 0.32, 0.6635, 1.0, 5.0, 20.0}) {
        for (const double stiffness_ratio : {0.1, 1.05, 1.154, 10.0}) {
            const RotatingChain chain{slenderness, stiffness_ratio};
            const ChainWave fastest = find_fastest_sway(chain);
            CHECK(fastest.speed == chain.group_speed(fastest.wavenumber));
            double largest = 0.0;
            for (int i = 1; i <= 16 * kWavenumbers; ++i) {
                largest = std::max(largest, chain.group_speed(i * pi / (16 * kWavenumbers + 1)));
            }
            CHECK(fastest.speed >= largest * (1.0 - 1e-9));
            // a step of 4e-4 in q misses a smooth maximum by its square times a curvature of order one
            CHECK(fastest.speed <= largest * (1.0 + 1e-5));
        }
    }
}

}  // namespace musim::scaling::tests
