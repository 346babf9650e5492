#include "scaling/structures/distortion.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "scaling/laws/law_similitude.hpp"
#include "tests/scaling/expected.hpp"
#include "tests/scaling/paper_towers.hpp"

namespace musim::scaling::tests {

namespace {

const ScaleFactors kWoodModel{.length = 1.0 / 107.0, .friction = 0.63 / 0.59, .density = 800.0 / 2320.0};
const ScaleFactors kAluminiumModel{.length = 1.0 / 107.0, .friction = 0.18 / 0.59, .density = 2625.0 / 2320.0};

double group(const ModelScales& scales, std::string_view name, const ModelProperties& properties = {}) {
    for (const NamedFactor& factor : group_factors(scales, properties)) {
        if (factor.name == name) return factor.value;
    }
    FAIL("no group " << name);
    return 0.0;
}

const Distortion* find_distortion(const std::vector<Distortion>& distortions, std::string_view name) {
    const auto found = std::find_if(distortions.begin(), distortions.end(), [&](const Distortion& d) { return d.group == name; });
    return found == distortions.end() ? nullptr : &*found;
}

/// A model whose record is scaled alike in all directions, the vertical one too.
ModelScales shake_alike(const Similitude& similitude) {
    ModelScales scales = similitude;
    scales.displacement_vertical = scales.displacement;
    scales.velocity_vertical = scales.velocity;
    scales.acceleration_vertical = scales.acceleration;
    return scales;
}

struct DistortionRow {
    std::string name;
    Expected froude_aluminium, froude_wood, mu_aluminium, mu_wood;
};

}  // namespace

TEST_CASE("distortions of aluminium and wood under Froude and mu input agree with the reference table") {
    const std::vector<DistortionRow> rows = {
        {"mu^N", "1.8105", "0.9677", 1.0, 1.0},
        {"t*sqrt(mu*g/l)", "0.5523", "1.0333", 1.0, 1.0},
        {"a/(mu*g)", "3.2778", "0.9365", 1.0, 1.0},
        {"a/g", 1.0, 1.0, "0.3051", "1.0678"},
        {"a/(g*tan(alpha))", 1.0, 1.0, "0.3051", "1.0678"},
        {"a_vertical/g", 1.0, 1.0, "0.3051", "1.0678"},
        {"omega/p", 1.0, 1.0, "0.5523", "1.0333"},
        {"Fr^N", 1.0, 1.0, "0.5523", "1.0333"},
        {"mu/tan(alpha)", "0.3051", "1.0678", "0.3051", "1.0678"},
        {"mu", "0.3051", "1.0678", "0.3051", "1.0678"},
    };
    for (const DistortionRow& row : rows) {
        CAPTURE(row.name);
        CHECK_EXPECTED(group(shake_alike(make_similitude("froude", kAluminiumModel)), row.name), row.froude_aluminium);
        CHECK_EXPECTED(group(shake_alike(make_similitude("froude", kWoodModel)), row.name), row.froude_wood);
        CHECK_EXPECTED(group(shake_alike(make_similitude("mu", kAluminiumModel)), row.name), row.mu_aluminium);
        CHECK_EXPECTED(group(shake_alike(make_similitude("mu", kWoodModel)), row.name), row.mu_wood);
        // the laws' own vertical shaking keeps its group
        const double by_law = row.name == "a_vertical/g" ? 1.0 : group(shake_alike(make_similitude("mu", kWoodModel)), row.name);
        CHECK(group(make_similitude("mu", kWoodModel), row.name) == by_law);
    }
}

TEST_CASE("only groups that differ beyond rounding are distortions, in the order of the groups") {
    std::vector<std::string> names;
    for (const Distortion& distortion : find_distortions(shake_alike(make_similitude("mu", kAluminiumModel))))
        names.push_back(distortion.group);
    CHECK(names == std::vector<std::string>{"a/g", "a/(g*tan(alpha))", "a_vertical/g", "omega/p", "Fr^N", "mu/tan(alpha)", "mu"});
    CHECK(find_distortion(find_distortions(make_similitude("mu", kAluminiumModel)), "a_vertical/g") == nullptr);
}

TEST_CASE("an exact similitude with scaled contacts has no distortion at any length") {
    for (int denominator = 1; denominator <= 200; ++denominator) {
        const Similitude similitude = make_similitude("exact", {.length = 1.0 / denominator, .gravity = 1.3, .density = 0.7});
        const ModelProperties properties{.friction_prototype = 0.59,
                                         .slenderness = {kThin, kWide},
                                         .normal_stiffness = similitude.stiffness_static(),
                                         .shear_stiffness = similitude.stiffness(),
                                         .restitution = 1.0,
                                         .height_deviation = similitude.length()};
        CHECK(group_factors(similitude, properties).size() == 17);
        CHECK(find_distortions(similitude, properties).empty());
    }
}

TEST_CASE("friction that falls below the slenderness is an error that names the direction") {
    const ModelProperties properties{.friction_prototype = 0.59,
                                     .slenderness = {kThin, kWide},
                                     .normal_stiffness = {},
                                     .shear_stiffness = {},
                                     .restitution = {},
                                     .height_deviation = {}};

    const std::vector<Distortion> aluminium = find_distortions(make_similitude("mu", kAluminiumModel), properties);
    const Distortion* change = find_distortion(aluminium, "mu/tan(alpha)");
    REQUIRE(change != nullptr);
    CHECK(change->severity == Severity::error);
    CHECK(change->effect.find("at tan(alpha) = 0.32 mu/tan(alpha) goes from 1.844 (rocking can start first) to 0.5625 (sliding first)") !=
          std::string::npos);
    CHECK(change->effect.find("0.6635") == std::string::npos);

    // wood stays on its side in both directions, 6.8 % off
    const std::vector<Distortion> wood = find_distortions(make_similitude("mu", kWoodModel), properties);
    const Distortion* shift = find_distortion(wood, "mu/tan(alpha)");
    REQUIRE(shift != nullptr);
    CHECK(shift->severity == Severity::note);

    // without the prototype's friction nothing can be said of the regime
    const std::vector<Distortion> unknown = find_distortions(make_similitude("mu", kAluminiumModel));
    REQUIRE(find_distortion(unknown, "mu/tan(alpha)") != nullptr);
    CHECK(find_distortion(unknown, "mu/tan(alpha)")->severity == Severity::warning);
}

TEST_CASE("the same solid at 1:25 is too stiff under gravity by 25 and too fast in structural speed by 5") {
    const double length = 1.0 / 25.0;
    const Similitude similitude = make_similitude("mu", {.length = length});
    const ModelProperties same_solid{.friction_prototype = {},
                                     .slenderness = {},
                                     .normal_stiffness = length,
                                     .shear_stiffness = length,
                                     .restitution = 0.5,
                                     .height_deviation = 2.0 * length};

    CHECK_EXPECTED(group(similitude, "kappa_n", same_solid), 25.0);
    CHECK_EXPECTED(group(similitude, "S_e^N", same_solid), 5.0);
    CHECK_EXPECTED(group(similitude, "C^N", same_solid), 0.2);
    CHECK_EXPECTED(group(similitude, "k_s/k_n", same_solid), 1.0);
    CHECK_EXPECTED(group(similitude, "c_res", same_solid), 0.5);
    CHECK_EXPECTED(group(similitude, "sigma_H/H", same_solid), 2.0);
    CHECK_EXPECTED(group(similitude, "delta_w/sigma_H", same_solid), 1.0 / 50.0);

    const std::vector<Distortion> distortions = find_distortions(similitude, same_solid);
    CHECK(distortions.size() == 6);
    for (const Distortion& distortion : distortions) {
        CHECK(distortion.severity == Severity::warning);
        CHECK_FALSE(distortion.effect.empty());
    }
}

TEST_CASE("blocks of the prototype's stiffness raise the structural speed number of a 1:107 model about ten times") {
    ModelProperties same_solid;
    same_solid.shear_stiffness = 1.0 / 107.0;
    const double factor = group(make_similitude("mu", {.length = 1.0 / 107.0, .friction = 0.63 / 0.59}), "S_e^N", same_solid);
    CHECK_EXPECTED(factor, 1.0 / std::sqrt(0.63 / 0.59 / 107.0));
    CHECK_EXPECTED(factor, "10.0");
}

TEST_CASE("the Cauchy law reports the gravity it neglects") {
    const std::vector<Distortion> distortions = find_distortions(make_similitude("cauchy", {.length = 0.04}));
    const Distortion* froude = find_distortion(distortions, "Fr^N");
    REQUIRE(froude != nullptr);
    CHECK_EXPECTED(froude->factor, 5.0);
    CHECK(froude->severity == Severity::warning);
}

TEST_CASE("properties that cannot be are refused with the reason") {
    ModelProperties properties;
    properties.slenderness = {kThin, 0.0};
    CHECK_THROWS_WITH_AS(find_distortions(make_similitude("mu", kWoodModel), properties),
                         "distortions: a slenderness tan(alpha) is 0 (must be positive and finite); correct it or leave it out",
                         SimilitudeError);
    properties = {};
    properties.normal_stiffness = -1.0;
    CHECK_THROWS_AS(group_factors(make_similitude("mu", kWoodModel), properties), SimilitudeError);
    properties = {};
    properties.friction_prototype = std::nan("");
    CHECK_THROWS_AS(group_factors(make_similitude("mu", kWoodModel), properties), SimilitudeError);
}

TEST_CASE("severities have names") {
    CHECK(to_string(Severity::note) == "note");
    CHECK(to_string(Severity::warning) == "warning");
    CHECK(to_string(Severity::error) == "error");
}

}  // namespace musim::scaling::tests
