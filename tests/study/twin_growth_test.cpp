#include "lsdem/study/twin_growth.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "lsdem/study/twin_files.hpp"
#include "tests/support/relative.hpp"

using namespace musim::lsdem;
using musim::lsdem::tests::relative;

namespace {

constexpr std::size_t kSamples = 101;

/// A prototype of peak 2 m/s and blocks 4.25 m high, sampled at 100 Hz: a window is one sample.
TwinStudy make_study() {
    return {
        .name = "made, by hand",
        .prototype =
            {.moving_blocks = 3, .height = 4.25, .gravity = 9.80665, .interval = 0.01, .samples = kSamples, .peak = 2.0, .rounding = 2e-13},
        .twins = {}};
}

/// Parts as 1e-14·10^(rate t) of the peak; wobbles below that in between.
TwinRun make_twin(double rate, TwinChoice choice = {.length = 2.0}, double start = 1e-14) {
    TwinRun twin{.choice = choice, .difference = {}};
    for (std::size_t k = 0; k < kSamples; ++k) {
        const double t = 0.01 * static_cast<double>(k);
        twin.difference.push_back(2.0 * start * std::pow(10.0, rate * t) * (k % 3 == 2 ? 0.1 : 1.0));
    }
    return twin;
}

}  // namespace

TEST_CASE("a twin that parts smoothly has its rate, its parting time, and grows by no more than the rate in a window") {
    TwinStudy study = make_study();
    study.twins = {make_twin(12.0)};
    CHECK(study.prototype.window() == 1);
    const TwinGrowth growth = find_growth(study.prototype, study.twins[0]);
    CHECK(std::is_sorted(growth.running.begin(), growth.running.end()));
    CHECK(growth.running[100] == relative(1e-2, 1e-12));
    // one of three samples adds nothing: the next has the growth of two
    CHECK(growth.growth.factor == relative(std::pow(10.0, 0.24), 1e-9));
    // 1e-14·10^(12 t) > 1e-3 after 11/12 s; sample 92 is one of those that wobble below
    REQUIRE(growth.parting_time.has_value());
    CHECK(*growth.parting_time == relative(0.93, 1e-12));
}

TEST_CASE("a jump is found where it is, as large as it is below the parting level") {
    TwinStudy study = make_study();
    TwinRun twin = make_twin(5.0, {.length = 2.0}, 1e-12);
    for (std::size_t k = 61; k < kSamples; ++k) twin.difference[k] *= 100.0;
    study.twins = {twin};
    const Growth growth = find_growth(study.prototype, twin).growth;
    CHECK(growth.time == relative(0.61, 1e-12));
    CHECK(growth.factor > 100.0);
    CHECK(growth.factor < 120.0);

    // beyond the level it is not followed
    for (std::size_t k = 61; k < kSamples; ++k) twin.difference[k] = 2.0;
    const Growth over = find_growth(study.prototype, twin).growth;
    CHECK(over.factor == relative(1e-3 / over.from, 1e-12));

    // what is below rounding is no jump
    TwinRun silent{.choice = {}, .difference = std::vector<double>(kSamples, 0.0)};
    silent.difference[50] = 2e-13;
    CHECK(find_growth(study.prototype, silent).growth.factor == 1.0);
}

TEST_CASE("growth is measured over 0.015 of the root of height over gravity, whatever the samples") {
    TwinStudy study = make_study();
    study.prototype.interval = 0.002;
    CHECK(study.prototype.window() == 5);
    study.prototype.interval = 0.1;
    CHECK(study.prototype.window() == 1);
    study.prototype.gravity = 0.0;
    CHECK(study.prototype.window() == 1);
}

TEST_CASE("the earliest twin gives the horizon, and logarithms their mean and deviation before it") {
    TwinStudy study = make_study();
    // R at 0.9 of 0.8 s
    study.twins = {make_twin(10.0), make_twin(12.0), make_twin(14.0)};
    const TwinSummary summary = summarize(study);
    // 11/14 s, at the next sample that does not wobble below
    CHECK(summary.horizon == relative(0.79, 1e-12));
    CHECK(summary.at_horizon.time == relative(0.71, 1e-12));
    CHECK(summary.at_horizon.count == 3);
    // sample 71 wobbles: R is that of 0.70 s
    CHECK(summary.at_horizon.mean == relative(-14.0 + 12.0 * 0.70, 1e-9));
    CHECK(summary.at_horizon.sd == relative(2.0 * 0.70, 1e-9));
    CHECK(summary.fastest == 2);

    // one that never differs has no logarithm, and none never parts
    TwinRun same{.choice = {.length = 4.0}, .difference = std::vector<double>(kSamples, 0.0)};
    study.twins = {make_twin(2.0), same};
    const TwinSummary calm = summarize(study);
    CHECK(calm.horizon == relative(1.0, 1e-12));
    CHECK(calm.at_horizon.count == 1);
    CHECK(std::isnan(calm.at_horizon.sd));
    CHECK_FALSE(calm.twins[0].parting_time.has_value());
    CHECK(to_json(study, calm)["log10_difference"]["sd"].dump() == "null");
    CHECK(make_spread_csv({study}).find("\"made, by hand\",0.5,1,") != std::string::npos);

    study.twins.clear();
    CHECK_THROWS_AS(summarize(study), std::invalid_argument);
    study.twins = {make_twin(2.0)};
    study.prototype.peak = 0.0;
    CHECK_THROWS_AS(summarize(study), std::invalid_argument);
}

