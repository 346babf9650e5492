#include "lsdem/study/pair.hpp"

#include <doctest/doctest.h>

#include <stdexcept>
#include <string>

#include "lsdem/study/scale_specimen.hpp"
#include "tests/study/made_specimen.hpp"

using namespace musim::lsdem;
using namespace musim::lsdem::study;
using musim::scaling::Law;
using musim::scaling::Similitude;

namespace {

PairMember make_prototype(std::size_t cubes, double friction) {
    const Specimen column = make_column(cubes, friction);
    return {"prototype", column, make_plan(column, 300), Similitude({}, Law::exact)};
}

PairMember make_model(const PairMember& prototype, double length, const std::string& label) {
    const Similitude similitude({.length = length}, Law::exact);
    return {label, scale_specimen(prototype.specimen, similitude), prototype.plan.scaled(similitude.time()), similitude};
}

}  // namespace

TEST_CASE("scales that are powers of four give the same bits, side by side or one after the other") {
    const PairMember prototype = make_prototype(3, 0.15);
    const std::vector<PairMember> models{make_model(prototype, 1.0 / 16.0, "1:16"), make_model(prototype, 1.0 / 64.0, "1:64")};
    for (const int threads : {1, 2, 5}) {
        const PairStudy study = run_pair(prototype, models, Materials::exact, {.threads = threads});
        for (const PairedRun& model : study.models) {
            CHECK_MESSAGE(model.difference.bitwise_identical, model.label, " on ", threads);
            CHECK(model.difference.rms_velocity == 0.0);
        }
        CHECK(study.consistent());
        CHECK_FALSE(study.diverged());
    }
}

TEST_CASE("a stack that only slides agrees at 1:25 and 1:107 to the rounding level") {
    const PairMember prototype = make_prototype(2, 0.15);
    const std::vector<PairMember> models{make_model(prototype, 1.0 / 25.0, "1:25"), make_model(prototype, 1.0 / 107.0, "1:107")};
    const PairStudy study = run_pair(prototype, models, Materials::exact, {.threads = 2});
    // it does slide: the base jerks at 2 m/s², friction carries 1.5
    CHECK(study.prototype.history.energy.back().friction_loss > 0.0);
    for (const PairedRun& model : study.models) {
        CHECK(model.difference.rms_velocity < kRoundingLevel);
        CHECK(model.consistent);
    }
}

TEST_CASE("a model with another friction is not consistent, unless it is its own material") {
    const PairMember prototype = make_prototype(2, 0.15);
    PairMember model = make_model(prototype, 1.0 / 16.0, "1:16");
    model.specimen.model.materials[0].friction = 0.12;
    model.specimen.model.ground.material.friction = 0.12;
    const PairStudy exact = run_pair(prototype, {model}, Materials::exact);
    CHECK(exact.models[0].difference.rms_velocity > 1e-3);
    CHECK_FALSE(exact.consistent());
    CHECK(run_pair(prototype, {model}, Materials::own).consistent());
}

TEST_CASE("a shadow departs from its prototype, by rounding") {
    const PairStudy study = run_pair(make_prototype(3, 0.15), {}, Materials::exact);
    CHECK(study.shadow.difference.rms_velocity > 0.0);
    CHECK(study.shadow.difference.rms_velocity < 1e-3);
    CHECK_FALSE(study.shadow.difference.bitwise_identical);
}

TEST_CASE("an error in one of the runs reaches the caller") {
    PairMember prototype = make_prototype(1, 0.15);
    PairMember model = make_model(prototype, 1.0 / 16.0, "1:16");
    model.specimen.model.blocks[0].mass = -1.0;
    CHECK_THROWS_AS(run_pair(prototype, {model}, Materials::exact, {.threads = 2}), std::invalid_argument);
}

TEST_CASE("a diverged run is seen") {
    PairMember prototype = make_prototype(2, 0.15);
    prototype.plan.time_step *= 20.0;
    CHECK(run_pair(prototype, {}, Materials::exact).diverged());
}
