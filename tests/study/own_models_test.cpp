#include "lsdem/study/own_models.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "lsdem/scene/scale_scene.hpp"
#include "lsdem/scene/scene_error.hpp"
#include "lsdem/study/pair_scene.hpp"
#include "lsdem/study/pair_text.hpp"
#include "scaling/laws/law_similitude.hpp"
#include "tests/study/pushed_wall.hpp"

using namespace musim::lsdem;
using musim::lsdem::tests::make_pushed_wall;
using musim::scaling::make_similitude;
using musim::scaling::Similitude;

namespace {

ScenePair run_own_pair(const Scene& model, const PairSceneSettings& how, Materials materials = Materials::own) {
    return pair_scene(make_pushed_wall(), {{.scene = model}}, materials, {.threads = 2}, how);
}

PairSceneSettings accept(double tolerance, std::size_t specimens) {
    return {.judging = {.twins = 2, .half_step = false}, .specimens = specimens, .accept = tolerance};
}

}  // namespace

TEST_CASE("a scene that is the prototype's image is its model, to the last bit at a power of four") {
    const Scene image = scale_scene(make_pushed_wall(), make_similitude("exact", {.length = 1.0 / 16.0}));
    const ScenePair pair = run_own_pair(image, {}, Materials::exact);
    REQUIRE(pair.study.models.size() == 1);
    CHECK(pair.study.models[0].label == "1:16");
    CHECK(pair.study.models[0].difference.bitwise_identical);
    CHECK(pair.study.agreement() == Agreement::agree);
}

TEST_CASE("a model that is the prototype is accepted, one that nearly is unless chance alone does more") {
    const Scene same = make_pushed_wall();
    const ScenePair alone = run_own_pair(same, accept(0.01, 0));
    const OwnJudgement accepted = judge_own(alone.study, alone.study.models[0]);
    REQUIRE(accepted.quantities.size() == 3);
    CHECK(accepted.accepted == true);
    for (const OwnQuantity& quantity : accepted.quantities) {
        CHECK(quantity.check.difference == 0.0);
        CHECK_FALSE(quantity.of_specimens.has_value());
        CHECK_FALSE(quantity.beyond_chance);
    }
    const ScenePair again = run_own_pair(same, accept(0.01, 3));
    CHECK(judge_own(again.study, again.study.models[0]).accepted == true);
    CHECK(describe_own(again.study, again.study.models[0]).find("Accepted: the prototype again, to rounding.") != std::string::npos);
    Scene nearly = same;
    nearly.material.friction *= 1.0 + 1e-6;
    const ScenePair beside = run_own_pair(nearly, accept(0.01, 3));
    CHECK(beside.study.specimen_traces.size() == 3);
    const OwnJudgement chance = judge_own(beside.study, beside.study.models[0]);
    CHECK(chance.quantities[0].of_specimens->largest() > 0.01);
    CHECK(chance.accepted == false);
    CHECK(describe_own(beside.study, beside.study.models[0]).find("chance alone does more") != std::string::npos);
}

TEST_CASE("differences are said in percent, rounding as less than what counts as rounding or as nothing") {
    CHECK(format_range({-0.019, 0.15}) == "-1.9 % to +15 %");
    CHECK(format_range({-1e-12, 0.03}) == "0 % to +3 %");
    CHECK(format_range({-0.03, 0.0}) == "-3 % to 0 %");
    CHECK(format_range({}) == "less than 1e-07 %");
    CHECK(format_up_to(0.03) == "up to 3 %");
    CHECK(format_up_to(0.0) == "less than 1e-07 %");
}

TEST_CASE("a model of a tenth of the friction is distorted, more than other specimens") {
    Scene slippery = make_pushed_wall();
    slippery.material.friction *= 0.1;
    // shaken as the mu law asks for, in spite of how its base moves
    const ScenePair pair =
        pair_scene(make_pushed_wall(), {{.law = ChosenLaw{"mu"}, .scene = slippery}}, Materials::own, {.threads = 2}, accept(0.05, 6));
    const PairedRun& model = pair.study.models[0];
    const OwnJudgement judgement = judge_own(pair.study, model);
    CHECK(judgement.accepted == false);
    CHECK(std::any_of(judgement.quantities.begin(), judgement.quantities.end(), [](const auto& q) { return q.beyond_chance; }));
    CHECK(std::any_of(model.distortions.begin(), model.distortions.end(), [](const auto& d) { return d.group == "mu"; }));
    CHECK(describe_own(pair.study, model).find("NOT accepted") != std::string::npos);
}

TEST_CASE("a scene without a rate is compared at the prototype's times, whatever step its model takes") {
    Scene prototype = make_pushed_wall();
    prototype.output.spine_rate = {};
    Scene stiff = prototype;
    stiff.material.normal_stiffness *= 4.0;
    stiff.material.shear_stiffness *= 4.0;
    const ScenePair pair = pair_scene(prototype, {{.scene = stiff}}, Materials::own, {.threads = 2}, accept(0.05, 1));
    const RunResult &run_own_pair = pair.study.prototype, &model = pair.study.models[0].run;
    CHECK(model.time_step < 0.6 * run_own_pair.time_step);
    REQUIRE(model.history.samples() == run_own_pair.history.samples());
    CHECK(model.history.time.back() == doctest::Approx(run_own_pair.history.time.back()).epsilon(1e-9));
    CHECK(pair.study.specimen_traces[0].running.size() == run_own_pair.history.samples());
}

TEST_CASE("other structures are no models, and structures without drawn heights have no other specimens") {
    Scene taller = make_pushed_wall();
    std::get<Wall>(taller.structure).layers = 3;
    CHECK_THROWS_AS(run_own_pair(taller, {}), SceneError);
    Scene even = make_pushed_wall();
    std::get<Wall>(even.structure).height_deviation = {};
    CHECK_THROWS_AS(pair_scene(even, {{.scene = even}}, Materials::own, {}, accept(0.05, 3)), SceneError);
}
