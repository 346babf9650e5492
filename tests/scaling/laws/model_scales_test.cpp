#include "scaling/laws/model_scales.hpp"

#include <doctest/doctest.h>

#include <cmath>

#include "scaling/laws/law_similitude.hpp"
#include "scaling/laws/scale_law_catalogue.hpp"
#include "scaling/laws/scale_law_json.hpp"
#include "scaling/structures/distortion.hpp"
#include "scaling/structures/rocking_block.hpp"
#include "tests/scaling/expected.hpp"
#include "tests/scaling/paper_towers.hpp"

namespace musim::scaling::tests {

namespace {

ModelScales make_scales(const ScaleLaw& law, const std::vector<GivenFactor>& given) {
    const LawFormulas formulas(solve_law(law, given));
    return make_model_scales(formulas, formulas.solved().problem.chosen);
}

ModelScales make_distorted(double height, double friction) {
    return make_scales(load_scale_law("mu_vertical_distortion"), {{"H", height}, {"mu", friction}});
}

/// A law of one's own with the quantities at hand.
ScaleLaw parse_own(const std::string& rest) {
    return parse_scale_law(R"({"schema": "musim-law/1", "name": "own", "title": "t", )" + rest + "}", "own.json");
}

constexpr const char* kOwnQuantities =
    R"-("quantities": [{"name": "z", "unit": "m"}, {"name": "x", "unit": "m"}, {"name": "g", "unit": "gn"}, {"name": "rho", "unit": "kg/m^3"},
       {"name": "t", "unit": "s"}, {"name": "v", "unit": "m/s"}, {"name": "u_v", "unit": "m"}],
       "definitions": ["v*t/x", "u_v/z"], "held": ["t*sqrt(g/z)"], )-";

const Distortion* find(const std::vector<Distortion>& distortions, std::string_view name) {
    for (const Distortion& distortion : distortions) {
        if (distortion.group == name) return &distortion;
    }
    return nullptr;
}

}  // namespace

// docs/theory, vertical shaking: λ_a,v = λ_g on the clock of all, λ_v,v = λ_g λ_t and λ_u,v = λ_g λ_t² = λ_l/λ_μ
TEST_CASE("vertical shaking keeps a_v/g by every law but those that neglect gravity") {
    const ScaleFactors chosen{.length = 1.0 / 107.0, .friction = 0.63 / 0.59, .gravity = 1.7};
    const ModelScales mu = make_similitude("mu", chosen);
    CHECK_EXPECTED(mu.shaking(Shaking::vertical).acceleration, 1.7);
    CHECK_EXPECTED(mu.shaking(Shaking::vertical).velocity, 1.7 * mu.time);
    CHECK_EXPECTED(mu.shaking(Shaking::vertical).displacement, chosen.length / chosen.friction);
    CHECK_EXPECTED(mu.arias_intensity(Shaking::vertical), 1.7 * mu.time);
    CHECK_EXPECTED(mu.arias_intensity(Shaking::horizontal), make_similitude("mu", chosen).arias_intensity());

    for (const char* law : {"froude", "exact", "cauchy"}) {
        const ModelScales scales = make_similitude(law, {.length = 1.0 / 107.0, .gravity = 1.7, .density = 0.7});
        const ShakingScales horizontal = scales.shaking(Shaking::horizontal), vertical = scales.shaking(Shaking::vertical);
        CHECK(vertical.displacement == horizontal.displacement);
        CHECK(vertical.velocity == horizontal.velocity);
        CHECK(vertical.acceleration == horizontal.acceleration);
    }
}

