#include "lsdem/study/pair.hpp"

#include <doctest/doctest.h>

#include <stdexcept>
#include <string>

#include "lsdem/run/scale_specimen.hpp"
#include "scaling/laws/law_similitude.hpp"
#include "tests/study/made_specimen.hpp"

using namespace musim::lsdem;
using musim::scaling::make_similitude;
using musim::scaling::Similitude;

namespace {

PairMember make_prototype_member(std::size_t cubes, double friction) {
    const Specimen column = make_column(cubes, friction);
    return {"prototype", column, make_plan(column, 300), Similitude()};
}

PairMember make_model(const PairMember& prototype, double length, const std::string& label) {
    const Similitude similitude = make_similitude("exact", {.length = length});
    return {label, scale_specimen(prototype.specimen, similitude), prototype.plan.scaled(similitude.time()), similitude};
}

}  // namespace

TEST_CASE("scales that are powers of four give the same bits, side by side or one after the other") {
    const PairMember prototype = make_prototype_member(3, 0.15);
    const std::vector<PairMember> models{make_model(prototype, 1.0 / 16.0, "1:16"), make_model(prototype, 1.0 / 64.0, "1:64")};
    for (const int threads : {1, 2, 5}) {
        const PairStudy study = run_pair(prototype, models, {.threads = threads});
        for (const PairedRun& model : study.models) {
            CHECK_MESSAGE(model.difference.bitwise_identical, model.label, " on ", threads);
            CHECK(model.difference.rms_velocity == 0.0);
        }
        CHECK(study.consistent());
        CHECK_FALSE(study.diverged());
    }
}

TEST_CASE("a stack that only slides agrees at 1:25 and 1:107 to the rounding level") {
    const PairMember prototype = make_prototype_member(2, 0.15);
    const std::vector<PairMember> models{make_model(prototype, 1.0 / 25.0, "1:25"), make_model(prototype, 1.0 / 107.0, "1:107")};
    const PairStudy study = run_pair(prototype, models, {.threads = 2});
    // it does slide: the base jerks at 2 m/s², friction carries 1.5
    CHECK(study.prototype.history.energy.back().friction_loss > 0.0);
    // and needs no twins
    CHECK(study.twins.empty());
    for (const PairedRun& model : study.models) {
        CHECK(model.difference.rms_velocity < kRoundingLevel);
        CHECK(model.judgement.agreement == Agreement::agree);
        CHECK(model.judgement.within_rounding);
    }
}

TEST_CASE("a model with another friction is not consistent, unless it is its own material") {
    const PairMember prototype = make_prototype_member(2, 0.15);
    PairMember model = make_model(prototype, 1.0 / 16.0, "1:16");
    model.specimen.model.materials[0].friction = 0.12;
    model.specimen.model.ground.material.friction = 0.12;
    const PairStudy exact = run_pair(prototype, {model});
    CHECK(exact.models[0].difference.rms_velocity > 1e-3);
    CHECK_FALSE(exact.consistent());
    model.materials = Materials::own;
    const PairStudy own = run_pair(prototype, {model});
    CHECK(own.consistent());
    CHECK(own.agreement() == Agreement::not_judged);
}

TEST_CASE("twins depart from their prototype by rounding, one by one the same whatever their number") {
    const PairMember prototype = make_prototype_member(3, 0.15);
    const PairStudy few = run_pair(prototype, {}, {}, {.twins = 2, .half_step = false});
    const PairStudy more = run_pair(prototype, {}, {.threads = 2}, {.twins = 4, .half_step = false});
    CHECK(few.same_bits == true);
    REQUIRE(few.twins.size() == 2);
    REQUIRE(more.twins.size() == 4);
    CHECK(few.twins[0].choice.length != 1.0);
    CHECK(few.twins[1].choice.last_place);
    for (std::size_t i = 0; i < 2; ++i) {
        CHECK(few.twins[i].difference.rms_velocity > 0.0);
        CHECK(few.twins[i].difference.rms_velocity < 1e-3);
        CHECK(few.twin_traces[i].running == more.twin_traces[i].running);
    }
    CHECK(more.yardstick().horizon() <= few.yardstick().horizon());
}

TEST_CASE("without twins nothing is judged") {
    const PairMember prototype = make_prototype_member(2, 0.15);
    PairMember model = make_model(prototype, 1.0 / 25.0, "1:25");
    model.specimen.model.materials[0].friction = 0.1501;
    model.specimen.model.ground.material.friction = 0.1501;
    const PairStudy unjudged = run_pair(prototype, {model}, {}, {.twins = 0, .half_step = false});
    CHECK(unjudged.agreement() == Agreement::not_judged);
    CHECK_FALSE(unjudged.same_bits.has_value());
    CHECK(run_pair(prototype, {model}).agreement() == Agreement::differ);
}

TEST_CASE("the run at half the step has the prototype's samples") {
    const PairMember prototype = make_prototype_member(2, 0.15);
    const PairStudy study = run_pair(prototype, {}, {}, {.twins = 0});
    REQUIRE(study.half_step.has_value());
    CHECK(study.half_step->run.history.samples() == study.prototype.history.samples());
    CHECK(study.half_step->difference.rms_velocity > 0.0);
    CHECK(study.half_step->difference.rms_velocity < 0.1);
}

TEST_CASE("an error in one of the runs reaches the caller") {
    PairMember prototype = make_prototype_member(1, 0.15);
    PairMember model = make_model(prototype, 1.0 / 16.0, "1:16");
    model.specimen.model.blocks[0].mass = -1.0;
    CHECK_THROWS_AS(run_pair(prototype, {model}, {.threads = 2}), std::invalid_argument);
}

TEST_CASE("a diverged run is seen") {
    PairMember prototype = make_prototype_member(2, 0.15);
    prototype.plan.time_step *= 20.0;
    CHECK(run_pair(prototype, {}).diverged());
}
