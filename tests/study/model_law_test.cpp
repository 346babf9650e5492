#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "lsdem/scene/build_model.hpp"
#include "lsdem/scene/scale_scene.hpp"
#include "lsdem/scene/scene_json.hpp"
#include "lsdem/study/base_shaking.hpp"
#include "lsdem/study/model_distortions.hpp"
#include "lsdem/study/pair_models.hpp"
#include "lsdem/study/scene_model.hpp"
#include "scaling/laws/law_similitude.hpp"
#include "tests/support/relative.hpp"

using namespace musim::lsdem;
using musim::lsdem::tests::relative;
using musim::scaling::Distortion;
using musim::scaling::make_similitude;
using musim::scaling::ScaleFactors;
using musim::scaling::Similitude;

namespace {

constexpr double kModelLength = 1.0 / 20.0, kModelFriction = 0.7, kModelDensity = 0.4;

Scene make_shaken_column(
    const std::string& motion = R"("signal": "sine", "direction": "x", "amplitude": "0.6 g", "frequency": "2 Hz", "cycles": 1)") {
    return parse_scene(R"({"schema": "musim-scene/1", "name": "prototype", "material": "concrete",
        "structure": {"kind": "column", "layers": 2, "block": ["1.36 m", "2.82 m", "4.25 m"]},
        "base_motion": {)" +
                       motion + R"(}, "time": {"duration": "1 s"}, "output": {"spine_rate": "100 Hz"}})");
}

/// A model by a law, as a scene of its own.
Scene make_scene_by_law(const std::string& law, const ScaleFactors& factors = {kModelLength, kModelFriction, 1.0, kModelDensity}) {
    Scene scene = scale_scene(make_shaken_column(), make_similitude(law, factors));
    scene.name = law;
    return scene;
}

std::vector<Distortion> distort_scene(const Scene& prototype, const ScaledScene& model) {
    return find_model_distortions({prototype, make_model(prototype)}, {model.scene, make_model(model.scene)}, model.scales);
}

double find_group_factor(const std::vector<Distortion>& distortions, const std::string& group) {
    const auto found = std::find_if(distortions.begin(), distortions.end(), [&](const Distortion& each) { return each.group == group; });
    return found == distortions.end() ? 1.0 : found->factor;
}

BaseComponent make_base_pulse(std::size_t samples, double dt, double peak, double start = 0.0) {
    BaseComponent component{.start = start, .dt = dt, .velocity = {}};
    const double last = static_cast<double>(samples - 1);
    for (std::size_t k = 0; k < samples; ++k) {
        const double x = static_cast<double>(k) / last;
        component.velocity.push_back(peak * std::sin(std::numbers::pi * x) * std::sin(7.0 * std::numbers::pi * x));
    }
    return component;
}

}  // namespace

TEST_CASE("the factors between two motions of the base are found, whatever their samples") {
    const BaseComponents prototype{.shift = {make_base_pulse(201, 0.01, 1.0, 0.5), {}, make_base_pulse(201, 0.01, 0.4, 0.5)}};
    const BaseComponents model{.shift = {make_base_pulse(201, 0.003, 0.2, 0.15), {}, make_base_pulse(201, 0.003, 0.04, 0.15)}};
    const auto shaking = measure_base_shaking(prototype, model, 3.0, {});
    REQUIRE(shaking);
    CHECK(*shaking->time == relative(0.3, 1e-12));
    CHECK(*shaking->velocity == relative(0.2, 1e-12));
    CHECK(*shaking->velocity_vertical == relative(0.1, 1e-12));

    // sampled anew: linear interpolation between 57 samples a period, (2π/57)²/8 = 0.15 % of an amplitude
    const BaseComponents anew{.shift = {make_base_pulse(401, 0.0015, 0.2, 0.15), {}, make_base_pulse(401, 0.0015, 0.04, 0.15)}};
    const auto of_anew = measure_base_shaking(prototype, anew, 3.0, {0.7, 0.3});
    REQUIRE(of_anew);
    CHECK(*of_anew->time == 0.3);
    CHECK(*of_anew->velocity == relative(0.2, 2e-3));
    const auto unexpected = measure_base_shaking(prototype, anew, 3.0, {});
    REQUIRE(unexpected);
    CHECK(*unexpected->time == relative(0.3, 2e-3));
}