TEST_CASE("laws as data scale vertical shaking as they say, and those that say nothing as horizontal shaking") {
    CHECK(make_scales(load_scale_law("mu"), {{"l", 0.25}, {"mu", 0.25}}).acceleration_vertical == 1.0);
    CHECK(make_scales(load_scale_law("cauchy"), {{"l", 0.25}}).acceleration_vertical == 4.0);
    CHECK(make_scales(load_scale_law("gravity_distorted"), {{"l", 0.25}, {"a", 0.5}}).acceleration_vertical == 0.5);
    const ScaleLaw silent =
        parse_own(R"("quantities": [{"name": "l", "unit": "m"}, {"name": "a", "unit": "gn"}, {"name": "rho", "unit": "kg/m^3"}],
                                      "chosen": [{"name": "l"}, {"name": "a"}, {"name": "rho", "default": 1}])");
    CHECK(make_scales(silent, {{"l", 0.25}, {"a", 0.5}}).acceleration_vertical == 0.5);
}

TEST_CASE("a law releases definitions of the law that it extends, and only those that there are") {
    const std::string extends = R"("extends": "mechanics", "chosen": [{"name": "l"}, {"name": "t"}, {"name": "rho"}], )";
    const ScaleLaw law = parse_own(extends + R"("released": ["a_v/g"], "definitions": ["a_v/a"])");
    CHECK(*solve_law(law, {{"l", 0.25}, {"t", 0.25}, {"rho", 1.0}}).factor("a_v") == 4.0);
    CHECK_THROWS_WITH_AS(
        parse_own(extends + R"("released": ["a_v/a"])"),
        doctest::Contains("own.json: /released: \"a_v/a\" is no definition of the law that this one extends; take one of "), PiError);
}

TEST_CASE("without a difference in friction the mu law with vertical distortion is Froude's, to the bit") {
    for (int denominator = 1; denominator <= 128; ++denominator) {
        const double length = 1.0 / denominator;
        const ModelScales distorted = make_distorted(length, 1.0), froude = make_similitude("froude", {.length = length});
        for (const ModelScale& scale : kModelScales) {
            CAPTURE(scale.name);
            CHECK(distorted.*scale.factor == froude.*scale.factor);
        }
        CHECK(distorted.frequency == froude.frequency);
        CHECK(distorted.velocity_vertical == froude.velocity_vertical);
        CHECK(distorted.displacement_vertical == froude.displacement_vertical);
    }
}

TEST_CASE("a law of one's own has its length scale by the one length that it expects, and its motion by what it names") {
    const ScaleLaw law =
        parse_own(kOwnQuantities + std::string(R"("chosen": [{"name": "z"}, {"name": "x", "default": 1}, {"name": "g", "default": 4},
                                                                {"name": "rho", "default": 2}])"));
    CHECK(find_length_name(law, {}) == "z");
    const ModelScales scales = make_scales(law, {{"z", 0.25}});
    CHECK(scales.length_name == "z");
    CHECK(scales.height == 0.25);
    CHECK(scales.mass == 2.0 / 64.0);
    // t = √(z/g) = 1/4; x, which v t is, stays
    CHECK(scales.time == 0.25);
    CHECK(scales.displacement == 1.0);
    CHECK(scales.velocity == 4.0);
    CHECK(scales.acceleration == 16.0);
    CHECK(scales.displacement_vertical == 0.25);
    CHECK(scales.velocity_vertical == 1.0);
    CHECK(scales.acceleration_vertical == 4.0);
}

TEST_CASE("a law with two lengths to be chosen asks for all but one") {
    const ScaleLaw law =
        parse_own(kOwnQuantities + std::string(R"("chosen": [{"name": "z"}, {"name": "x"}, {"name": "g"}, {"name": "rho"}])"));
    CHECK_THROWS_WITH_AS(
        find_length_name(law, {}),
        "law own: z and x are lengths to be chosen (a model's length scale is that of one alone); give the factors of all others, e.g. of "
        "x, each as a factor that is set",
        SimilitudeError);
    CHECK(find_length_name(law, {{"x", 0.5}}) == "z");
    CHECK(find_length_name(law, {{"z", 0.5}}) == "x");
    CHECK_THROWS_WITH_AS(find_length_name(law, {{"x", 0.5}, {"z", 0.5}}),
                         doctest::Contains("it expects no length to be chosen beside the factors that are set"), SimilitudeError);
    CHECK(find_length_name(load_scale_law("mu"), {}) == "l");
    CHECK(find_length_name(load_scale_law("mu_vertical_distortion"), {}) == "H");
}

