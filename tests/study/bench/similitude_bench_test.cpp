#include "tests/benches/similitude_bench.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <variant>
#include <vector>

#include "scaling/error.hpp"
#include "scaling/laws/law_similitude.hpp"
#include "scaling/laws/scale_law_catalogue.hpp"
#include "tests/benches/closed_responses.hpp"
#include "tests/benches/similitude_figure.hpp"
#include "tests/support/relative.hpp"

using namespace musim::lsdem;
using musim::lsdem::tests::relative;

namespace {

std::vector<SimilitudeCase> select(const std::string& law, BenchScene scene) {
    std::vector<SimilitudeCase> cases = make_similitude_cases(law);
    std::erase_if(cases, [&](const SimilitudeCase& c) { return c.scene != scene; });
    return cases;
}

void check_hold(const std::vector<SimilitudeOutcome>& outcomes) {
    for (const SimilitudeOutcome& o : outcomes) {
        CAPTURE(to_string(o.wanted.scene));
        CAPTURE(to_string(o.wanted.broken.group));
        INFO(o.wanted.law << ": predicted " << o.wanted.prediction.ratio << ", measured " << o.ratio << "; difference " << o.difference
                          << ", yardstick " << o.yardstick);
        CHECK(o.holds());
    }
}

}  // namespace

// [Newmark65], mu = 0.63, A = 1.5 g, T = 0.1 s, g = 9.81 m/s²: slip 30.468528 mm until 158.36456 ms, eight digits printed.
TEST_CASE("a pushed slider slips as far and as long as Newmark's") {
    const PushedSlider slider = compute_pushed_slider(1.5 / 0.63);
    CHECK(slider.slip * 1.5 * 9.81 * 0.01 == relative(30.468528e-3, 2e-8));
    CHECK(slider.end * 0.1 == relative(158.36456e-3, 4e-8));
    CHECK_THROWS_AS(compute_pushed_slider(1.0), std::invalid_argument);
    CHECK_THROWS_AS(compute_pushed_slider(1.2), std::invalid_argument);
}

// [Shi96], [MakrisRoussos00]: a half-sine of w = 3 overturns from s = 2.293872 on, w = 5 from 3.289147 on, seven digits printed.
TEST_CASE("a pushed rocker overturns where the half-sine pulse does, and not below") {
    CHECK(compute_pushed_tilt(2.293873, 3.0) == 1.0);
    CHECK(compute_pushed_tilt(2.293871, 3.0) < 1.0);
    CHECK(compute_pushed_tilt(3.289148, 5.0) == 1.0);
    CHECK(compute_pushed_tilt(3.289146, 5.0) < 1.0);
    CHECK(compute_pushed_tilt(1.0, 3.0) == 0.0);
    CHECK_THROWS_AS(compute_pushed_tilt(1.01, 3.0), std::invalid_argument);
}

// Another program's integration of the same equation by Euler's method in 200,000 steps: m = 2505.6 kg, b = 0.3 m, h = 6 m,
// k_n = 8.728e11 N/m and 72.5 times that; displacement of the middle 25.6955 and 23.9140 mm.
TEST_CASE("a rocker on an elastic base tilts farther, and as Housner's where the base is hard") {
    const double alpha = std::atan(0.05), sinking = 2505.6 * 9.80665 / (8.7279e11 * 0.3 * alpha);
    CHECK(compute_soft_tilt(1.9, 4.0, sinking) * alpha * 3.0 == relative(25.6955e-3, 2e-3));
    CHECK(compute_soft_tilt(1.9, 4.0, sinking / 72.5) / compute_soft_tilt(1.9, 4.0, sinking) == relative(0.93067, 3e-4));
    const double rigid = compute_pushed_tilt(1.9, 4.0);
    CHECK(compute_soft_tilt(1.9, 4.0, 1e-10) == relative(rigid, 3e-3));
    CHECK(compute_soft_tilt(1.9, 4.0, 1e-8) - rigid > 4.0 * (compute_soft_tilt(1.9, 4.0, 1e-10) - rigid));
    CHECK(compute_soft_tilt(4.0, 4.0, 1e-6) == 1.0);
}

TEST_CASE("a sliding block keeps one curve with equal groups, and parts by Newmark's ratio with a broken one") {
    for (const char* law : {"mu", "froude", "exact", "centrifuge"}) check_hold(run_similitude_cases(select(law, BenchScene::slide)));
}

TEST_CASE("a chain keeps Cauchy's law without gravity, and parts by the root of its stiffness") {
    check_hold(run_similitude_cases(make_similitude_cases("cauchy")));
}

TEST_CASE("a rocking block parts from the mu law as its weight does, and not at all when it cannot lift") {
    check_hold(run_similitude_cases(select("mu", BenchScene::rock)));
}

TEST_CASE("a rocking block keeps the other laws and parts from them as predicted" * doctest::test_suite("slow")) {
    for (const char* law : {"froude", "exact", "centrifuge"}) check_hold(run_similitude_cases(select(law, BenchScene::rock)));
}

