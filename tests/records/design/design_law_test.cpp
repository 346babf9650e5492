#include "records/design/design_law.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>

#include "records/design/parse_design.hpp"
#include "scaling/laws/scale_law_catalogue.hpp"
#include "tests/records/design/tower.hpp"
#include "tests/support/relative.hpp"
#include "tests/support/temporary_folder.hpp"

namespace musim::records {

using lsdem::tests::relative;
using musim::tests::message_of;

namespace {

/// Bisected ends and products of a dozen factors.
constexpr double kLawRounding = 1e-12;

DesignLaw make_law(const char* name, std::vector<scaling::GivenFactor> set = {}) { return {scaling::load_scale_law(name), std::move(set)}; }

/// A law that also holds a product.
DesignLaw make_holding(const char* name, const char* product) {
    scaling::ScaleLaw law = scaling::load_scale_law(name);
    law.held.emplace_back(product);
    return {std::move(law), {}};
}

scaling::LengthRange only_range(const Setting& setting, const Material& material, const DesignLaw& law) {
    const Candidate candidate = find_candidate(setting, material, law);
    CAPTURE(candidate.problem);
    REQUIRE(candidate.ranges.size() == 1);
    return candidate.ranges.front().scales;
}

double group(const ModelState& state, std::string_view name) {
    const auto found = std::find_if(state.groups.begin(), state.groups.end(), [&](const auto& each) { return each.name == name; });
    REQUIRE_MESSAGE(found != state.groups.end(), std::string(name));
    return found->value;
}

/// Displacement 2 mm, velocity 5 cm/s, 500 kg, 20 Hz; hall of 6 m.
Setting make_limited() {
    records::TableAxis axis = free_axis();
    axis.displacement = 2e-3 * si::meters;
    axis.velocity = 0.05 * si::meters_per_second;
    axis.payload = 500.0 * si::kilograms;
    Setting setting = make_setting(axis);
    setting.design.limits.hall_height = 6.0 * si::meters;
    setting.design.prototype.modulus = 29.2e9 * si::pascals;
    return setting;
}

Material with_modulus(Material material, double modulus) {
    material.modulus = modulus * si::pascals;
    return material;
}

const double kFriction = 0.18 / 0.59;  // aluminium

}  // namespace

TEST_CASE("every law that comes with musim can be designed by") {
    Setting setting = make_limited();
    // laws of elasticity leave the prototype's 42.4 cm/s as it is
    setting.loads.front().axis.velocity = 0.5 * si::meters_per_second;
    for (const std::string& name : scaling::scale_law_names()) {
        CAPTURE(name);
        std::vector<scaling::GivenFactor> set;
        if (name == "mechanics") set = {{"t", 0.1}};
        if (name == "gravity_distorted") set = {{"a", 1.5}};
        if (name == "restoring_force") set = {{"F_R", 1e-5}};
        if (name == "restoring_spring") set = {{"k_s", 1e-2}};
        if (name == "restoring_cohesion") set = {{"c_coh", 0.1}};
        const Candidate candidate = find_candidate(setting, with_modulus(concrete(), 29.2e9), make_law(name.c_str(), set));
        CHECK_MESSAGE(candidate.is_feasible(), candidate.problem);
        CHECK(candidate.limits.size() == 4);
        REQUIRE(candidate.ends.size() >= 2);
        for (const ModelState& end : candidate.ends) {
            for (const Use& use : end.uses) CHECK(use.used() <= 1.0 + kLawRounding);
            CHECK(end.groups.size() >= 12);
        }
        // the limit that binds is used up
        const auto& range = candidate.ranges.front();
        for (const Use& use : candidate.ends[1].uses) {
            if (use.limit == range.binds_above) CHECK(use.used() == relative(1.0, 1e-9));
        }
    }
}

TEST_CASE("limits of laws end at their closed forms") {
    Setting setting = make_limited();
    const Material solid = with_modulus(concrete(), 29.2e9);
    const auto allow_only = [&](auto change) {
        setting.loads.front().axis = free_axis();
        change(setting.loads.front().axis);
        setting.design.limits = {};
    };
    const double velocity = 0.05 / 0.424, mass = 500.0 / 2.701509e8;

    // λ_v = √(2 L) where the shaking is chosen twice as strong
    allow_only([](records::TableAxis& axis) { axis.velocity = 0.05 * si::meters_per_second; });
    CHECK(only_range(setting, solid, make_law("gravity_distorted", {{"a", 2.0}})).largest ==
          relative(velocity * velocity / 2.0, kLawRounding));
    // F_R held as friction: λ_v = √(U L), as by the mu law
    CHECK(only_range(setting, aluminium(), make_holding("restoring_force", "F_R/(mu*m*g)")).largest ==
          relative(std::min(1.0, velocity * velocity / kFriction), kLawRounding));

    // effective density λ_E/(L G): payload λ_E L²
    allow_only([](records::TableAxis& axis) { axis.payload = 500.0 * si::kilograms; });
    CHECK(only_range(setting, solid, make_law("artificial_mass")).largest == relative(std::sqrt(mass), kLawRounding));
    const Material soft = with_modulus(concrete(), 29.2e9 / 4.0);
    CHECK(only_range(setting, soft, make_law("artificial_mass")).largest == relative(std::sqrt(4.0 * mass), kLawRounding));
    CHECK(only_range(setting, soft, make_law("true_replica")).largest == relative(std::cbrt(mass), kLawRounding));

    // a centrifuge shakes by λ_a = 1/L
    allow_only([](records::TableAxis& axis) { axis.acceleration = {{0.0 * si::kilograms, 5.11 * scaling::kStandardGravity}}; });
    CHECK(only_range(setting, solid, make_law("centrifuge")).smallest == relative(0.1, kLawRounding));
}

TEST_CASE("a model with vertical distortion has its own widths, shaking and mass, and keeps the regime") {
    Setting setting = make_limited();
    const DesignLaw law = make_law("mu_vertical_distortion");
    const Material metal = aluminium();
    const ModelState state = find_state(setting, metal, law, 0.01);
    const auto use = [&](std::string_view limit) {
        const auto found = std::find_if(state.uses.begin(), state.uses.end(), [&](const Use& each) { return each.limit == limit; });
        REQUIRE(found != state.uses.end());
        return found->demand;
    };
    CHECK(use("displacement of axis x") == relative(0.2 * kFriction * 0.01, kLawRounding));
    // u/t = U V/√V
    CHECK(use("velocity of axis x") == relative(0.424 * kFriction * 0.1, kLawRounding));
    CHECK(use("hall height") == relative(1.615, kLawRounding));
    CHECK(use("payload of axis x") == relative(2.701509e8 * 2632.0 / 2320.0 * kFriction * kFriction * 1e-6, kLawRounding));
    for (const char* kept : {"mu^N", "t*sqrt(mu*g/l)", "a/(mu*g)", "a/(g*tan(alpha))", "a_vertical/g", "mu/tan(alpha)", "u/b"}) {
        CHECK_MESSAGE(group(state, kept) == relative(1.0, kLawRounding), kept);
    }
    CHECK(group(state, "a/g") == relative(kFriction, kLawRounding));
    // of the thin side, R ∝ H √(1 + tan²α) and e_r = 1 - 1.5 sin²α: 0.978 and 0.986/0.861
    const auto secant_squared = [](double slenderness) { return 1.0 + slenderness * slenderness; };
    const double prototype_side = 1.36 / 4.25, model_side = kFriction * prototype_side;
    CHECK(group(state, "omega/p") == relative(std::pow(secant_squared(model_side) / secant_squared(prototype_side), 0.25), kLawRounding));
    CHECK(group(state, "omega/p") == relative(0.978, 5e-4));
    const auto leave = [&](double slenderness) { return 1.0 - 1.5 * (1.0 - 1.0 / secant_squared(slenderness)); };
    CHECK(group(state, "e_r") == relative(leave(model_side) / leave(prototype_side), kLawRounding));
    // all that the law holds has a name of its own already, but u/b
    for (const char* twice : {"a/(g*tan_alpha)", "a_v/g", "mu/tan_alpha"}) {
        CHECK_MESSAGE(std::none_of(state.groups.begin(), state.groups.end(), [&](const GroupFactor& each) { return each.name == twice; }),
                      twice);
    }
    const auto kept = default_groups();
    CHECK(std::find(kept.begin(), kept.end(), "e_r") != kept.end());
    setting.design.groups = {"e_r", "a_v/g"};
    const ModelState weighed = find_state(setting, metal, law, 0.01);
    CHECK(weighed.measure == relative(std::log(leave(model_side) / leave(prototype_side)), kLawRounding));
    CHECK(group(weighed, "a_v/g") == relative(1.0, kLawRounding));
    // rotation θ = u/H
    CHECK(group(state, "theta") == relative(kFriction, kLawRounding));
    CHECK_FALSE(state.changes_regime());
    CHECK(find_state(setting, metal, by("mu"), 0.01).changes_regime());

    // the smallest edge is a width; a vertical axis moves by V and G
    Material coarse = metal;
    coarse.smallest_edge = 5e-3 * si::meters;
    setting.loads.front().axis = free_axis();
    setting.design.limits = {};
    CHECK(only_range(setting, coarse, law).smallest == relative(5e-3 / (1.36 * kFriction), kLawRounding));
    setting.loads.front().axis.name = "z";
    setting.loads.front().axis.displacement = 2e-3 * si::meters;
    CHECK(only_range(setting, metal, law).largest == relative(0.01, kLawRounding));
}

TEST_CASE("groups of a law follow from what the material has and not from what the law asks for") {
    const Setting setting = make_limited();
    const Material stiff = with_modulus(concrete(), 29.2e9);
    // the law asks λ_E = L, the same solid has 1
    CHECK(group(find_state(setting, stiff, make_law("true_replica"), 0.01), "E/(rho*g*l)") == relative(100.0, kLawRounding));
    CHECK(group(find_state(setting, stiff, make_law("true_replica"), 0.01), "kappa_n") == relative(100.0, kLawRounding));
    const ModelState heavy = find_state(setting, stiff, make_law("artificial_mass"), 0.01);
    CHECK(group(heavy, "E/(rho*g*l)") == relative(1.0, kLawRounding));
    CHECK(group(heavy, "kappa_n") == relative(1.0, kLawRounding));
    CHECK(heavy.added_mass.value() == relative(2.701509e8 * (1e-4 - 1e-6), kLawRounding));
    // a modulus that is not given leaves its products out
    const ModelState not_given = find_state(setting, concrete(), make_law("true_replica"), 0.01);
    CHECK(std::none_of(not_given.groups.begin(), not_given.groups.end(), [](const auto& each) { return each.name == "E/(rho*g*l)"; }));
}

TEST_CASE("a law that does not admit a material makes it infeasible and names the factor") {
    const Candidate refused = find_candidate(make_limited(), with_modulus(wood(), 3.56e9), make_law("centrifuge"));
    CHECK_FALSE(refused.is_feasible());
    CHECK(refused.problem.find("law centrifuge: mu = 1.067797 cannot be where mu is held") != std::string::npos);
    Setting turning = make_limited();
    turning.design.gravity = 25.0;
    // gravity is given and the solid's modulus asks for another: no length but one keeps both
    CHECK(find_candidate(turning, with_modulus(concrete(), 29.2e9), make_law("centrifuge")).problem.find("cannot be where") !=
          std::string::npos);
    CHECK(find_candidate(turning, with_modulus(concrete(), 29.2e9), make_law("exact")).is_feasible());
}

TEST_CASE("designs name laws, with factors, products and files of one's own") {
    const musim::tests::TemporaryFolder folder;
    const std::string source = (folder.path() / "d.json").string();
    std::ofstream(folder.path() / "mine.json") << R"({"schema": "musim-law/1", "name": "mine", "title": "own", "extends": "mechanics",
        "chosen": [{"name": "l"}, {"name": "rho", "default": 1}], "held": ["a/g"]})";
    const auto parse = [&](const std::string& laws) {
        return parse_design(
            R"({"schema": "musim-design/1", "prototype": {"block": ["1.36 m", "2.82 m", "4.25 m"], "height": "161.5 m", "density": "2320 kg/m^3",
                "friction": 0.59}, "materials": [{"name": "stone", "density": "2320 kg/m^3", "friction": 0.59}], "laws": )" +
                laws + "}",
            source, {});
    };
    const Design design = parse(R"-(["mu", "true_replica", "mine.json", {"law": "gravity_distorted", "set": {"a": "3/2"}},
        {"law": "restoring_force", "hold": ["F_R/(mu*m*g)"]}])-");
    REQUIRE(design.laws.size() == 5);
    CHECK(design.laws[0].name() == "mu");
    CHECK(design.laws[1].name() == "true_replica");
    CHECK(design.laws[2].name() == "mine");
    CHECK(design.laws[3].set().front().factor == 1.5);
    CHECK(design.laws[4].law().held.back() == "F_R/(mu*m*g)");
    const auto message = [&](const std::string& laws) { return message_of<std::runtime_error>([&] { parse(laws); }); };
    CHECK(message(R"(["gravity_distorted"])").find("the factor of a (acceleration) is missing") != std::string::npos);
    CHECK(message(R"(["gravity_distorted"])").find(R"({"law": "gravity_distorted", "set": {"NAME": NUMBER}})") != std::string::npos);
    CHECK(message(R"([{"law": "mu", "set": {"x": 1}}])").find("\"x\" is no quantity") != std::string::npos);
    CHECK(message(R"([{"law": "mu", "set": {"l": 1}}])").find("l is given twice") != std::string::npos);
    CHECK(message(R"([{"law": "mu", "hold": ["v/g"]}])").find("is not dimensionless") != std::string::npos);
    CHECK(message(R"([{"law": "mu", "colour": 1}])").find("\"colour\" is none of its settings") != std::string::npos);
    CHECK(message(R"(["frode"])").find("there is no law \"frode\"") != std::string::npos);
    CHECK(message(R"([{"law": "mu", "set": {"E": -1}}])").find("E is not above zero") != std::string::npos);
}

}  // namespace musim::records