TEST_CASE("another motion has no factors, a step has no time") {
    const BaseComponent pulse = make_base_pulse(201, 0.01, 1.0), step{.start = 0.1, .dt = 0.0, .velocity = {0.5}},
                        ramp{.start = 0.0, .dt = 1.0, .velocity = {0.0, 1.0, 2.0}};
    CHECK_FALSE(measure_base_shaking({.shift = {pulse, {}, {}}}, {.shift = {BaseComponent(), pulse, BaseComponent()}}, 2.0, {1.0}));
    CHECK_FALSE(measure_base_shaking({.shift = {pulse, {}, {}}}, {.shift = {ramp, {}, {}}}, 2.0, {1.0}));
    CHECK_FALSE(measure_base_shaking({.shift = {pulse, {}, {}}}, {.shift = {step, {}, {}}}, 2.0, {1.0}));
    CHECK_FALSE(measure_base_shaking({}, {}, 2.0, {1.0}));
    const auto shaking = measure_base_shaking({.shift = {step, {}, {}}},
                                              {.shift = {BaseComponent{.start = 0.05, .dt = 0.0, .velocity = {0.2}}, {}, {}}}, 2.0, {0.5});
    REQUIRE(shaking);
    CHECK_FALSE(shaking->time);
    CHECK(*shaking->velocity == relative(0.4, 1e-12));
}

TEST_CASE("the law of a scene is found from the motion of its base, and what it distorts is listed by it") {
    for (const auto& each : {std::pair{"froude", 1.0}, std::pair{"mu", kModelFriction}}) {
        const char* const law = each.first;
        const double acceleration = each.second;
        CAPTURE(law);
        const Scene prototype = make_shaken_column();
        const ScaledScene model = take_as_model(prototype, make_scene_by_law(law), {}, {});
        CHECK(model.similitude.law_name() == law);
        CHECK(model.law.source == LawSource::measured);
        CHECK(model.similitude.acceleration() == acceleration);
        CHECK(model.scene.time.duration.value() == relative(std::sqrt(kModelLength / acceleration), 1e-12));
        const auto distortions = distort_scene(prototype, model);
        CHECK(find_group_factor(distortions, "a/g") == relative(acceleration, 1e-9));
        CHECK(find_group_factor(distortions, "a/(mu*g)") == relative(acceleration / kModelFriction, 1e-9));
        CHECK(find_group_factor(distortions, "mu") == relative(kModelFriction, 1e-9));
        CHECK(find_group_factor(distortions, "kappa_n") == relative(acceleration, 1e-9));
        // what the law asks for: Froude's equal friction, the mu law only what it keeps
        const std::vector<std::string> asked = find_asked(model, distortions);
        const bool asks = std::find(asked.begin(), asked.end(), "a/(mu*g)") != asked.end();
        CHECK(asks == (std::string(law) == "froude"));
    }
}

TEST_CASE("a law that is given is taken, and where the base moves otherwise its groups are what they are") {
    const Scene prototype = make_shaken_column();
    const ScaledScene model = take_as_model(prototype, make_scene_by_law("froude"), {}, ChosenLaw{"mu"});
    CHECK(model.law.source == LawSource::chosen);
    CHECK(model.similitude.acceleration() == relative(kModelFriction, 1e-12));
    const auto distortions = distort_scene(prototype, model);
    CHECK(find_group_factor(distortions, "a/g") == 1.0);
    CHECK(find_group_factor(distortions, "a/(mu*g)") == relative(1.0 / kModelFriction, 1e-9));
    // stronger by a fifth than Froude's law asks for
    Scene stronger = make_scene_by_law("froude");
    stronger.base_motion.factors.velocity *= 1.2;
    const ScaledScene shaken = take_as_model(prototype, stronger, {}, {});
    CHECK(shaken.similitude.law_name() == "froude");
    CHECK(find_group_factor(distort_scene(prototype, shaken), "a/g") == relative(1.2, 1e-9));
    CHECK(find_group_factor(distort_scene(prototype, shaken), "omega/p") == 1.0);
}