// All factors are powers of two: what parts a column at other scales is rounding and not the law.
TEST_CASE("the shaken column at one sixteenth is its prototype to the last bit") {
    for (const char* law : {"froude", "exact", "centrifuge", "true_replica", "artificial_mass"}) {
        const std::vector<SimilitudeOutcome> outcomes = run_similitude_cases(select(law, BenchScene::column));
        REQUIRE(outcomes.size() == 1);
        CHECK(outcomes[0].difference == 0.0);
        CHECK(outcomes[0].ratio == 1.0);
        CHECK(outcomes[0].holds());
    }
}

TEST_CASE("replicas and laws of restoring forces and of distortions keep what they say and part as predicted" *
          doctest::test_suite("slow")) {
    for (const char* law : {"true_replica", "artificial_mass", "gravity_distorted", "restoring_force", "restoring_rocking",
                            "restoring_spring", "restoring_cohesion", "restoring_mixed", "mu_vertical_distortion"}) {
        std::vector<SimilitudeCase> cases = make_similitude_cases(law);
        std::erase_if(cases, [](const SimilitudeCase& c) { return c.scene == BenchScene::column; });
        check_hold(run_similitude_cases(cases));
    }
}

TEST_CASE("every law has a case that collapses or is predicted to, and one that parts") {
    REQUIRE(similitude_law_names().size() + 1 == musim::scaling::scale_law_names().size());
    for (const std::string& law : similitude_law_names()) {
        CAPTURE(law);
        const std::vector<SimilitudeCase> cases = make_similitude_cases(law);
        const auto is_one = [](const SimilitudeCase& c) { return std::abs(c.prediction.ratio - 1.0) <= c.prediction.tolerance; };
        CHECK(std::any_of(cases.begin(), cases.end(), is_one));
        CHECK_FALSE(std::all_of(cases.begin(), cases.end(), is_one));
    }
}

// H = 1/25, friction 0.3: widths 0.3/25, so that tan(alpha) is 0.3 of the prototype's, and heights 1/0.3 over widths
TEST_CASE("a model with its own scale of heights is as high and as wide as its law says") {
    const TwinScales scales = make_twin_scales("mu_vertical_distortion", {{"H", 1.0 / 25.0}, {"mu", 0.3}});
    CHECK(scales.similitude.length() == relative(0.3 / 25.0, 1e-14));
    CHECK(scales.similitude.acceleration() == relative(0.3, 1e-14));
    CHECK(scales.similitude.time() == relative(1.0 / 5.0, 1e-14));
    CHECK(scales.heights == relative(1.0 / 0.3, 1e-14));
    const auto block = [](const musim::lsdem::Scene& scene) { return std::get<musim::lsdem::Column>(scene.structure).block; };
    const auto prototype = block(make_bench_scene(BenchScene::rock)), model = block(make_model_scene(BenchScene::rock, scales, {}));
    CHECK(model[0].value() == relative(prototype[0].value() * 0.3 / 25.0, 1e-14));
    CHECK(model[1].value() == relative(prototype[1].value() * 0.3 / 25.0, 1e-14));
    CHECK(model[2].value() == relative(prototype[2].value() / 25.0, 1e-14));
}

TEST_CASE("a wrong prediction fails its verdict, and so does a broken group called equal") {
    std::vector<SimilitudeCase> cases = select("froude", BenchScene::slide);
    std::erase_if(cases, [](const SimilitudeCase& c) { return c.broken.group != BrokenGroup::friction; });
    REQUIRE(cases.size() == 1);
    cases.push_back(cases.front());
    cases.push_back(cases.front());
    // twice the tolerance past the prediction: farther than the tolerance from what is measured
    cases[1].prediction.ratio += 2.0 * cases[1].prediction.tolerance;
    cases[2].collapses = true;
    const std::vector<SimilitudeOutcome> outcomes = run_similitude_cases(cases);
    CHECK(outcomes[0].holds());
    CHECK_FALSE(outcomes[1].holds());
    CHECK_FALSE(outcomes[2].holds());
    CHECK_FALSE(all_hold(outcomes));

    // one line for each, and a figure that shows it
    const std::string csv = make_similitude_csv(outcomes);
    CHECK(std::count(csv.begin(), csv.end(), '\n') == 4);
    CHECK(make_similitude_svg("froude", outcomes).find("friction × 2") != std::string::npos);
}

TEST_CASE("the predictions are exact numbers where groups enter by powers") {
    const musim::scaling::Similitude twin = musim::scaling::make_similitude("exact", {.length = 1.0 / 25.0});
    // a few roundings
    CHECK(predict(BenchScene::slide, {twin}, {BrokenGroup::duration, 1.5}, Measure::peak).ratio == relative(2.25, 1e-14));
    CHECK(predict(BenchScene::chain, {twin}, {BrokenGroup::stiffness, 4.0}, Measure::peak_time).ratio == relative(0.5, 1e-14));
    CHECK_THROWS_AS(predict(BenchScene::column, {twin}, {}, Measure::peak), std::invalid_argument);
    CHECK_THROWS_AS(make_similitude_cases("newton"), musim::scaling::SimilitudeError);
}