TEST_CASE("motion names that do not belong to one time are refused") {
    const ScaleLaw law = parse_own(R"("quantities": [{"name": "z", "unit": "m"}, {"name": "t", "unit": "s"}, {"name": "v", "unit": "m/s"},
                                   {"name": "u", "unit": "m"}, {"name": "v_v", "unit": "m/s"}, {"name": "u_v", "unit": "m"}, {"name": "rho", "unit": "kg/m^3"}],
                                   "chosen": [{"name": "z"}, {"name": "t"}, {"name": "v"}, {"name": "u", "default": 1}, {"name": "u_v", "default": 1},
                                   {"name": "v_v", "default": 2}, {"name": "rho", "default": 1}])");
    CHECK_THROWS_WITH_AS(make_scales(law, {{"z", 0.5}, {"t", 0.5}, {"v", 1.0}}), doctest::Contains("it does not keep v t/u"),
                         SimilitudeError);
    CHECK(make_scales(law, {{"z", 0.5}, {"t", 0.5}, {"v", 2.0}}).acceleration_vertical == 4.0);
    CHECK_THROWS_WITH_AS(make_scales(law, {{"z", 0.5}, {"t", 0.5}, {"v", 2.0}, {"u_v", 2.0}}), doctest::Contains("it does not keep u_v"),
                         SimilitudeError);
}

// docs/theory, vertical distortion of aluminium: ω/p 0.978, r 0.741 -> 0.972, e_r 0.861 -> 0.986 thin and 0.541 -> 0.941 wide
TEST_CASE("vertical distortion changes omega/p by the half diagonal, and what impacts leave of a rotation") {
    const ModelScales aluminium = make_distorted(1.0 / 107.0, kAluminiumFriction);
    const ModelProperties properties{.friction_prototype = 0.59,
                                     .slenderness = {kWide, kThin},
                                     .normal_stiffness = {},
                                     .shear_stiffness = {},
                                     .restitution = {},
                                     .height_deviation = {}};
    double frequency = 0.0, restitution = 0.0;
    for (const NamedFactor& group : group_factors(aluminium, properties)) {
        if (group.name == "omega/p") frequency = group.value;
        if (group.name == "e_r") restitution = group.value;
    }
    CHECK_EXPECTED(frequency, "0.978");
    // R ∝ H √(1 + tan²α)
    const double slender = kThin * kAluminiumFriction;
    CHECK_EXPECTED(frequency, std::pow((1.0 + slender * slender) / (1.0 + kThin * kThin), 0.25));
    const auto leave = [](double slenderness) { return RockingBlock{slenderness * si::meters, 1.0 * si::meters}.angular_restitution(); };
    CHECK_EXPECTED(restitution, leave(slender) / leave(kThin));
    CHECK_EXPECTED(leave(slender) * leave(slender), "0.972");
    const auto distortions = find_distortions(aluminium, properties);
    const Distortion* change = find(distortions, "e_r");
    REQUIRE(change != nullptr);
    CHECK(change->severity == Severity::warning);
    CHECK(change->effect.find("from 0.5415 to 0.941 at tan(alpha) = 0.6635, from 0.8607 to 0.9858 at tan(alpha) = 0.32") !=
          std::string::npos);
    CHECK(find(distortions, "mu/tan(alpha)") == nullptr);
    // one length scale keeps all angles
    for (const NamedFactor& group :
         group_factors(make_similitude("mu", {.length = 1.0 / 107.0, .friction = kAluminiumFriction}), properties)) {
        CHECK(group.name != "e_r");
    }
}

}  // namespace musim::scaling::tests