TEST_CASE("a base that moves by no known law, or otherwise, is said to") {
    Scene odd = make_scene_by_law("froude");
    odd.base_motion.factors.time *= 0.6;
    const ScaledScene none = take_as_model(make_shaken_column(), odd, {}, {});
    CHECK(none.similitude.law_name() == kNoLaw);
    CHECK(none.similitude.acceleration() == relative(1.0 / 0.36, 1e-9));
    const Scene other = make_shaken_column(R"("signal": "ricker", "direction": "x", "amplitude": "0.6 g", "frequency": "2 Hz")");
    const ScaledScene assumed = take_as_model(make_shaken_column(), other, Materials::own, {});
    CHECK(assumed.law.source == LawSource::assumed);
    CHECK(assumed.similitude.law_name() == "mu");
}

TEST_CASE("blocks of several materials are compared each with its like") {
    const auto make = [](double size, double granite, double steel, const char* ground) {
        return parse_scene(R"({"schema": "musim-scene/1", "name": "list", "material": "concrete",
            "materials": {
                "granite": {"density": 2700, "normal_stiffness": )" +
                           std::to_string(1e9 * size) + R"(, "shear_stiffness": )" + std::to_string(1e9 * size) + R"(, "friction": )" +
                           std::to_string(granite) + R"(, "restitution": 0.3},
                "steel": {"density": 7800, "normal_stiffness": )" +
                           std::to_string(4e9 * size) + R"(, "shear_stiffness": )" + std::to_string(4e9 * size) + R"(, "friction": )" +
                           std::to_string(steel) + R"(, "restitution": 0.3}},
            "ground": {"friction": )" +
                           ground + R"(},
            "structure": {"kind": "blocks", "blocks": [
                {"size": [)" +
                           std::to_string(2 * size) + "," + std::to_string(2 * size) + "," + std::to_string(size) +
                           R"(], "position": [0, 0, )" + std::to_string(0.5 * size) + R"(], "material": "granite"},
                {"size": [)" +
                           std::to_string(2 * size) + "," + std::to_string(2 * size) + "," + std::to_string(size) +
                           R"(], "position": [0, 0, )" + std::to_string(1.5 * size) + R"(], "material": "steel"}]},
            "time": {"duration": "1 s"}})");
    };
    const Scene prototype = make(1.0, 0.5, 0.3, "0.5"), model = make(0.25, 0.5, 0.24, "0.25");
    const ScaledScene taken = take_as_model(prototype, model, {}, {});
    CHECK(taken.law.source == LawSource::assumed);  // no base moves
    const auto distortions = distort_scene(prototype, taken);
    CHECK(std::count_if(distortions.begin(), distortions.end(), [](const Distortion& each) { return each.group == "mu"; }) == 1);
    const auto friction = std::find_if(distortions.begin(), distortions.end(), [](const Distortion& each) { return each.group == "mu"; });
    CHECK(friction->factor == relative(0.8, 1e-9));
    CHECK(friction->effect.find("blocks of \"steel\"") == 0);
    CHECK(find_group_factor(distortions, "mu_ground/mu") == relative(0.5, 1e-9));
    // faces as stiff as λ_l: 1/λ_l times what their weight asks for
    const auto hard = std::find_if(distortions.begin(), distortions.end(), [](const Distortion& each) { return each.group == "kappa_n"; });
    REQUIRE(hard != distortions.end());
    CHECK(hard->factor == relative(4.0, 1e-6));
    CHECK(hard->effect.find("blocks of") == std::string::npos);
}

TEST_CASE("a table of pairs, and no friction at all, are compared as they are") {
    const auto make = [](const std::string& pairs, const std::string& friction) {
        return parse_scene(R"({"schema": "musim-scene/1", "name": "pairs", "material": "concrete", "materials": {
                "granite": {"density": 2700, "normal_stiffness": 1e9, "shear_stiffness": 1e9, "friction": )" +
                           friction + R"(, "restitution": 0.3},
                "steel": {"density": 7800, "normal_stiffness": 1e9, "shear_stiffness": 1e9, "friction": )" +
                           friction + R"(, "restitution": 0.3}},
            "pairs": [)" + pairs +
                           R"(], "structure": {"kind": "blocks", "blocks": [
                {"size": [2, 2, 1], "position": [0, 0, 0.5], "material": "granite"},
                {"size": [2, 2, 1], "position": [0, 0, 1.5], "material": "steel"}]}, "time": {"duration": "1 s"}})");
    };
    const auto distort = [](const Scene& prototype, const Scene& model) {
        return find_model_distortions({prototype, make_model(prototype)}, {model, make_model(model)}, Similitude());
    };
    const auto distortions = distort(make(R"({"of": ["granite", "steel"], "friction": 0.3})", "0.5"),
                                     make(R"({"of": ["granite", "steel"], "friction": 0.15})", "0.5"));
    REQUIRE(distortions.size() == 1);
    CHECK(distortions.front().group == "mu");
    CHECK(distortions.front().factor == relative(0.5, 1e-12));
    CHECK(distortions.front().effect.find("blocks of \"granite\" on blocks of \"steel\"") == 0);
    const Scene scene = make("", "0.5");
    Model smooth = make_model(scene);
    for (Material& material : smooth.materials) material.friction = 0.0;
    CHECK(find_model_distortions({scene, smooth}, {scene, smooth}, Similitude()).empty());
}

TEST_CASE("an own material is shaken by any law, its own friction, density and stiffness in the law's place") {
    const Scene prototype = make_shaken_column();
    // concrete and wood of the papers; E = k_n/l at the block of the model
    const MaterialPreset &concrete = find_material_preset("concrete"), &wood = find_material_preset("wood");
    const double friction = wood.material.friction / concrete.material.friction,
                 density = wood.material.density / concrete.material.density;
    const double length = 1.0 / 107.0;
    Scene scaled = scale_scene(prototype, make_similitude("exact", {.length = length}));
    const BlockMaterial fitted = fit_to_block(wood, std::get<Column>(scaled.structure).block);
    const double normal = fitted.normal_stiffness / prototype.material.normal_stiffness,
                 shear = fitted.shear_stiffness / prototype.material.shear_stiffness, elasticity = normal / length;
    struct Wanted {
        ChosenLaw law;
        double acceleration, gravity = 1.0;
    };
    const Wanted cases[] = {{{"mu"}, friction},
                            {{"froude"}, 1.0},
                            {{"exact"}, 1.0},
                            {{"froude", {{"g", 2.0}}}, 2.0, 2.0},
                            {{"cauchy"}, elasticity / (density * length)},
                            {{"centrifuge"}, elasticity / (density * length), elasticity / (density * length)},
                            {{"true_replica"}, 1.0},
                            {{"gravity_distorted", {{"a", 1.5}}}, 1.5},
                            {{"mechanics", {{"t", 0.1}}}, 100.0 * length},
                            {{"restoring_force", {{"F_R", 1e-6}}}, 1e-6 / (density * length * length * length)},
                            {{"restoring_cohesion", {{"c_coh", 0.01}}}, 0.01 / (density * length)},
                            {{"restoring_rocking"}, 1.0},
                            {{"restoring_spring"}, shear / (density * length * length)},
                            {{"restoring_mixed"}, friction}};
    for (const Wanted& wanted : cases) {
        CAPTURE(wanted.law.name);
        const ScaledScene model = make_scaled(prototype, {.length = length, .material = "wood", .law = wanted.law}, Materials::own);
        CHECK(model.similitude.law_name() == wanted.law.name);
        CHECK(model.similitude.acceleration() == relative(wanted.acceleration, 1e-9));
        CHECK(model.similitude.gravity() == relative(wanted.gravity, 1e-9));
        CHECK(model.similitude.friction() == relative(friction, 1e-12));
        CHECK(model.scene.material.density / prototype.material.density == relative(density, 1e-12));
        CHECK(model.scene.base_motion.factors.velocity == relative(std::sqrt(length * wanted.acceleration), 1e-9));
        CHECK(find_group_factor(distort_scene(prototype, model), "a/g") == relative(wanted.acceleration / wanted.gravity, 1e-9));
    }
    // mass is added until the stiffness per weight is the prototype's: ρ = E/(g l)
    const ScaledScene heavy =
        make_scaled(prototype, {.length = length, .material = "wood", .law = ChosenLaw{"artificial_mass"}}, Materials::own);
    CHECK(heavy.scene.material.density / prototype.material.density == relative(elasticity / length, 1e-9));
    CHECK(find_group_factor(distort_scene(prototype, heavy), "kappa_n") == relative(1.0, 1e-9));
}

TEST_CASE("a law that cannot apply to an own material says why") {
    const Scene prototype = make_shaken_column();
    const auto scale = [&](const ChosenLaw& law) {
        make_scaled(prototype, {.length = 1.0 / 107.0, .material = "wood", .law = law}, Materials::own);
    };
    using musim::scaling::SimilitudeError;
    CHECK_THROWS_WITH_AS(scale({"mu_vertical_distortion"}), doctest::Contains("no length l for all directions"), SimilitudeError);
    CHECK_THROWS_WITH_AS(scale({"gravity_distorted"}), doctest::Contains("the factor of a (acceleration) is missing"), SimilitudeError);
    CHECK_THROWS_WITH_AS(scale({"froude", {{"mu", 1.0}}}), doctest::Contains("is the model's own"), SimilitudeError);
    // 1e4 times as soft: its stiffness per weight asks for less mass than it has
    Scene stiff = prototype;
    stiff.material.normal_stiffness *= 1e4;
    CHECK_THROWS_WITH_AS(
        make_scaled(stiff, {.length = 1.0 / 107.0, .material = "wood", .law = ChosenLaw{"artificial_mass"}}, Materials::own),
        doctest::Contains("mass can be added to a material, not taken away"), SceneError);
}

TEST_CASE("each property of an own material is tried by the law that shakes it") {
    const Scene prototype = make_shaken_column();
    const auto names = [&](const ChosenLaw& law) {
        std::vector<std::string> all;
        const ScaledScene own = make_scaled(prototype, {.length = 1.0 / 107.0, .material = "wood", .law = law}, Materials::own);
        for (const LoneScene& lone : find_lone_scenes(prototype, own)) {
            all.push_back(lone.property);
            const double shaken = lone.property == "shaking" || (lone.property == "friction" && law.name == "mu")
                                      ? own.similitude.acceleration()
                                      : own.similitude.gravity();
            CHECK(lone.similitude.acceleration() == relative(shaken, 1e-12));
        }
        return all;
    };
    const std::vector<std::string> usual{"friction", "normal stiffness", "shear stiffness", "restitution"};
    CHECK(names({"mu"}) == usual);
    CHECK(names({"froude"}) == usual);
    const std::vector<std::string> with_shaking{"shaking", "friction", "normal stiffness", "shear stiffness", "restitution"};
    CHECK(names({"cauchy"}) == with_shaking);
}
