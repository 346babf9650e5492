#include "lsdem/study/compare_specimens.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "lsdem/results/read_results.hpp"

using namespace musim::lsdem;

namespace {

/// Specimens of seven layers whose mean tilt is `tilt` in layer 1 and grows by `step` a layer, one seed after another.
SpecimenSet make_set(const std::string& name, std::uint64_t first_seed, const std::vector<double>& tilts, double step, int layers = 7) {
    SpecimenSet set{.name = name, .specimens = {}};
    for (const double tilt : tilts) {
        ListedSpecimen specimen{.seed = first_seed++, .fallen = 1, .block_steps = 1e3, .layers = {}};
        for (int k = 0; k < layers; ++k) {
            specimen.layers.push_back({.mean_tilt = tilt + k * step, .max_tilt = 2.0 * tilt, .sd_force = tilt});
        }
        set.specimens.push_back(specimen);
    }
    return set;
}

/// Number of pairs, of 400 of samples of 8 and 10 normal numbers with these standard deviations, that have such a probability below 0.05.
int count_unlikely(double first_sd, double second_sd, double TwoSamples::*probability) {
    std::mt19937 bits(7);
    std::normal_distribution<double> first(0.0, first_sd), second(0.0, second_sd);
    int unlikely = 0;
    for (int trial = 0; trial < 400; ++trial) {
        std::vector<double> one, two;
        for (int i = 0; i < 8; ++i) one.push_back(first(bits));
        for (int i = 0; i < 10; ++i) two.push_back(second(bits));
        unlikely += compare_samples(one, two).*probability < 0.05 ? 1 : 0;
    }
    return unlikely;
}

}  // namespace

TEST_CASE("two samples: Welch's probability in closed form, and none where there is too little") {
    // Student's t with two degrees of freedom: P(|T| > t) = 1 - t/sqrt(2 + t^2); here t^2 = 8
    const TwoSamples apart = compare_samples({0.0, 2.0}, {6.0, 4.0});
    CHECK(apart.first_mean == 1.0);
    CHECK(apart.second_mean == 5.0);
    CHECK(apart.first_sd == doctest::Approx(std::sqrt(2.0)).epsilon(1e-15));
    CHECK(apart.mean_probability == doctest::Approx(1.0 - std::sqrt(0.8)).epsilon(1e-12));
    CHECK(apart.scatter_probability == 1.0);
    // distances from the medians {1, 0, 1} and {4, 0, 4}: t^2 = 4 / (17/9) and 2.2491 degrees of freedom
    const TwoSamples wider = compare_samples({-1.0, 0.0, 1.0}, {-4.0, 0.0, 4.0});
    CHECK(wider.mean_probability == doctest::Approx(1.0).epsilon(1e-12));
    CHECK(wider.scatter_probability > 0.2);
    CHECK(wider.scatter_probability < 0.3);
    const TwoSamples few = compare_samples({1.0}, {2.0, 3.0});
    CHECK(std::isnan(few.first_sd));
    CHECK(std::isnan(few.mean_probability));
    CHECK(std::isnan(compare_samples({}, {1.0}).first_mean));
    CHECK(compare_samples({1.0, 1.0}, {2.0, 2.0}).mean_probability == 0.0);
}

TEST_CASE("two samples of one population are unlikely once in twenty, of others more often") {
    // 400 trials: 20 expected, standard deviation 4.4; Brown and Forsythe's is too careful with few members
    const int means = count_unlikely(1.0, 1.0, &TwoSamples::mean_probability);
    CHECK(means >= 9);
    CHECK(means <= 31);
    const int scatter = count_unlikely(1.0, 1.0, &TwoSamples::scatter_probability);
    CHECK(scatter >= 4);
    CHECK(scatter <= 31);
    // means stay trustworthy when the scatter differs, and the scatter of four times as much is seen
    const int unequal = count_unlikely(1.0, 4.0, &TwoSamples::mean_probability);
    CHECK(unequal >= 9);
    CHECK(unequal <= 31);
    CHECK(count_unlikely(1.0, 4.0, &TwoSamples::scatter_probability) > 300);
}

TEST_CASE("specimens are compared by groups of layers, the same seeds as pairs") {
    const SpecimenSet first = make_set("first", 1, {0.1, 0.2, 0.4}, 0.01), second = make_set("second", 2, {0.25, 0.45}, 0.01);
    const std::vector<LayerComparison> compared = compare_specimens(first, second);
    REQUIRE(compared.size() == 2);
    CHECK(compared[0].first == 2);
    CHECK(compared[0].last == 4);
    CHECK(compared[1].first == 5);
    CHECK(compared[1].last == 7);
    CHECK(compared[0].tilt.samples.second_mean == doctest::Approx(0.35 + 0.02));
    CHECK(compared[1].tilt.samples.second_mean == doctest::Approx(0.35 + 0.05));
    CHECK(compared[1].largest_tilt.samples.second_mean == doctest::Approx(0.7));
    CHECK(compared[1].force_scatter.samples.first_mean == doctest::Approx(0.7 / 3.0));
    CHECK(compared[0].tilt.pairs == 2);
    CHECK(compared[0].tilt.pair_difference == doctest::Approx(0.05));
    CHECK(compared[0].tilt.pair_error == doctest::Approx(0.0));
    CHECK(second.fallen() == 2);
    CHECK(second.block_steps() == 1e3);
    CHECK(compare_specimens(make_set("one", 1, {0.1}, 0.0, 1), make_set("other", 5, {0.1}, 0.0, 1)).front().last == 1);
    CHECK_THROWS_AS(compare_specimens(first, make_set("low", 1, {0.1}, 0.0, 6)), ResultError);
}
