#include "lsdem/study/pair_scene.hpp"

#include <doctest/doctest.h>

#include <string>

#include "lsdem/scene/material_presets.hpp"
#include "lsdem/scene/scale_scene.hpp"
#include "lsdem/scene/scene_json.hpp"
#include "scaling/laws/law_similitude.hpp"
#include "tests/support/relative.hpp"

using namespace musim::lsdem;
using musim::lsdem::tests::relative;
using musim::scaling::make_similitude;
using musim::scaling::Similitude;

namespace {

constexpr double kLength = 1.0 / 107.0;

/// Three blocks on each other that slide, as prototype of the tower's wood: its own model at 1:107 distorts nothing.
Scene make_prototype_scene() {
    Scene prototype = parse_scene(R"({
        "schema": "musim-scene/1", "name": "pair scene", "material": "wood",
        "structure": { "kind": "column", "layers": 3, "block": ["1.36 m", "2.82 m", "4.25 m"] },
        "base_motion": { "signal": "synthetic", "direction": "x", "pga": "1.2 g", "pgv": "80 cm/s", "duration": "2 s", "dt": "0.005 s",
                         "seed": 2 },
        "time": { "duration": "2 s" } })",
                                  "pair_scene_test");
    const Similitude enlarged = make_similitude("exact", {.length = 1.0 / kLength});
    const MaterialPreset& wood = find_material_preset("wood");
    prototype.material = wood.material;
    prototype.material.normal_stiffness *= enlarged.stiffness();
    prototype.material.shear_stiffness *= enlarged.stiffness();
    return prototype;
}

PairStudy run_own(const Scene& prototype) {
    const ScenePair pair = pair_scene(prototype, {{kLength, "wood"}}, Materials::own, {.threads = 2},
                                      {.judging = {.twins = 0, .half_step = false}, .one_at_a_time = true});
    REQUIRE(pair.study.models.size() == 1);
    return pair.study;
}

}  // namespace

TEST_CASE("a scale is named so that who reads it has it") {
    CHECK(make_scale_label(1.0 / 25.0) == "1:25");
    CHECK(make_scale_label(0.17 / 4.25) == "1:25");
    CHECK(make_scale_label(0.3) == "x0.3");
    CHECK(make_scale_label(0.040000001) == "x0.040000001");
    CHECK(make_scale_label(1.0 / 33.3) == "x0.030030030030030033");
}

TEST_CASE("a material that similitude asks for has no property that differs") {
    Scene prototype = make_prototype_scene();
    prototype.time.duration = 1.0 * musim::scaling::si::second;  // before rounding has grown to what can be seen
    const PairStudy study = run_own(prototype);
    CHECK(study.models.front().alone.empty());
    CHECK(study.models.front().difference.rms_velocity < 1e-6);
}

TEST_CASE("the one property of a model that differs makes all of its difference" * doctest::test_suite("slow")) {
    Scene prototype = make_prototype_scene();
    prototype.material.restitution = 0.6;
    const PairedRun model = run_own(prototype).models.front();
    REQUIRE(model.alone.size() == 1);
    CHECK(model.alone.front().property == "restitution");
    CHECK(model.alone.front().factor == relative(0.5, 1e-12));
    CHECK(model.alone.front().difference.rms_velocity == relative(model.difference.rms_velocity, 1e-3));
    CHECK(model.difference.rms_velocity > 1e-3);
}

TEST_CASE("every property that differs is found with its factor" * doctest::test_suite("slow")) {
    Scene prototype = make_prototype_scene();
    prototype.material.friction = 0.42;
    prototype.material.normal_stiffness *= 4.0;
    prototype.material.shear_stiffness *= 2.0;
    const PairedRun model = run_own(prototype).models.front();
    REQUIRE(model.alone.size() == 3);
    CHECK(model.alone[0].property == "friction");
    CHECK(model.alone[0].factor == relative(1.5, 1e-12));
    // friction asks for stiffer springs too
    CHECK(model.alone[1].property == "normal stiffness");
    CHECK(model.alone[1].factor == relative(0.25 / 1.5, 1e-9));
    CHECK(model.alone[2].property == "shear stiffness");
    CHECK(model.alone[2].factor == relative(0.5 / 1.5, 1e-9));
    for (const LoneDistortion& lone : model.alone) {
        CAPTURE(lone.property);
        CHECK(lone.status == RunStatus::completed);
        CHECK(lone.difference.rms_velocity > 0.0);
    }
}

TEST_CASE("without being asked no property is run alone" * doctest::test_suite("slow")) {
    Scene prototype = make_prototype_scene();
    prototype.material.restitution = 0.6;
    const ScenePair pair = pair_scene(prototype, {{kLength, "wood"}}, Materials::own, {}, {.judging = {.twins = 0, .half_step = false}});
    CHECK(pair.study.models.front().alone.empty());
}