TEST_CASE("copies moved by more part in proportion, and the largest departure from that is found") {
    TwinStudy study = make_study();
    for (const double shift : {1e-13, 1e-12, 1e-11}) {
        study.twins.push_back(make_twin(8.0, {.shift = shift, .directions = 7}, 0.3 * shift));
    }
    std::vector<TwinGrowth> growth = summarize(study).twins;
    std::vector<Proportionality> sets = find_proportionality(study, growth);
    REQUIRE(sets.size() == 1);
    CHECK(sets[0].directions == 7);
    CHECK(sets[0].shift == std::vector<double>{1e-13, 1e-12, 1e-11});
    CHECK(*sets[0].departure == relative(1.0, 1e-9));

    // the middle one jumps by 3 at 0.5 s
    for (std::size_t k = 50; k < kSamples; ++k) study.twins[1].difference[k] *= 3.0;
    growth = summarize(study).twins;
    sets = find_proportionality(study, growth);
    CHECK(*sets[0].departure == relative(3.0, 1e-9));
    CHECK(sets[0].time >= 0.5);
    CHECK(sets[0].level <= kProportionalLevel);
    // growth that came early: the copy is ahead at samples 49 and 50, and no longer at 52, which counts only if that is a window
    TwinStudy early = study;
    for (std::size_t k = 50; k < kSamples; ++k) early.twins[1].difference[k] /= 3.0;
    early.twins[1].difference[49] *= 1.5;
    CHECK(early.prototype.window() == 1);
    CHECK(*find_proportionality(early, summarize(early).twins)[0].departure == relative(1.5, 1e-9));
    early.prototype.interval = 0.0025;
    CHECK(early.prototype.window() == 4);
    CHECK(*find_proportionality(early, summarize(early).twins)[0].departure == relative(1.0, 1e-9));

    // what rounding makes to a tenth is not compared: the middle one from 0.5 s on, which leaves the largest alone
    TwinRun model = make_twin(8.0, {.length = 3.0}, 1e-20);
    for (std::size_t k = 50; k < kSamples; ++k) model.difference[k] = 0.11 * study.twins[1].difference[k];
    study.twins.push_back(model);
    growth = summarize(study).twins;
    sets = find_proportionality(study, growth);
    CHECK(*sets[0].departure == relative(1.0, 1e-9));

    // models are not copies
    study.twins = {make_twin(8.0)};
    CHECK(find_proportionality(study, summarize(study).twins).empty());
}

TEST_CASE("lengths of models are spread over four powers of four, the same for a seed whatever their number") {
    const std::vector<TwinChoice> many = choose_models(1000, 3), few = choose_models(5, 3);
    CHECK(std::equal(few.begin(), few.end(), many.begin()));
    CHECK(choose_models(5, 4) != few);
    double sum = 0.0, low = 1.0, high = 1.0;
    for (const TwinChoice& choice : many) {
        sum += std::log(choice.length) / std::log(4.0);
        low = std::min(low, choice.length), high = std::max(high, choice.length);
    }
    // standard deviation of the mean of 1000 uniform numbers in (-2, 2): 0.037
    CHECK(std::abs(sum / 1000.0) < 0.15);
    CHECK(low > 1.0 / 16.0);
    CHECK(low < 0.07);
    CHECK(high < 16.0);
    CHECK(high > 15.0);

    const std::vector<TwinChoice> shifted = choose_shifted({1e-12, 1e-11}, 2, 5);
    REQUIRE(shifted.size() == 4);
    CHECK(shifted[1] == TwinChoice{.shift = 1e-11, .directions = 5});
    CHECK(shifted[2] == TwinChoice{.shift = 1e-12, .directions = 6});
}
